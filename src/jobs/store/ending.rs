//! How running jobs end, or go back to where they came from.

use super::queue::hold;
use super::{Hold, Store, StoreError};
use crate::jobs::failure::Failure;
use jiff::Timestamp;
use sqlx::sqlite::SqliteConnection;

/// How often the process may die under a job before the job fails: a scenario
/// that takes the service down must not do so for ever.
pub const TOLERATED_CUT_OFFS: u32 = 3;

impl Store {
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
