//! Store of jobs and results: one SQLite file. All SQL of the project is in this folder,
//! behind [`JobStore`]; this folder uses neither HTTP nor the solver.
//!
//! One connection writes, in transactions that take the write lock at once; a
//! few read-only connections read concurrently (write-ahead log). Every commit reaches
//! the disk before it is acknowledged (`synchronous=FULL`). A lock file beside the
//! database keeps a second service from using it.

mod ending;
mod events;
mod health;
mod history;
mod lease;
mod port;
mod queue;
mod read;
mod removal;
mod results;
mod rows;
mod states;
mod submission;
#[cfg(test)]
mod tests;

pub use ending::{FailedAttempt, Returned, TOLERATED_SETBACKS};
pub use events::Event;
pub use health::{JobCounts, StoreErrorKind};
pub use lease::Renewal;
pub use port::JobStore;
pub use queue::{Claim, Claimant, Dismissal, Solver};
pub use read::Page;
pub use removal::Removal;
pub use results::{NewChunk, NewResults, StoredChunk};
pub use states::{AttemptStart, ResumePoint, StoredState};
pub use submission::{Key, Room, Submission, Submitted};

use super::clock::{Clock, SystemClock};
use super::job::JobId;
use crate::results::chunk::BlockError;
use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Connection, Sqlite, Transaction};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// Connections that read. More would only wait for the same disk.
const READERS: u32 = 4;

/// Time that a connection waits for a lock held by another. Only a backup tool could
/// hold one for long.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// Length to which the write-ahead log is truncated [bytes].
const LOG_BYTES: u32 = 16 << 20;

/// The database of one service. Clones share it.
#[derive(Debug, Clone)]
pub struct Store {
    writer: SqlitePool,
    readers: SqlitePool,
    clock: Arc<dyn Clock>,
    _lock: Arc<File>,
}

/// Lease of one worker on a job: every write by the worker names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lease {
    /// The job.
    pub job: JobId,
    /// Number of the attempt.
    pub attempt: u32,
    /// Fencing token: valid until the job gets another lease.
    pub token: i64,
}

/// Error of the store.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The lock file can't be created.
    #[error("lock file {path}: {source}")]
    LockFile {
        /// The lock file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// Another service uses the database.
    #[error("another service is using this database (it holds {0})")]
    InUse(PathBuf),
    /// The database does not fit this version.
    #[error("migration: {0}")]
    Migrate(#[from] sqlx::migrate::MigrateError),
    /// The database's own error.
    #[error("database: {0}")]
    Database(#[from] sqlx::Error),
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
}

impl Store {
    /// Opens the database, creates it if it does not exist, and migrates it to this
    /// version's schema.
    ///
    /// # Errors
    /// Another service uses the database, or it can't be opened.
    pub async fn open(path: &Path) -> Result<Self, StoreError> {
        Self::open_with(path, None, Arc::new(SystemClock)).await
    }

    /// The same, with a largest size of the database [bytes] and a clock that
    /// may differ from the system's.
    ///
    /// # Errors
    /// Another service uses the database, or it can't be opened.
    pub async fn open_with(
        path: &Path,
        largest_bytes: Option<u64>,
        clock: Arc<dyn Clock>,
    ) -> Result<Self, StoreError> {
        let lock = lock(path)?;
        let options = SqliteConnectOptions::new()
            .filename(path)
            .journal_mode(SqliteJournalMode::Wal)
            .synchronous(SqliteSynchronous::Full)
            .foreign_keys(true)
            .busy_timeout(BUSY_TIMEOUT)
            // A log that grew under a saved state is truncated again.
            .pragma("journal_size_limit", LOG_BYTES.to_string());
        let writer = SqlitePoolOptions::new()
            .max_connections(1)
            // On a full disk SQLite ends a transaction itself, which the
            // connection does not notice; it could never begin another one.
            .before_acquire(|connection, _| {
                let usable = !connection.is_in_transaction();
                Box::pin(async move { Ok(usable) })
            })
            .connect_with(limited(options.clone(), largest_bytes).create_if_missing(true))
            .await?;
        sqlx::migrate!().run(&writer).await?;
        let readers = SqlitePoolOptions::new()
            .max_connections(READERS)
            .connect_with(options.read_only(true))
            .await?;
        Ok(Self {
            writer,
            readers,
            clock,
            _lock: Arc::new(lock),
        })
    }

    /// Closes the database: readers first, so that the writer, as the last connection,
    /// merges the write-ahead log into the file.
    pub async fn close(&self) {
        self.readers.close().await;
        self.writer.close().await;
    }

    /// A transaction that has the write lock from its beginning, so that it
    /// can't fail half-way for lack of it.
    async fn begin_write(&self) -> Result<Transaction<'static, Sqlite>, StoreError> {
        Ok(self.writer.begin_with("BEGIN IMMEDIATE").await?)
    }

    /// The time of day, as stored in rows [ms].
    fn now_ms(&self) -> i64 {
        self.clock.now().as_millisecond()
    }
}

/// SQLite's page size [bytes].
const PAGE_BYTES: u64 = 4096;

fn limited(options: SqliteConnectOptions, largest_bytes: Option<u64>) -> SqliteConnectOptions {
    match largest_bytes {
        None => options,
        Some(bytes) => options
            .page_size(PAGE_BYTES as u32)
            .pragma("max_page_count", (bytes / PAGE_BYTES).max(1).to_string()),
    }
}

fn lock(database: &Path) -> Result<File, StoreError> {
    // By its canonical path, so that a link to it uses the same lock.
    let real = database
        .canonicalize()
        .unwrap_or_else(|_| database.to_owned());
    let mut path = real.into_os_string();
    path.push(".lock");
    let path = PathBuf::from(path);
    let file = File::options().create(true).append(true).open(&path);
    let file = match file {
        Ok(file) => file,
        Err(source) => return Err(StoreError::LockFile { path, source }),
    };
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StoreError::InUse(path)),
        Err(TryLockError::Error(source)) => Err(StoreError::LockFile { path, source }),
    }
}
