//! The life of a job: submission, claim, dismissal. The table of jobs is the queue.

use super::ending::{BACK_OFF_MS, LONGEST_BACK_OFF_MS};
use super::history::{begin_attempt, end_attempt};
use super::lease::milliseconds;
use super::{Lease, Store, StoreError};
use crate::jobs::job::{JobId, JobStatus};
use sqlx::FromRow;
use std::time::Duration;

/// Claimant of jobs, and the terms of its claims.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claimant {
    /// Name of the service; its next start reclaims at once the jobs it left running.
    pub owner: String,
    /// Duration of a lease unless it is renewed.
    pub lease_duration: Duration,
    /// Program that runs the jobs.
    pub solver: Solver,
    /// Uptime of the service.
    pub up_for: Duration,
}

/// The program that runs a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Solver {
    /// Version of the solver.
    pub version: &'static str,
    /// Commit the program was built from.
    pub commit: &'static str,
    /// Instruction set of its kernels.
    pub instructions: &'static str,
}

/// A job that a worker has just claimed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The worker's lease.
    pub lease: Lease,
    /// The scenario's JSON.
    pub scenario: String,
    /// Failed attempts in a row before this attempt.
    pub setbacks: u32,
}

/// Result of a request to dismiss a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dismissal {
    /// The job does not exist.
    Unknown,
    /// The job is dismissed, by this or an earlier request.
    Dismissed,
    /// The job had already ended in this state.
    Ended(JobStatus),
}

#[derive(Debug, FromRow)]
struct ClaimedRow {
    id: String,
    attempt: i64,
    lease_token: i64,
    scenario: String,
    setbacks: u32,
}

impl Store {
    /// Claims the oldest accepted job that need not wait after a failed attempt. A job with
    /// failed attempts waits until the service has been up for its waiting time, so that
    /// a service that keeps crashing sooner does not fail the job.
    ///
    /// # Errors
    /// The database's own.
    pub async fn claim(&self, claimant: &Claimant) -> Result<Option<Claim>, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let row: Option<ClaimedRow> = sqlx::query_as(
            "UPDATE jobs
             SET status = 'running', started_ms = ?1, solver_version = ?2, attempt = attempt + 1,
                 solver_commit = ?6, instructions = ?7,
                 lease_owner = ?3, lease_expires_ms = ?4, lease_token = lease_token + 1
             WHERE sequence = (SELECT min(sequence) FROM jobs WHERE status = 'accepted'
                               AND (not_before_ms <= ?1 OR not_before_ms > ?5)
                               AND (setbacks = 0 OR ?8 >= iif(setbacks = 1, ?9, ?10)))
             RETURNING id, attempt, lease_token, scenario, setbacks",
        )
        .bind(now_ms)
        .bind(claimant.solver.version)
        .bind(&claimant.owner)
        .bind(now_ms + milliseconds(claimant.lease_duration))
        .bind(now_ms + LONGEST_BACK_OFF_MS)
        .bind(claimant.solver.commit)
        .bind(claimant.solver.instructions)
        .bind(milliseconds(claimant.up_for))
        .bind(BACK_OFF_MS[0])
        .bind(BACK_OFF_MS[1])
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(claim) = row.map(ClaimedRow::read).transpose()? else {
            return Ok(None);
        };
        begin_attempt(&mut transaction, claim.lease, &claimant.owner, now_ms).await?;
        transaction.commit().await?;
        Ok(Some(claim))
    }

    /// Dismisses a job. A worker that runs it notices at its next write or
    /// heartbeat; the caller notifies it sooner.
    ///
    /// # Errors
    /// The database's own.
    pub async fn dismiss(&self, id: JobId) -> Result<Dismissal, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let row: Option<(String, i64, i64)> =
            sqlx::query_as("SELECT status, attempt, lease_token FROM jobs WHERE id = ?1")
                .bind(id.to_string())
                .fetch_optional(&mut *transaction)
                .await?;
        let Some((word, attempt, token)) = row else {
            return Ok(Dismissal::Unknown);
        };
        let status = JobStatus::from_word(&word).ok_or_else(|| StoreError::Row {
            job: id.to_string(),
            what: "status",
        })?;
        match status {
            JobStatus::Dismissed => return Ok(Dismissal::Dismissed),
            JobStatus::Successful | JobStatus::Failed => return Ok(Dismissal::Ended(status)),
            JobStatus::Accepted | JobStatus::Running => {}
        }
        sqlx::query(
            "UPDATE jobs
             SET status = 'dismissed', finished_ms = ?2, eta_s = NULL,
                 lease_owner = NULL, lease_expires_ms = NULL
             WHERE id = ?1",
        )
        .bind(id.to_string())
        .bind(now_ms)
        .execute(&mut *transaction)
        .await?;
        let lease = lease(&id.to_string(), attempt, token)?;
        end_attempt(&mut transaction, lease, now_ms, ("dismissed", None)).await?;
        transaction.commit().await?;
        Ok(Dismissal::Dismissed)
    }
}

impl ClaimedRow {
    fn read(self) -> Result<Claim, StoreError> {
        Ok(Claim {
            lease: lease(&self.id, self.attempt, self.lease_token)?,
            scenario: self.scenario,
            setbacks: self.setbacks,
        })
    }
}

pub(super) fn lease(id: &str, attempt: i64, token: i64) -> Result<Lease, StoreError> {
    let broken = |what| StoreError::Row {
        job: id.to_owned(),
        what,
    };
    Ok(Lease {
        job: id.parse().map_err(|_| broken("id"))?,
        attempt: u32::try_from(attempt).map_err(|_| broken("attempt"))?,
        token,
    })
}
