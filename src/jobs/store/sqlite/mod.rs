//! Driver for SQLite: one file. All that knows SQL, connections and migrations is in this
//! folder; each operation of the port is in the file of its subject, and [`JobStore`] says
//! what it must do.
//!
//! One connection writes, in transactions that take the write lock at once; a
//! few read-only connections read concurrently (write-ahead log). Every commit reaches
//! the disk before it is acknowledged (`synchronous=FULL`). A lock file beside the
//! database keeps a second service from using it.
//!
//! [`JobStore`]: super::JobStore

mod ending;
mod error;
mod events;
mod health;
mod history;
mod keyed_requests;
mod lease;
mod lock;
mod port;
mod queue;
mod read;
mod removal;
mod results;
mod rows;
mod states;
mod submission;
#[cfg(test)]
pub(super) mod tests;

use super::StoreError;
use crate::jobs::clock::{Clock, SystemClock};
use error::{Answer, SqliteError, of_migration};
use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use sqlx::{Connection, Sqlite, Transaction};
use std::fs::File;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

/// Connections that read. More would only wait for the same disk.
const READERS: u32 = 4;

/// Time that a connection waits for a lock held by another. Only a backup tool could
/// hold one for long.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// Length to which the write-ahead log is truncated [bytes].
const LOG_BYTES: u32 = 16 << 20;

/// The database of one service.
#[derive(Debug)]
pub struct SqliteStore {
    writer: SqlitePool,
    readers: SqlitePool,
    clock: Arc<dyn Clock>,
    _lock: File,
}

impl SqliteStore {
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
        let lock = lock::take(path)?;
        let (writer, readers) = connect(path, largest_bytes).await?;
        Ok(Self {
            writer,
            readers,
            clock,
            _lock: lock,
        })
    }

    /// Closes the database: readers first, so that the writer, as the last connection,
    /// merges the write-ahead log into the file.
    pub(super) async fn close(&self) {
        self.readers.close().await;
        self.writer.close().await;
    }

    /// A transaction that has the write lock from its beginning, so that it
    /// can't fail half-way for lack of it.
    async fn begin_write(&self) -> Answer<Transaction<'static, Sqlite>> {
        Ok(self.writer.begin_with("BEGIN IMMEDIATE").await?)
    }

    /// The time of day, as stored in rows [ms].
    fn now_ms(&self) -> i64 {
        self.clock.now().as_millisecond()
    }
}

/// The connection that writes, after migration to this version's schema, and those that read.
async fn connect(
    path: &Path,
    largest_bytes: Option<u64>,
) -> Result<(SqlitePool, SqlitePool), StoreError> {
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
        .await
        .map_err(SqliteError::from)?;
    sqlx::migrate!().run(&writer).await.map_err(of_migration)?;
    let readers = SqlitePoolOptions::new()
        .max_connections(READERS)
        .connect_with(options.read_only(true))
        .await
        .map_err(SqliteError::from)?;
    Ok((writer, readers))
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
