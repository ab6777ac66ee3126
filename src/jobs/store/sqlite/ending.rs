//! Ends of running jobs: success, failure, release, failed attempts.

use super::error::Answer;
use super::history::end_attempt;
use super::size_limit::Purpose;
use super::{Now, SqliteStore};
use crate::jobs::failure::Failure;
use crate::jobs::store::ending::{Consequence, Reached};
use crate::jobs::store::{FailedAttempt, Lease, Returned, StoreError};
use sqlx::sqlite::SqliteConnection;

impl SqliteStore {
    pub(super) async fn succeed(
        &self,
        lease: Lease,
        outcome: &str,
        fingerprint: &str,
    ) -> Answer<bool> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let done = sqlx::query(
            "UPDATE jobs
             SET status = 'successful', finished_ms = ?3, ended_operating_ms = ?6, outcome = ?4,
                 fingerprint = ?5,
                 fraction = 1, eta_s = NULL, lease_owner = NULL, lease_expires_operating_ms = NULL
             WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
        )
        .bind(lease.job.to_string())
        .bind(lease.token)
        .bind(now.wall_ms)
        .bind(outcome)
        .bind(fingerprint)
        .bind(now.operating_ms)
        .execute(&mut *transaction)
        .await?;
        if done.rows_affected() == 0 {
            return Ok(false);
        }
        end_attempt(&mut transaction, lease, now.wall_ms, ("successful", None)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    pub(super) async fn fail(&self, lease: Lease, failure: &Failure) -> Answer<bool> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let done = fail_row(&mut transaction, lease, failure, now).await?;
        if done {
            let ending = ("failed", Some(failure.detail.as_str()));
            end_attempt(&mut transaction, lease, now.wall_ms, ending).await?;
        }
        transaction.commit().await?;
        Ok(done)
    }

    pub(super) async fn release(&self, lease: Lease) -> Answer<bool> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let done = put_back_row(&mut transaction, lease, 0, 0).await?;
        if done {
            end_attempt(&mut transaction, lease, now_ms, ("handed-back", None)).await?;
        }
        transaction.commit().await?;
        Ok(done)
    }

    pub(super) async fn fail_attempt(
        &self,
        lease: Lease,
        failed_attempt: &FailedAttempt,
    ) -> Answer<Returned> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let returned = set_back_row(&mut transaction, lease, failed_attempt, self.now()).await?;
        transaction.commit().await?;
        Ok(returned)
    }
}

pub(super) async fn set_back_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    failed_attempt: &FailedAttempt,
    now: Now,
) -> Answer<Returned> {
    let found: Option<(u32, bool)> = sqlx::query_as(
        "SELECT failed_attempts, EXISTS (SELECT 1 FROM run_states WHERE job_id = ?1 AND attempt = ?3)
         FROM jobs WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(lease.attempt)
    .fetch_optional(&mut *connection)
    .await?;
    let Some((before, got_on)) = found else {
        return Ok(Returned::Lost);
    };
    end_attempt(
        connection,
        lease,
        now.wall_ms,
        (failed_attempt.word(), failed_attempt.detail()),
    )
    .await?;
    match failed_attempt.consequence(before, Reached::of(true, got_on)) {
        Consequence::Waits {
            failed_attempts,
            wait_ms,
        } => {
            put_back_row(
                connection,
                lease,
                failed_attempts,
                now.operating_ms + wait_ms,
            )
            .await?;
            Ok(Returned::Waiting)
        }
        Consequence::Fails(failure) => {
            fail_row(connection, lease, &failure, now).await?;
            Ok(Returned::Failed)
        }
    }
}

async fn fail_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    failure: &Failure,
    now: Now,
) -> Answer<bool> {
    let problem = serde_json::to_string(failure).map_err(|_| StoreError::Row {
        job: lease.job.to_string(),
        what: "failure",
    })?;
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'failed', finished_ms = ?3, ended_operating_ms = ?5, problem = ?4,
             eta_s = NULL,
             lease_owner = NULL, lease_expires_operating_ms = NULL
         WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(now.wall_ms)
    .bind(problem)
    .bind(now.operating_ms)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}

/// Puts a running job back into the queue. Its progress is kept if the next
/// attempt can resume from a saved state.
async fn put_back_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    failed_attempts: u32,
    not_before_operating_ms: i64,
) -> Answer<bool> {
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'accepted', started_ms = NULL, failed_attempts = failed_attempts + ?3,
             not_before_operating_ms = ?4, lease_owner = NULL, lease_expires_operating_ms = NULL,
             lease_token = lease_token + 1, point_steps_per_s = 0, eta_s = NULL,
             (fraction, simulated_time_s, steps, substeps) = (
                 SELECT iif(saved, fraction, 0), iif(saved, simulated_time_s, 0),
                        iif(saved, steps, 0), iif(saved, substeps, 0)
                 FROM (SELECT EXISTS (SELECT 1 FROM run_states WHERE job_id = ?1) AS saved)
             )
         WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(failed_attempts)
    .bind(not_before_operating_ms)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}
