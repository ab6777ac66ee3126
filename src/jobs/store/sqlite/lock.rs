//! Lock file beside the database, which keeps a second service from using it.

use crate::jobs::store::StoreError;
use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Error of the system about the lock file.
#[derive(Debug, Error)]
#[error("lock file {path}: {source}")]
struct LockFileError {
    path: PathBuf,
    source: io::Error,
}

/// Takes the lock of a database; it is held until the file is closed.
pub(super) fn take(database: &Path) -> Result<File, StoreError> {
    // By its canonical path, so that a link to it uses the same lock.
    let real = database
        .canonicalize()
        .unwrap_or_else(|_| database.to_owned());
    let mut path = real.into_os_string();
    path.push(".lock");
    let path = PathBuf::from(path);
    let failed = |path, source| StoreError::Unavailable(LockFileError { path, source }.into());
    let file = match File::options().create(true).append(true).open(&path) {
        Ok(file) => file,
        Err(source) => return Err(failed(path, source)),
    };
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::InUse {
            lock: path.display().to_string(),
        }),
        Err(TryLockError::Error(source)) => Err(failed(path, source)),
    }
}
