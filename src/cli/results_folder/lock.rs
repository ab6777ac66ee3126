//! Lock file of a results folder, which keeps a second run from using it.

use crate::cli::failure::Failure;
use std::fs::{File, TryLockError};
use std::path::Path;

/// Name of the lock file. It stays, as a removed one could be locked by one run and created anew
/// by another.
const LOCK: &str = ".scree.lock";

/// Takes the lock of a folder; it is held until the file is closed. The system closes it when
/// the process ends, so that a killed run locks nobody out.
///
/// # Errors
/// Another run holds it, or the folder can't be written.
pub(super) fn take(folder: &Path) -> Result<File, Failure> {
    let path = folder.join(LOCK);
    let file = File::options().create(true).append(true).open(&path);
    let file = file.map_err(|error| Failure::path("write", &path, &error))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(Failure::Other(format!(
            "{} is in use by another run",
            folder.display()
        ))),
        Err(TryLockError::Error(error)) => Err(Failure::path("lock", &path, &error)),
    }
}
