//! Files that hold a token, which nobody but their owner may read.

use crate::cli::failure::Failure;
use std::fs::{File, Metadata};
use std::io::{self, Read};
use std::path::Path;

/// Longest file that is read [bytes]: what is longer holds something else.
const LONGEST: u64 = 64 * 1024;

/// Text of a file, and its metadata at the time of reading.
///
/// # Errors
/// The system's.
pub(super) fn read(path: &Path) -> io::Result<(String, Metadata)> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    let mut text = String::new();
    file.take(LONGEST).read_to_string(&mut text)?;
    Ok((text, metadata))
}

/// Refuses a file with a token that its group or all others can read. A pipe has no other readers.
///
/// # Errors
/// The file has such a mode.
#[cfg(unix)]
pub(super) fn refuse_if_others_can_read(path: &Path, metadata: &Metadata) -> Result<(), Failure> {
    use std::os::unix::fs::PermissionsExt;
    let mode = metadata.permissions().mode() & 0o7777;
    if !metadata.is_file() || mode & 0o077 == 0 {
        return Ok(());
    }
    let path = path.display();
    Err(Failure::Input(format!(
        "{path} holds an access token and has mode {mode:04o}, so that other users can use it: `chmod 600 {path}` makes it its owner's alone"
    )))
}

/// Other systems have no modes.
#[cfg(not(unix))]
pub(super) fn refuse_if_others_can_read(_: &Path, _: &Metadata) -> Result<(), Failure> {
    Ok(())
}
