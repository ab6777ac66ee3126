//! Ways in which a connection breaks, and which of them pass.

use std::io::ErrorKind;
use ureq::{Error, Timeout};

/// The library's error without its word for the kind, which the sentence has already.
pub(super) fn cause(error: &Error) -> String {
    match error {
        Error::Io(error) => error.to_string(),
        error => error.to_string(),
    }
}

/// True if no connection was made.
pub(super) fn is_unconnected(error: &Error) -> bool {
    match error {
        Error::HostNotFound | Error::ConnectionFailed | Error::ConnectProxyFailed(_) => true,
        Error::Timeout(when) => matches!(when, Timeout::Connect | Timeout::Resolve),
        // A name that is not found has no kind of its own.
        Error::Io(error) => !is_broken(error.kind()) && !is_for_ever(error.kind()),
        _ => false,
    }
}

/// True if a connection was made and broke.
pub(super) fn has_broken(error: &Error) -> bool {
    match error {
        Error::Timeout(when) => !matches!(when, Timeout::Connect | Timeout::Resolve),
        Error::Io(error) => is_broken(error.kind()),
        _ => false,
    }
}

fn is_broken(kind: ErrorKind) -> bool {
    matches!(
        kind,
        ErrorKind::BrokenPipe
            | ErrorKind::ConnectionAborted
            | ErrorKind::ConnectionReset
            | ErrorKind::UnexpectedEof
    )
}

/// True for a certificate that is not trusted: it won't be the next time.
fn is_for_ever(kind: ErrorKind) -> bool {
    matches!(kind, ErrorKind::InvalidData | ErrorKind::InvalidInput)
}
