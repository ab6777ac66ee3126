//! Changes of state.

use super::{broken, job_id};
use crate::jobs::store::event::Change;
use crate::jobs::store::{Event, StoreError};
use sqlx::FromRow;

/// A change of a job.
#[derive(Debug, FromRow)]
pub(in super::super) struct EventRow {
    sequence: i64,
    job_id: String,
    status: String,
    attempt: i64,
}

impl EventRow {
    pub(in super::super) fn read(self) -> Result<Event, StoreError> {
        let job = job_id(&self.job_id)?;
        let broken = |what| broken(&self.job_id, what);
        Ok(Event {
            sequence: self.sequence,
            job,
            change: Change::from_word(&self.status).ok_or_else(|| broken("status"))?,
            attempt: u32::try_from(self.attempt).map_err(|_| broken("attempt"))?,
        })
    }
}
