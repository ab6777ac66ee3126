//! Changes of state, in order.

use super::{Store, StoreError};
use crate::jobs::job::{JobId, JobStatus};
use sqlx::FromRow;

/// Largest number of events read at once.
const EVENTS_AT_ONCE: u32 = 100;

/// Change of a job's state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// Sequence number of the event.
    pub sequence: i64,
    /// The job.
    pub job: JobId,
    /// New state of the job.
    pub status: JobStatus,
    /// Number of attempts by then.
    pub attempt: u32,
}

#[derive(Debug, FromRow)]
struct EventRow {
    sequence: i64,
    job_id: String,
    status: String,
    attempt: u32,
}

impl Store {
    /// The next events after number `after`, of one job or of all; at most a
    /// hundred.
    ///
    /// # Errors
    /// The database's own, or an unreadable row.
    pub async fn events(&self, after: i64, job: Option<JobId>) -> Result<Vec<Event>, StoreError> {
        let query = match job {
            None => sqlx::query_as(
                "SELECT sequence, job_id, status, attempt FROM events
                 WHERE sequence > ?1 ORDER BY sequence LIMIT ?2",
            ),
            Some(_) => sqlx::query_as(
                "SELECT sequence, job_id, status, attempt FROM events
                 WHERE job_id = ?3 AND sequence > ?1 ORDER BY sequence LIMIT ?2",
            ),
        };
        let mut query = query.bind(after).bind(EVENTS_AT_ONCE);
        if let Some(job) = job {
            query = query.bind(job.to_string());
        }
        let rows: Vec<EventRow> = query.fetch_all(&self.readers).await?;
        rows.into_iter().map(EventRow::read).collect()
    }

    /// Number of the last event ever, even if its job was removed; 0
    /// before the first.
    ///
    /// # Errors
    /// The database's own.
    pub async fn last_event(&self) -> Result<i64, StoreError> {
        let last = sqlx::query_scalar("SELECT seq FROM sqlite_sequence WHERE name = 'events'");
        let last: Option<i64> = last.fetch_optional(&self.readers).await?;
        Ok(last.unwrap_or(0))
    }
}

impl EventRow {
    fn read(self) -> Result<Event, StoreError> {
        let broken = |what| StoreError::Row {
            job: self.job_id.clone(),
            what,
        };
        Ok(Event {
            sequence: self.sequence,
            job: self.job_id.parse().map_err(|_| broken("id"))?,
            status: JobStatus::from_word(&self.status).ok_or_else(|| broken("status"))?,
            attempt: self.attempt,
        })
    }
}
