//! Text for people: standard output for answers, standard error for the rest.

use std::io::{self, Write};

/// Prints an answer on standard output. A reader that has closed the pipe, such as
/// `head`, is no error.
///
/// # Errors
/// Standard output can't be written, for example because a disk is full.
pub(super) fn answer(text: &str) -> io::Result<()> {
    let mut output = io::stdout().lock();
    let written = output
        .write_all(text.as_bytes())
        .and_then(|()| output.write_all(b"\n"))
        .and_then(|()| output.flush());
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result,
    }
}

/// Prints a note on standard error and ignores failures.
pub(super) fn note(text: &str) {
    let mut output = io::stderr().lock();
    let _ = output.write_all(text.as_bytes());
    let _ = output.write_all(b"\n");
}
