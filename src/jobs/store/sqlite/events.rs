//! Changes of state, in order.

use super::SqliteStore;
use super::error::Answer;
use crate::jobs::job::JobId;
use crate::jobs::store::event::{Change, EVENTS_AT_ONCE};
use crate::jobs::store::{Event, StoreError};
use sqlx::FromRow;

#[derive(Debug, FromRow)]
struct EventRow {
    sequence: i64,
    job_id: String,
    status: String,
    attempt: u32,
}

impl SqliteStore {
    pub(super) async fn events(&self, after: i64, job: Option<JobId>) -> Answer<Vec<Event>> {
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
        let rows: Vec<EventRow> = query.fetch_all(self.readers.pool()).await?;
        rows.into_iter().map(EventRow::read).collect()
    }

    pub(super) async fn last_event(&self) -> Answer<i64> {
        let last = sqlx::query_scalar("SELECT seq FROM sqlite_sequence WHERE name = 'events'");
        let last: Option<i64> = last.fetch_optional(self.readers.pool()).await?;
        Ok(last.unwrap_or(0))
    }
}

impl EventRow {
    fn read(self) -> Answer<Event> {
        let broken = |what| StoreError::Row {
            job: self.job_id.clone(),
            what,
        };
        Ok(Event {
            sequence: self.sequence,
            job: self.job_id.parse().map_err(|_| broken("id"))?,
            change: Change::from_word(&self.status).ok_or_else(|| broken("status"))?,
            attempt: self.attempt,
        })
    }
}
