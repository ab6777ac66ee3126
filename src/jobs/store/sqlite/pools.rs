//! Connections to a database: one that writes, and those that read.

use super::error::SqliteError;
use super::inspection::{immutable, is_complete};
use crate::jobs::store::StoreError;
use sqlx::Connection;
use sqlx::sqlite::{
    SqliteConnectOptions, SqliteJournalMode, SqlitePool, SqlitePoolOptions, SqliteSynchronous,
};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Connections that read. More would only wait for the same disk.
const READERS: u32 = 4;

/// Time that a connection waits for a lock held by another. Only a backup tool could
/// hold one for long.
const BUSY_TIMEOUT: Duration = Duration::from_secs(5);

/// Length to which the write-ahead log is truncated [bytes].
const LOG_BYTES: u32 = 16 << 20;

/// SQLite's page size [bytes].
pub(super) const PAGE_BYTES: u64 = 4096;

/// Connections that read.
#[derive(Debug)]
pub(super) struct Readers {
    /// Connections beside one that writes.
    shared: SqlitePool,
    /// Connections to a file that nobody can write, nor its log beside it.
    immutable: Option<SqlitePool>,
    written: AtomicBool,
}

impl Readers {
    pub(super) async fn open(path: &Path) -> Result<Self, StoreError> {
        let options = common(path).read_only(true);
        let (shared, immutable) = match connect(options.clone()).await {
            Ok(shared) => (shared, None),
            Err(_) if is_complete(path) => {
                let alone = connect(immutable(path)).await;
                let alone = alone.map_err(SqliteError::from)?;
                (pool().connect_lazy_with(options), Some(alone))
            }
            Err(error) => return Err(SqliteError::from(error).into()),
        };
        Ok(Self {
            shared,
            immutable,
            written: AtomicBool::new(false),
        })
    }

    /// The connections to read by now.
    pub(super) fn pool(&self) -> &SqlitePool {
        match &self.immutable {
            Some(alone) if !self.written.load(Ordering::Acquire) => alone,
            _ => &self.shared,
        }
    }

    /// Reads what is written from now on: the file can be written.
    pub(super) fn follow_writer(&self) {
        self.written.store(true, Ordering::Release);
    }

    pub(super) async fn close(&self) {
        self.shared.close().await;
        if let Some(alone) = &self.immutable {
            alone.close().await;
        }
    }
}

fn pool() -> SqlitePoolOptions {
    lasting().max_connections(READERS)
}

/// Connections that stay open: the write-ahead log goes with the last one, and another one could
/// not be told from one that was put in its place.
fn lasting() -> SqlitePoolOptions {
    SqlitePoolOptions::new()
        .idle_timeout(None)
        .max_lifetime(None)
}

/// Connections of which one has read.
async fn connect(options: SqliteConnectOptions) -> Result<SqlitePool, sqlx::Error> {
    let readers = pool().connect_with(options).await?;
    sqlx::query("SELECT count(*) FROM sqlite_schema")
        .execute(&readers)
        .await?;
    Ok(readers)
}

/// The connection that writes, opened at its first use.
pub(super) fn writer(options: SqliteConnectOptions) -> SqlitePool {
    lasting()
        .max_connections(1)
        // On a full disk SQLite ends a transaction itself, which the
        // connection does not notice; it could never begin another one.
        .before_acquire(|connection, _| {
            let usable = !connection.is_in_transaction();
            Box::pin(async move { Ok(usable) })
        })
        .connect_lazy_with(options)
}

/// Options of a connection that writes, with a largest size of the database [bytes].
pub(super) fn writing(path: &Path, largest_bytes: Option<u64>) -> SqliteConnectOptions {
    let options = common(path);
    match largest_bytes {
        None => options,
        Some(bytes) => options
            .page_size(PAGE_BYTES as u32)
            .pragma("max_page_count", (bytes / PAGE_BYTES).max(1).to_string()),
    }
}

fn common(path: &Path) -> SqliteConnectOptions {
    SqliteConnectOptions::new()
        .filename(path)
        .journal_mode(SqliteJournalMode::Wal)
        .synchronous(SqliteSynchronous::Full)
        .foreign_keys(true)
        .busy_timeout(BUSY_TIMEOUT)
        // A log that grew under a saved state is truncated again.
        .pragma("journal_size_limit", LOG_BYTES.to_string())
}
