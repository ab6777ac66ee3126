//! Text to people: standard output for answers, standard error for the rest.

use std::io::{self, Write};

/// Prints an answer on standard output. A reader that has gone away, such as
/// `head`, has what it wanted: that is no error.
///
/// # Errors
/// The output takes no more, say because a disk is full.
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

/// Tells something on standard error, if anybody listens.
pub(super) fn note(text: &str) {
    let mut output = io::stderr().lock();
    let _ = output.write_all(text.as_bytes());
    let _ = output.write_all(b"\n");
}
