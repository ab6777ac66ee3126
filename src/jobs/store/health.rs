//! Health and size of the database.

use super::{Store, StoreError};
use crate::jobs::job::JobStatus;

/// Space whose lack means that the database can't store a job [bytes].
const PROBED_ROOM: u32 = 65_536;

/// Kind of a database error, by the person who can act on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoreErrorKind {
    /// The disk is full, or the database has reached its own limit.
    Full,
    /// The database can't be read or written now.
    Unavailable,
    /// A defect.
    Defect,
}

/// Numbers of jobs.
#[derive(Debug, Clone, PartialEq)]
pub struct JobCounts {
    /// Jobs of each state, in the order of [`JobStatus::ALL`].
    pub jobs: [(JobStatus, u64); 5],
    /// Number of ended attempts, by kind of end.
    pub attempts: Vec<(String, u64)>,
    /// Length of the database [bytes].
    pub database_bytes: u64,
    /// Time that the oldest waiting job has waited [s]; 0 if none waits.
    pub oldest_waiting_s: f64,
}

impl StoreError {
    /// Kind of the error.
    pub fn kind(&self) -> StoreErrorKind {
        let Self::Database(error) = self else {
            return match self {
                Self::Refused => StoreErrorKind::Unavailable,
                _ => StoreErrorKind::Defect,
            };
        };
        let code = error.as_database_error().and_then(|error| {
            let code: i32 = error.code()?.parse().ok()?;
            // The lowest byte of an extended code is the primary one.
            Some(code & 0xff)
        });
        match (code, error) {
            (Some(SQLITE_FULL), _) => StoreErrorKind::Full,
            (Some(code), _) if UNAVAILABLE.contains(&code) => StoreErrorKind::Unavailable,
            (None, sqlx::Error::PoolTimedOut | sqlx::Error::PoolClosed | sqlx::Error::Io(_)) => {
                StoreErrorKind::Unavailable
            }
            _ => StoreErrorKind::Defect,
        }
    }
}

const SQLITE_FULL: i32 = 13;

/// BUSY, LOCKED, READONLY, IOERR, CORRUPT, CANTOPEN, NOTADB.
const UNAVAILABLE: [i32; 7] = [5, 6, 8, 10, 11, 14, 26];

impl Store {
    /// Checks that the database answers.
    ///
    /// # Errors
    /// The database does not answer.
    pub async fn ping(&self) -> Result<(), StoreError> {
        sqlx::query("SELECT 1").execute(&self.readers).await?;
        Ok(())
    }

    /// Checks that a job could be stored: allocates space for one, and writes to the disk.
    ///
    /// # Errors
    /// A job could not be stored.
    pub async fn probe(&self) -> Result<(), StoreError> {
        let mut transaction = self.begin_write().await?;
        sqlx::query(
            "INSERT OR REPLACE INTO probes (id, written_ms, room) VALUES (1, ?1, zeroblob(?2))",
        )
        .bind(self.now_ms())
        .bind(PROBED_ROOM)
        .execute(&mut *transaction)
        .await?;
        sqlx::query("UPDATE probes SET room = x''")
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Counts jobs.
    ///
    /// # Errors
    /// The database's own.
    pub async fn count_jobs(&self) -> Result<JobCounts, StoreError> {
        let counts: Vec<(String, i64)> =
            sqlx::query_as("SELECT status, count(*) FROM jobs GROUP BY status")
                .fetch_all(&self.readers)
                .await?;
        let count = |status: JobStatus| {
            let found = counts.iter().find(|(word, _)| word == status.word());
            found.map_or(0, |(_, count)| count.unsigned_abs())
        };
        let attempts: Vec<(String, i64)> = sqlx::query_as(
            "SELECT ending, count(*) FROM attempts WHERE ending IS NOT NULL GROUP BY ending",
        )
        .fetch_all(&self.readers)
        .await?;
        let oldest_waiting_ms: Option<i64> = sqlx::query_scalar(
            "SELECT created_ms FROM jobs WHERE status = 'accepted' ORDER BY sequence LIMIT 1",
        )
        .fetch_optional(&self.readers)
        .await?;
        let pages: i64 = sqlx::query_scalar(
            "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size",
        )
        .fetch_one(&self.readers)
        .await?;
        Ok(JobCounts {
            jobs: JobStatus::ALL.map(|status| (status, count(status))),
            database_bytes: pages.unsigned_abs(),
            attempts: attempts
                .into_iter()
                .map(|(ending, count)| (ending, count.unsigned_abs()))
                .collect(),
            oldest_waiting_s: oldest_waiting_ms.map_or(0.0, |since| {
                // A clock that was set back must not give a negative age.
                ((self.now_ms() - since) as f64 * 1e-3).max(0.0)
            }),
        })
    }
}
