//! Text for people: standard output for answers, standard error for the rest.

use std::io::{self, IsTerminal, Write};
use thiserror::Error;

/// Standard output can't be written.
#[derive(Debug, Error)]
#[error("cannot write standard output: {0}")]
pub(super) struct OutputError(io::Error);

/// Prints an answer on standard output. A reader that has closed the pipe, such as
/// `head`, is no error.
///
/// # Errors
/// Standard output can't be written, for example because a disk is full.
pub(super) fn answer(text: &str) -> Result<(), OutputError> {
    match print(text) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result.map_err(OutputError),
    }
}

/// Prints an answer that was costly and is nowhere else: a reader that has closed the pipe has
/// lost it.
///
/// # Errors
/// Standard output can't be written.
pub(super) fn only_answer(text: &str) -> Result<(), OutputError> {
    print(text).map_err(OutputError)
}

fn print(text: &str) -> io::Result<()> {
    let mut output = io::stdout().lock();
    output.write_all(text.as_bytes())?;
    output.write_all(b"\n")?;
    output.flush()
}

/// Clears the line in which a progress bar may stand, which is then drawn anew below.
const CLEAR_LINE: &[u8] = b"\r\x1b[2K";

/// Prints a note on standard error and ignores failures.
pub(super) fn note(text: &str) {
    let mut output = io::stderr().lock();
    if output.is_terminal() {
        let _ = output.write_all(CLEAR_LINE);
    }
    let _ = output.write_all(text.as_bytes());
    let _ = output.write_all(b"\n");
}
