//! The life of a job: submitted, claimed, ended. The row is the queue.

use super::rows::integer;
use super::{Hold, Store, StoreError};
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::submit::NewJob;
use jiff::Timestamp;
use sqlx::FromRow;

/// A job that a worker just took up.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The worker's hold on it.
    pub hold: Hold,
    /// The scenario's JSON.
    pub scenario: String,
}

/// What became of a wish to dismiss a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dismissal {
    /// There is no such job.
    Unknown,
    /// It is dismissed, now or since before.
    Dismissed,
    /// It had ended otherwise.
    Ended(JobStatus),
}

#[derive(Debug, FromRow)]
struct ClaimedRow {
    id: String,
    attempt: i64,
    scenario: String,
}

impl Store {
    /// Puts a job into the queue; it is on disk when this returns.
    ///
    /// # Errors
    /// The database's own.
    pub async fn submit(&self, job: &NewJob) -> Result<(), StoreError> {
        let mut transaction = self.begin().await?;
        sqlx::query(
            "INSERT INTO jobs (id, created_ms, scenario, title, bodies, solver_version)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
        )
        .bind(job.id.to_string())
        .bind(Timestamp::now().as_millisecond())
        .bind(&job.scenario)
        .bind(&job.title)
        .bind(integer(job.bodies as u64))
        .bind(job.solver_version)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(())
    }

    /// Takes up the oldest accepted job for a worker with this solver.
    ///
    /// # Errors
    /// The database's own.
    pub async fn claim(&self, solver_version: &str) -> Result<Option<Claim>, StoreError> {
        let mut transaction = self.begin().await?;
        let row: Option<ClaimedRow> = sqlx::query_as(
            "UPDATE jobs
             SET status = 'running', started_ms = ?1, solver_version = ?2, attempt = attempt + 1
             WHERE sequence = (SELECT min(sequence) FROM jobs WHERE status = 'accepted')
             RETURNING id, attempt, scenario",
        )
        .bind(Timestamp::now().as_millisecond())
        .bind(solver_version)
        .fetch_optional(&mut *transaction)
        .await?;
        transaction.commit().await?;
        row.map(ClaimedRow::read).transpose()
    }

    /// Whether the job is still running under this hold.
    ///
    /// # Errors
    /// The database's own.
    pub async fn is_running(&self, hold: Hold) -> Result<bool, StoreError> {
        let running: bool = sqlx::query_scalar(
            "SELECT EXISTS (SELECT 1 FROM jobs WHERE id = ?1 AND attempt = ?2 AND status = 'running')",
        )
        .bind(hold.job.to_string())
        .bind(hold.attempt)
        .fetch_one(&self.writer)
        .await?;
        Ok(running)
    }

    /// Dismisses a job. A worker that runs it finds out at its next write; the
    /// caller tells it sooner.
    ///
    /// # Errors
    /// The database's own.
    pub async fn dismiss(&self, id: JobId) -> Result<Dismissal, StoreError> {
        let mut transaction = self.begin().await?;
        let word: Option<String> = sqlx::query_scalar("SELECT status FROM jobs WHERE id = ?1")
            .bind(id.to_string())
            .fetch_optional(&mut *transaction)
            .await?;
        let Some(word) = word else {
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
            "UPDATE jobs SET status = 'dismissed', finished_ms = ?2, eta_s = NULL WHERE id = ?1",
        )
        .bind(id.to_string())
        .bind(Timestamp::now().as_millisecond())
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(Dismissal::Dismissed)
    }
}

impl ClaimedRow {
    fn read(self) -> Result<Claim, StoreError> {
        Ok(Claim {
            hold: hold(&self.id, self.attempt)?,
            scenario: self.scenario,
        })
    }
}

pub(super) fn hold(id: &str, attempt: i64) -> Result<Hold, StoreError> {
    let broken = |what| StoreError::Row {
        job: id.to_owned(),
        what,
    };
    Ok(Hold {
        job: id.parse().map_err(|_| broken("id"))?,
        attempt: u32::try_from(attempt).map_err(|_| broken("attempt"))?,
    })
}
