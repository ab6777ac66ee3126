//! Changes of state, in order.

use super::PostgresStore;
use super::error::Answer;
use super::locks::Turn;
use crate::jobs::job::JobId;
use crate::jobs::store::Event;
use crate::jobs::store::event::EVENTS_AT_ONCE;
use crate::jobs::store::rows::EventRow;

/// Largest number of events numbered in one transaction.
const NUMBERED_AT_ONCE: i64 = 10_000;

impl PostgresStore {
    pub(super) async fn events(&self, after: i64, job: Option<JobId>) -> Answer<Vec<Event>> {
        self.number_events().await?;
        let query = match job {
            None => sqlx::query_as(
                "SELECT sequence, job_id::text AS job_id, status, attempt FROM events
                 WHERE sequence > $1 ORDER BY sequence LIMIT $2",
            ),
            Some(_) => sqlx::query_as(
                "SELECT sequence, job_id::text AS job_id, status, attempt FROM events
                 WHERE job_id = $3::uuid AND sequence > $1 ORDER BY sequence LIMIT $2",
            ),
        };
        let mut query = query.bind(after).bind(i64::from(EVENTS_AT_ONCE));
        if let Some(job) = job {
            query = query.bind(job.to_string());
        }
        let rows: Vec<EventRow> = query.fetch_all(&self.pool).await?;
        let events: Result<_, _> = rows.into_iter().map(EventRow::read).collect();
        Ok(events?)
    }

    pub(super) async fn last_event(&self) -> Answer<i64> {
        self.number_events().await?;
        let last = sqlx::query_scalar("SELECT sequence FROM last_event");
        Ok(last.fetch_one(&self.pool).await?)
    }

    /// Numbers all events that had been written by now, in the order of their places. Those of one job
    /// are written one after the other, with its row locked, so they keep their order.
    async fn number_events(&self) -> Answer<()> {
        while self.has_events_to_number().await? {
            let mut transaction = self.begin_in_turn(Turn::Numbering).await?;
            let numbered: i64 = sqlx::query_scalar(
                "WITH new AS (
                     SELECT place, row_number() OVER (ORDER BY place) AS number FROM events
                     WHERE sequence IS NULL ORDER BY place LIMIT $1
                 ), numbered AS (
                     UPDATE events SET sequence = last_event.sequence + new.number
                     FROM new, last_event WHERE events.place = new.place
                     RETURNING events.sequence
                 )
                 UPDATE last_event
                 SET sequence = greatest(sequence, (SELECT max(numbered.sequence) FROM numbered))
                 RETURNING (SELECT count(*) FROM numbered)",
            )
            .bind(NUMBERED_AT_ONCE)
            .fetch_one(&mut *transaction)
            .await?;
            transaction.commit().await?;
            // What comes meanwhile is left to the next reader, or this one would never end.
            if numbered < NUMBERED_AT_ONCE {
                break;
            }
        }
        Ok(())
    }

    async fn has_events_to_number(&self) -> Answer<bool> {
        let any = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM events WHERE sequence IS NULL)");
        Ok(any.fetch_one(&self.pool).await?)
    }
}
