//! Lock file beside the database, which keeps a second service from using it.

use super::file::{Identity, beside, private};
use crate::jobs::store::StoreError;
use std::fs::{self, File, Metadata, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use thiserror::Error;

/// Error of the system about the lock file.
#[derive(Debug, Error)]
#[error("lock file {path}: {source}")]
struct LockFileError {
    path: PathBuf,
    source: io::Error,
}

/// Lock of a database. Where the lock file can't be created, because nothing there can be
/// written, it is taken before the first write.
#[derive(Debug)]
pub(super) struct Lock {
    /// By the canonical path of the database, so that a link to it uses the same lock.
    path: PathBuf,
    held: Mutex<Option<File>>,
}

impl Lock {
    pub(super) fn of(database: &Path) -> Self {
        Self {
            path: beside(database, ".lock"),
            held: Mutex::default(),
        }
    }

    /// Takes the lock, unless it is held already. A lock whose file was removed holds nobody off,
    /// and is taken anew.
    ///
    /// # Errors
    /// Another service holds it, or the file can't be created.
    pub(super) fn take(&self) -> Result<(), StoreError> {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        if !held.as_ref().is_some_and(|file| self.leads_to(file)) {
            *held = Some(self.lock_file()?);
        }
        Ok(())
    }

    /// True if the lock is held.
    pub(super) fn is_held(&self) -> bool {
        let held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        held.is_some()
    }

    /// Releases the lock.
    pub(super) fn release(&self) {
        *self.held.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// True if the path still leads to this file.
    fn leads_to(&self, file: &File) -> bool {
        let identity = |metadata: io::Result<Metadata>| metadata.ok().as_ref().map(Identity::of);
        let found = identity(fs::metadata(&self.path));
        found.is_some() && found == identity(file.metadata())
    }

    fn lock_file(&self) -> Result<File, StoreError> {
        let failed = |source| {
            let path = self.path.clone();
            StoreError::Unavailable(LockFileError { path, source }.into())
        };
        let file = private(OpenOptions::new().create(true).append(true))
            .open(&self.path)
            .map_err(failed)?;
        match file.try_lock() {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => Err(StoreError::InUse {
                lock: self.path.display().to_string(),
            }),
            Err(TryLockError::Error(source)) => Err(failed(source)),
        }
    }
}
