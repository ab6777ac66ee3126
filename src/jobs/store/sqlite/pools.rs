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
    /// Beside one that writes.
    shared: Reading,
    /// To a file that nobody can write, nor its log beside it.
    immutable: Option<Reading>,
    written: AtomicBool,
}

/// Connections that read in one way.
#[derive(Debug)]
struct Reading {
    clients: SqlitePool,
    /// The one for the operator's questions, which don't wait for the clients'.
    operator: SqlitePool,
}

impl Reading {
    fn new(options: SqliteConnectOptions) -> Self {
        Self {
            clients: lasting()
                .max_connections(READERS)
                .connect_lazy_with(options.clone()),
            operator: lasting().max_connections(1).connect_lazy_with(options),
        }
    }

    /// Connections of which one has read.
    async fn tried(options: SqliteConnectOptions) -> Result<Self, sqlx::Error> {
        let reading = Self::new(options);
        sqlx::query("SELECT count(*) FROM sqlite_schema")
            .execute(&reading.clients)
            .await?;
        Ok(reading)
    }

    async fn close(&self) {
        self.clients.close().await;
        self.operator.close().await;
    }
}

impl Readers {
    pub(super) async fn open(path: &Path) -> Result<Self, StoreError> {
        let options = common(path).read_only(true);
        let (shared, immutable) = match Reading::tried(options.clone()).await {
            Ok(shared) => (shared, None),
            Err(_) if is_complete(path) => {
                let alone = Reading::tried(immutable(path)).await;
                let alone = alone.map_err(SqliteError::from)?;
                (Reading::new(options), Some(alone))
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
        &self.current().clients
    }

    /// The connection to read by now for the operator.
    pub(super) fn operator(&self) -> &SqlitePool {
        &self.current().operator
    }

    fn current(&self) -> &Reading {
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

/// Connections that stay open: the write-ahead log goes with the last one, and another one could
/// not be told from one that was put in its place.
fn lasting() -> SqlitePoolOptions {
    SqlitePoolOptions::new()
        .idle_timeout(None)
        .max_lifetime(None)
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

/// Options of a connection that writes.
pub(super) fn writing(path: &Path) -> SqliteConnectOptions {
    common(path).page_size(PAGE_BYTES as u32)
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
