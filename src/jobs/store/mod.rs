//! Where jobs and results are kept: one SQLite file. All SQL of the project is
//! in this folder, behind [`JobStore`], and nothing here knows HTTP or the solver.
//!
//! One connection writes, in transactions that take the write lock at once; a
//! few read-only ones read beside it (write-ahead log). Every commit reaches
//! the disk before it is answered (`synchronous=FULL`). A lock file beside the
//! database keeps a second service off it.

mod ending;
mod history;
mod lease;
mod queue;
mod read;
mod results;
mod rows;
mod seam;
mod states;
#[cfg(test)]
mod tests;

pub use ending::{Returned, Setback, TOLERATED_SETBACKS};
pub use lease::Renewal;
pub use queue::{Claim, Claimant, Dismissal};
pub use read::Page;
pub use results::{NewChunk, NewResults, StoredChunk};
pub use seam::JobStore;
pub use states::{Beginning, Mark, StoredState};

use super::clock::{Clock, SystemClock};
use super::job::JobId;
use crate::results::chunk::BlockError;
use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Sqlite, Transaction};
use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// Connections that read. More would only wait for the same disk.
const READERS: u32 = 4;

/// How long a connection waits for a lock that another holds. Only a backup
/// tool could hold one for long.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// The database of one service. Clones share it.
#[derive(Debug, Clone)]
pub struct Store {
    writer: SqlitePool,
    readers: SqlitePool,
    clock: Arc<dyn Clock>,
    _lock: Arc<File>,
}

/// One worker's hold on a job: every write by the worker names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hold {
    /// The job.
    pub job: JobId,
    /// Which attempt at it.
    pub attempt: u32,
    /// The fencing token: good until the job changes hands.
    pub token: i64,
}

/// Why the store can't do what it was asked.
#[derive(Debug, Error)]
pub enum StoreError {
    /// The lock file can't be made.
    #[error("lock file {path}: {source}")]
    LockFile {
        /// The lock file.
        path: PathBuf,
        /// The system's words.
        source: std::io::Error,
    },
    /// Another service has the database.
    #[error("another service is using this database (it holds {0})")]
    InUse(PathBuf),
    /// The database does not fit this version.
    #[error("migration: {0}")]
    Migrate(#[from] sqlx::migrate::MigrateError),
    /// The database's own error.
    #[error("database: {0}")]
    Database(#[from] sqlx::Error),
    /// The database has refused for so long that there is no time left.
    #[error("the database refuses what is to be written")]
    Refused,
    /// A row holds what it never should.
    #[error("job {job}: {what} can't be read")]
    Row {
        /// The job.
        job: String,
        /// Which part of it.
        what: &'static str,
    },
    /// A stored block can't be read.
    #[error("job {job}: {source}")]
    Block {
        /// The job.
        job: JobId,
        /// What is wrong with it.
        source: BlockError,
    },
}

impl Store {
    /// Opens the database, makes it if it is not there, and brings it to this
    /// version's form.
    ///
    /// # Errors
    /// Another service has it, or it can't be opened.
    pub async fn open(path: &Path) -> Result<Self, StoreError> {
        Self::open_with(path, Arc::new(SystemClock)).await
    }

    /// The same by another clock than the system's.
    ///
    /// # Errors
    /// Another service has it, or it can't be opened.
    pub async fn open_with(path: &Path, clock: Arc<dyn Clock>) -> Result<Self, StoreError> {
        let lock = lock(path)?;
        let options = SqliteConnectOptions::new()
            .filename(path)
            .journal_mode(SqliteJournalMode::Wal)
            .synchronous(SqliteSynchronous::Full)
            .foreign_keys(true)
            .busy_timeout(BUSY_TIMEOUT);
        let writer = SqlitePoolOptions::new()
            .max_connections(1)
            .connect_with(options.clone().create_if_missing(true))
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

    /// Closes the database: readers first, so that the writer, as the last,
    /// folds the write-ahead log into the file.
    pub async fn close(&self) {
        self.readers.close().await;
        self.writer.close().await;
    }

    /// Whether the database answers.
    ///
    /// # Errors
    /// It does not.
    pub async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT 1").execute(&self.readers).await?;
        Ok(())
    }

    /// A transaction that has the write lock from its beginning, so that it
    /// can't fail half-way for want of it.
    async fn begin_write(&self) -> Result<Transaction<'static, Sqlite>, StoreError> {
        Ok(self.writer.begin_with("BEGIN IMMEDIATE").await?)
    }

    /// The time of day, as rows have it [ms].
    fn now_ms(&self) -> i64 {
        self.clock.now().as_millisecond()
    }
}

fn lock(database: &Path) -> Result<File, StoreError> {
    // By its real name, so that a link to it meets the same lock.
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
