//! Changes of state, in order.

use super::SqliteStore;
use super::error::Answer;
use crate::jobs::job::JobId;
use crate::jobs::store::Event;
use crate::jobs::store::event::EVENTS_AT_ONCE;
use crate::jobs::store::rows::EventRow;

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
        let events: Result<_, _> = rows.into_iter().map(EventRow::read).collect();
        Ok(events?)
    }

    pub(super) async fn last_event(&self) -> Answer<i64> {
        let last = sqlx::query_scalar("SELECT seq FROM sqlite_sequence WHERE name = 'events'");
        let last: Option<i64> = last.fetch_optional(self.readers.pool()).await?;
        Ok(last.unwrap_or(0))
    }
}
