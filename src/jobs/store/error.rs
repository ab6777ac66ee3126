//! Errors of a store, by the person who can act on them. They name no database: each driver
//! sorts its own errors into these.

use crate::jobs::job::JobId;
use crate::results::chunk::BlockError;
use std::error::Error as AnyError;
use thiserror::Error;

/// Error of a driver or of the system beneath a [`StoreError`].
pub type Cause = Box<dyn AnyError + Send + Sync>;

/// Kind of a store's error, by the person who can act on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoreErrorKind {
    /// The disk is full, or the database has reached its own limit.
    Full,
    /// The database can't be read or written now.
    Unavailable,
    /// Stored data of one job can't be read; other jobs are not concerned.
    Damaged,
    /// A defect.
    Defect,
}

/// Error of the store.
#[derive(Debug, Error)]
pub enum StoreError {
    /// Another service uses the database.
    #[error("another service is using this database (it holds {lock})")]
    InUse {
        /// Name of the lock that the other service holds.
        lock: String,
    },
    /// The database is not one of this program and version, and can't be made so.
    #[error("database: {0}")]
    Schema(#[source] Cause),
    /// The disk is full, or the database has reached its own limit.
    #[error("database: {0}")]
    Full(#[source] Cause),
    /// The database can't be read or written now.
    #[error("database: {0}")]
    Unavailable(#[source] Cause),
    /// The database has refused writes for too long.
    #[error("the database refuses what is to be written")]
    Refused,
    /// A row holds an invalid value.
    #[error("job {job}: {what} can't be read")]
    Row {
        /// The job.
        job: String,
        /// Part of the job that can't be read.
        what: &'static str,
    },
    /// A stored block can't be read.
    #[error("job {job}: {source}")]
    Block {
        /// The job.
        job: JobId,
        /// Error of the block.
        source: BlockError,
    },
    /// A defect of the driver or of the database.
    #[error("database: {0}")]
    Defect(#[source] Cause),
}

impl StoreError {
    /// Error of a database, of this kind.
    pub(super) fn of_kind(kind: StoreErrorKind, cause: Cause) -> Self {
        match kind {
            StoreErrorKind::Full => Self::Full(cause),
            StoreErrorKind::Unavailable => Self::Unavailable(cause),
            StoreErrorKind::Damaged | StoreErrorKind::Defect => Self::Defect(cause),
        }
    }

    /// Kind of the error.
    pub fn kind(&self) -> StoreErrorKind {
        match self {
            Self::Full(_) => StoreErrorKind::Full,
            Self::InUse { .. } | Self::Unavailable(_) | Self::Refused => {
                StoreErrorKind::Unavailable
            }
            Self::Row { .. } | Self::Block { .. } => StoreErrorKind::Damaged,
            Self::Schema(_) | Self::Defect(_) => StoreErrorKind::Defect,
        }
    }
}
