//! The life of a job: submitted, claimed, ended. The row is the queue.

use super::rows::integer;
use super::{Hold, Store, StoreError};
use crate::jobs::failure::Failure;
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::progress::Progress;
use crate::jobs::submit::NewJob;
use jiff::Timestamp;
use sqlx::FromRow;
use sqlx::sqlite::SqliteConnection;

/// How often the process may die under a job before the job fails: a scenario
/// that takes the service down must not do so for ever.
pub const TOLERATED_CUT_OFFS: u32 = 3;

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

    /// Ends a running job with its outcome. `false` if it no longer runs under
    /// this hold.
    ///
    /// # Errors
    /// The database's own.
    pub async fn succeed(&self, hold: Hold, outcome: &str) -> Result<bool, StoreError> {
        let mut transaction = self.begin().await?;
        let done = sqlx::query(
            "UPDATE jobs
             SET status = 'successful', finished_ms = ?3, outcome = ?4, fraction = 1, eta_s = NULL
             WHERE id = ?1 AND attempt = ?2 AND status = 'running'",
        )
        .bind(hold.job.to_string())
        .bind(hold.attempt)
        .bind(Timestamp::now().as_millisecond())
        .bind(outcome)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(done.rows_affected() == 1)
    }

    /// Ends a running job without an answer. `false` if it no longer runs under
    /// this hold.
    ///
    /// # Errors
    /// The database's own.
    pub async fn fail(&self, hold: Hold, failure: &Failure) -> Result<bool, StoreError> {
        let mut transaction = self.begin().await?;
        let done = fail_row(&mut transaction, hold, failure).await?;
        transaction.commit().await?;
        Ok(done)
    }

    /// Puts a running job back into the queue, to be run again from its start:
    /// what it recorded is removed. `false` if it no longer runs under this
    /// hold, which leaves everything as it is.
    ///
    /// # Errors
    /// The database's own.
    pub async fn put_back(&self, hold: Hold) -> Result<bool, StoreError> {
        let mut transaction = self.begin().await?;
        let done = put_back_row(&mut transaction, hold, 0).await?;
        transaction.commit().await?;
        Ok(done)
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

    /// Takes care of jobs that a former process left running: it died under
    /// them. They go back into the queue, or fail if that happened too often.
    /// Returns how many there were.
    ///
    /// # Errors
    /// The database's own.
    pub async fn recover(&self) -> Result<usize, StoreError> {
        let mut transaction = self.begin().await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, attempt, cut_offs FROM jobs WHERE status = 'running' ORDER BY sequence",
        )
        .fetch_all(&mut *transaction)
        .await?;
        for (id, attempt, cut_offs) in &left {
            let hold = hold(id, *attempt)?;
            let cut_offs = u32::try_from(cut_offs + 1).unwrap_or(u32::MAX);
            if cut_offs < TOLERATED_CUT_OFFS {
                put_back_row(&mut transaction, hold, 1).await?;
            } else {
                fail_row(&mut transaction, hold, &Failure::cut_off(cut_offs)).await?;
            }
        }
        transaction.commit().await?;
        Ok(left.len())
    }

    /// Keeps the progress of a job that this hold still owns.
    pub(super) async fn keep_progress(
        connection: &mut SqliteConnection,
        hold: Hold,
        progress: &Progress,
    ) -> Result<bool, StoreError> {
        let done = sqlx::query(
            "UPDATE jobs
             SET fraction = ?3, simulated_time_s = ?4, steps = ?5, substeps = ?6,
                 point_steps_per_s = ?7, eta_s = iif(status = 'running', ?8, NULL)
             WHERE id = ?1 AND attempt = ?2 AND status IN ('running', 'dismissed')",
        )
        .bind(hold.job.to_string())
        .bind(hold.attempt)
        .bind(progress.fraction)
        .bind(progress.simulated_time_s)
        .bind(integer(progress.steps))
        .bind(integer(progress.substeps))
        .bind(progress.point_steps_per_s)
        .bind(progress.eta_s)
        .execute(connection)
        .await?;
        Ok(done.rows_affected() == 1)
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

fn hold(id: &str, attempt: i64) -> Result<Hold, StoreError> {
    let broken = |what| StoreError::Row {
        job: id.to_owned(),
        what,
    };
    Ok(Hold {
        job: id.parse().map_err(|_| broken("id"))?,
        attempt: u32::try_from(attempt).map_err(|_| broken("attempt"))?,
    })
}

async fn fail_row(
    connection: &mut SqliteConnection,
    hold: Hold,
    failure: &Failure,
) -> Result<bool, StoreError> {
    let problem = serde_json::to_string(failure).map_err(|_| StoreError::Row {
        job: hold.job.to_string(),
        what: "failure",
    })?;
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'failed', finished_ms = ?3, problem = ?4, eta_s = NULL
         WHERE id = ?1 AND attempt = ?2 AND status = 'running'",
    )
    .bind(hold.job.to_string())
    .bind(hold.attempt)
    .bind(Timestamp::now().as_millisecond())
    .bind(problem)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}

async fn put_back_row(
    connection: &mut SqliteConnection,
    hold: Hold,
    cut_offs: u32,
) -> Result<bool, StoreError> {
    let id = hold.job.to_string();
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'accepted', started_ms = NULL, cut_offs = cut_offs + ?3, fraction = 0,
             simulated_time_s = 0, steps = 0, substeps = 0, point_steps_per_s = 0, eta_s = NULL
         WHERE id = ?1 AND attempt = ?2 AND status = 'running'",
    )
    .bind(&id)
    .bind(hold.attempt)
    .bind(cut_offs)
    .execute(&mut *connection)
    .await?;
    if done.rows_affected() == 0 {
        return Ok(false);
    }
    for statement in [
        "DELETE FROM trajectory_chunks WHERE job_id = ?1",
        "DELETE FROM flow_snapshots WHERE job_id = ?1",
    ] {
        sqlx::query(statement)
            .bind(&id)
            .execute(&mut *connection)
            .await?;
    }
    Ok(true)
}
