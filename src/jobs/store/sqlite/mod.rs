//! Driver for SQLite: one file. All that knows SQL, connections and migrations is in this
//! folder; each operation of the port is in the file of its subject, and [`JobStore`] says
//! what it must do.
//!
//! One connection writes, in transactions that take the write lock at once; a
//! few read-only connections read concurrently (write-ahead log). Every commit reaches
//! the disk before it is acknowledged (`synchronous=FULL`). A lock file beside the
//! database keeps a second service from using it.
//!
//! A database is inspected read-only before anything is written (`inspection.rs`). One that
//! can't be written is read all the same, and written as soon as it can be.
//!
//! [`JobStore`]: super::JobStore

pub mod backup;
mod ending;
mod error;
mod events;
mod file;
mod flow_maps;
mod health;
mod history;
mod inspection;
mod keyed_requests;
mod lease;
mod lock;
mod operating_time;
mod pages;
mod pools;
mod port;
mod queue;
mod read;
mod removal;
mod results;
mod schema;
mod size_limit;
mod space;
mod states;
mod studies;
mod study_members;
mod submission;
mod terrains;
#[cfg(test)]
pub(super) mod tests;
mod webhooks;

use super::{StoreError, StoreErrorKind};
use crate::jobs::clock::{Clock, SystemClock};
use error::Answer;
use file::{DatabaseFile, Location};
use inspection::{Inspected, Version, inspect};
use lock::Lock;
use operating_time::OperatingTime;
use pools::{Readers, writer, writing};
use size_limit::{Purpose, SizeLimit};
use sqlx::sqlite::SqlitePool;
use sqlx::{Sqlite, Transaction};
use std::path::Path;
use std::sync::Arc;

/// One moment, by both clocks.
#[derive(Debug, Clone, Copy)]
struct Now {
    /// Time of day, to be shown [ms].
    wall_ms: i64,
    /// Operating time, by which durations are measured [ms].
    operating_ms: i64,
}

/// The database of one service.
#[derive(Debug)]
pub struct SqliteStore {
    writer: SqlitePool,
    size_limit: SizeLimit,
    readers: Readers,
    clock: Arc<dyn Clock>,
    operating_time: OperatingTime,
    file: DatabaseFile,
    lock: Lock,
}

impl SqliteStore {
    /// Opens the database, creates it if it does not exist, and migrates it to this
    /// version's schema.
    ///
    /// # Errors
    /// Another service uses the database, or it can't be opened.
    pub async fn open(path: &Path) -> Result<Self, StoreError> {
        Self::open_with(path, None, Arc::new(SystemClock::default())).await
    }

    /// The same, with a largest size of the database [bytes] and a clock that
    /// may differ from the system's. A database of this version that can't be written is
    /// opened for reading, and written once it can be.
    ///
    /// # Errors
    /// Another service uses the database, or it can't be opened.
    pub async fn open_with(
        path: &Path,
        largest_bytes: Option<u64>,
        clock: Arc<dyn Clock>,
    ) -> Result<Self, StoreError> {
        let location = Location::of(path)?;
        let inspected = match location.found {
            Some(_) => inspect(&location.path).await?,
            None => Inspected::NOTHING,
        };
        let lock = Lock::of(&location.path);
        let locked = lock.take();
        if matches!(locked, Err(StoreError::InUse { .. })) || inspected.version == Version::Former {
            locked?;
        }
        location.warn_of_readers();
        let file = location.create_if_missing()?;
        let options = writing(file.path());
        if lock.is_held() {
            schema::prepare(&options, inspected).await?;
        }
        let readers = Readers::open(file.path()).await?;
        let operating_time = OperatingTime::resume(readers.pool(), Arc::clone(&clock)).await?;
        let store = Self {
            writer: writer(options),
            size_limit: SizeLimit(largest_bytes),
            readers,
            clock,
            operating_time,
            file,
            lock,
        };
        store.try_to_write().await?;
        Ok(store)
    }

    /// Writes, if it is possible. A database that is full or can't be written is still read.
    async fn try_to_write(&self) -> Result<(), StoreError> {
        let Err(error) = self.note_operating_time().await.map_err(StoreError::from) else {
            return Ok(());
        };
        match error.kind() {
            StoreErrorKind::Full | StoreErrorKind::Unavailable => {
                tracing::error!(%error, "the database can't be written now, only read");
                Ok(())
            }
            StoreErrorKind::Damaged | StoreErrorKind::Defect => Err(error),
        }
    }

    /// Closes the database: readers first, so that the writer, as the last connection,
    /// merges the write-ahead log into the file.
    pub(super) async fn close(&self) {
        if !self.writer.is_closed()
            && let Err(error) = self.note_operating_time().await.map_err(StoreError::from)
        {
            tracing::warn!(%error, "the end of operation can't be noted");
        }
        self.readers.close().await;
        self.writer.close().await;
        self.lock.release();
    }

    /// A transaction that has the write lock from its beginning, so that it
    /// can't fail half-way for lack of it. It is refused if what it writes would not be found
    /// under the database's name.
    async fn begin_write(&self, purpose: Purpose) -> Answer<Transaction<'static, Sqlite>> {
        self.file.check()?;
        let mut transaction = self.writer.begin_with("BEGIN IMMEDIATE").await?;
        self.size_limit.set(purpose, &mut *transaction).await?;
        self.lock.take()?;
        if let Err(error) = self.operating_time.note(&mut *transaction).await {
            drop(transaction);
            self.close_writer_if_read_only(&error).await;
            return Err(error);
        }
        self.file.check_with_log()?;
        self.readers.follow_writer();
        Ok(transaction)
    }

    /// A connection to a file that could not be written never writes, even once it can be.
    async fn close_writer_if_read_only(&self, error: &error::SqliteError) {
        if error.is_read_only()
            && let Ok(connection) = self.writer.acquire().await
            && let Err(error) = connection.close().await
        {
            tracing::warn!(%error, "a connection to the database can't be closed");
        }
    }

    async fn note_operating_time(&self) -> Answer<()> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        self.operating_time.note_last(&mut *transaction).await?;
        transaction.commit().await?;
        Ok(())
    }

    fn now(&self) -> Now {
        Now {
            wall_ms: self.now_ms(),
            operating_ms: self.operating_ms(),
        }
    }

    /// The time of day, as stored in rows [ms].
    fn now_ms(&self) -> i64 {
        self.clock.now().as_millisecond()
    }

    /// Operating time of the database [ms].
    fn operating_ms(&self) -> i64 {
        self.operating_time.now_ms()
    }
}
