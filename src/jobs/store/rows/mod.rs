//! Rows of the tables as every driver selects and reads them, and their conversion. Whole numbers are 64 bits
//! long in each database, so that one type of row serves all.

mod attempts;
mod events;
mod jobs;
mod keyed_requests;
mod pages;
mod records;
mod studies;
mod terrains;

pub(super) use attempts::AttemptRow;
pub(super) use events::EventRow;
pub(super) use jobs::{JobRow, ListedRow};
pub(super) use keyed_requests::{KeyedRequestRow, identifiers_text, pack_answer, space};
pub(super) use pages::{page_of, push_newest};
pub(super) use records::{
    ChunkRow, MapRow, SnapshotRow, StateRow, chunk_of, map_of, snapshot_of, state_of,
};
pub(super) use studies::{
    EndedRow, MemberRow, StudyRow, counts, former_study, made_by_level, member_outcome,
    parse_study, study_status,
};
pub(super) use terrains::{TerrainRow, terrain_is_gone};

use super::{Claim, Lease, StoreError};
use crate::jobs::job::{JobId, JobStatus};
use sqlx::FromRow;
use std::time::Duration;

/// A job that has just been claimed.
#[derive(Debug, FromRow)]
pub(super) struct ClaimedRow {
    id: String,
    attempt: i64,
    lease_token: i64,
    scenario: String,
    failed_attempts: i64,
    planned_work: i64,
}

impl ClaimedRow {
    pub(super) fn read(self) -> Result<Claim, StoreError> {
        Ok(Claim {
            lease: lease(&self.id, self.attempt, self.lease_token)?,
            failed_attempts: u32::try_from(self.failed_attempts)
                .map_err(|_| broken(&self.id, "failed attempts"))?,
            planned_work: self.planned_work.unsigned_abs(),
            scenario: self.scenario,
        })
    }
}

pub(super) fn lease(id: &str, attempt: i64, token: i64) -> Result<Lease, StoreError> {
    Ok(Lease {
        job: job_id(id)?,
        attempt: u32::try_from(attempt).map_err(|_| broken(id, "attempt"))?,
        token,
    })
}

pub(super) fn job_id(id: &str) -> Result<JobId, StoreError> {
    id.parse().map_err(|_| broken(id, "id"))
}

pub(super) fn job_status(id: &str, word: &str) -> Result<JobStatus, StoreError> {
    JobStatus::from_word(word).ok_or_else(|| broken(id, "status"))
}

/// A count as databases store it; counts of a run stay far below the limit.
pub(super) fn integer(count: u64) -> i64 {
    i64::try_from(count).unwrap_or(i64::MAX)
}

pub(super) fn milliseconds(duration: Duration) -> i64 {
    i64::try_from(duration.as_millis()).unwrap_or(i64::MAX / 4)
}

/// A length; the tables' CHECKs keep it from being negative.
fn length(stored: i64) -> usize {
    usize::try_from(stored).unwrap_or(0)
}

fn broken(job: &str, what: &'static str) -> StoreError {
    StoreError::Row {
        job: job.to_owned(),
        what,
    }
}
