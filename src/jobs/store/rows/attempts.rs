//! The attempts at a job.

use super::broken;
use crate::jobs::job::Attempt;
use crate::jobs::store::StoreError;
use jiff::Timestamp;
use sqlx::FromRow;

/// An attempt at a job.
#[derive(Debug, FromRow)]
pub(in super::super) struct AttemptRow {
    attempt: i64,
    owner: String,
    started_ms: i64,
    resumed_from_s: Option<f64>,
    ended_ms: Option<i64>,
    ending: Option<String>,
    detail: Option<String>,
}

impl AttemptRow {
    pub(in super::super) fn read(self, job: &str) -> Result<Attempt, StoreError> {
        let time =
            |ms| Timestamp::from_millisecond(ms).map_err(|_| broken(job, "an attempt's time"));
        Ok(Attempt {
            attempt: u32::try_from(self.attempt).map_err(|_| broken(job, "attempt"))?,
            owner: self.owner,
            started: time(self.started_ms)?,
            resumed_from_s: self.resumed_from_s,
            ended: self.ended_ms.map(time).transpose()?,
            ending: self.ending,
            detail: self.detail,
        })
    }
}
