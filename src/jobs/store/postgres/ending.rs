//! Ends of running jobs: success, failure, release, failed attempts.

use super::error::Answer;
use super::history::end_attempt;
use super::news::Subject;
use super::{Now, PostgresStore};
use crate::jobs::failure::Failure;
use crate::jobs::store::ending::{Consequence, Reached};
use crate::jobs::store::{FailedAttempt, Lease, Returned, StoreError};
use sqlx::PgConnection;

impl PostgresStore {
    pub(super) async fn succeed(
        &self,
        lease: Lease,
        outcome: &str,
        fingerprint: &str,
    ) -> Answer<bool> {
        let now = self.now().await?;
        // One statement: of a short job this is a third of all that it costs the database.
        let done: i64 = sqlx::query_scalar(
            "WITH done AS (
                 UPDATE jobs
                 SET status = 'successful', finished_ms = $3, ended_operating_ms = $6,
                     outcome = $4, fingerprint = $5, fraction = 1, eta_s = NULL,
                     lease_owner = NULL, lease_expires_operating_ms = NULL
                 WHERE id = $1::uuid AND lease_token = $2 AND lease_expires_operating_ms IS NOT NULL
                 RETURNING id, attempt
             ), ended AS (
                 UPDATE attempts SET ended_ms = $3, ending = 'successful'
                 FROM done
                 WHERE job_id = done.id AND attempts.attempt = done.attempt AND ending IS NULL
             )
             SELECT count(*) FROM done",
        )
        .bind(lease.job.to_string())
        .bind(lease.token)
        .bind(now.wall_ms)
        .bind(outcome)
        .bind(fingerprint)
        .bind(now.operating_ms)
        .fetch_one(&self.pool)
        .await?;
        self.news.tell(&[Subject::Events]);
        Ok(done == 1)
    }

    pub(super) async fn fail(&self, lease: Lease, failure: &Failure) -> Answer<bool> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        let done = fail_row(&mut transaction, lease, failure, now).await?;
        if done {
            let ending = ("failed", Some(failure.detail.as_str()));
            end_attempt(&mut transaction, lease, now.wall_ms, ending).await?;
        }
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(done)
    }

    pub(super) async fn release(&self, lease: Lease) -> Answer<bool> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        let done = put_back_row(&mut transaction, lease, 0, 0).await?;
        if done {
            end_attempt(&mut transaction, lease, now.wall_ms, ("handed-back", None)).await?;
        }
        transaction.commit().await?;
        self.news.tell(&[Subject::Queue, Subject::Events]);
        Ok(done)
    }

    pub(super) async fn fail_attempt(
        &self,
        lease: Lease,
        failed_attempt: &FailedAttempt,
    ) -> Answer<Returned> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        let returned = set_back_row(&mut transaction, lease, failed_attempt, now).await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Queue, Subject::Events]);
        Ok(returned)
    }
}

pub(super) async fn set_back_row(
    connection: &mut PgConnection,
    lease: Lease,
    failed_attempt: &FailedAttempt,
    now: Now,
) -> Answer<Returned> {
    let found: Option<(i64, bool, bool)> = sqlx::query_as(
        "SELECT failed_attempts, begun,
                EXISTS (SELECT 1 FROM run_states WHERE job_id = $1::uuid AND attempt = $3)
         FROM jobs WHERE id = $1::uuid AND lease_token = $2 AND lease_expires_operating_ms IS NOT NULL FOR UPDATE",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(i64::from(lease.attempt))
    .fetch_optional(&mut *connection)
    .await?;
    let Some((before, begun, got_on)) = found else {
        return Ok(Returned::Lost);
    };
    end_attempt(
        connection,
        lease,
        now.wall_ms,
        (failed_attempt.word(), failed_attempt.detail()),
    )
    .await?;
    let before = u32::try_from(before).unwrap_or(u32::MAX);
    match failed_attempt.consequence(before, Reached::of(begun, got_on)) {
        Consequence::Waits {
            failed_attempts,
            wait_ms,
        } => {
            let not_before_ms = now.operating_ms + wait_ms;
            put_back_row(connection, lease, failed_attempts, not_before_ms).await?;
            Ok(Returned::Waiting)
        }
        Consequence::Fails(failure) => {
            fail_row(connection, lease, &failure, now).await?;
            Ok(Returned::Failed)
        }
    }
}

async fn fail_row(
    connection: &mut PgConnection,
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
         SET status = 'failed', finished_ms = $3, ended_operating_ms = $5, problem = $4,
             eta_s = NULL, lease_owner = NULL, lease_expires_operating_ms = NULL
         WHERE id = $1::uuid AND lease_token = $2 AND lease_expires_operating_ms IS NOT NULL",
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
    connection: &mut PgConnection,
    lease: Lease,
    failed_attempts: u32,
    not_before_operating_ms: i64,
) -> Answer<bool> {
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'accepted', started_ms = NULL, failed_attempts = failed_attempts + $3,
             not_before_operating_ms = $4, lease_owner = NULL, lease_expires_operating_ms = NULL,
             lease_token = lease_token + 1, point_steps_per_s = 0, eta_s = NULL, begun = false,
             fraction = CASE WHEN saved THEN fraction ELSE 0 END,
             simulated_time_s = CASE WHEN saved THEN simulated_time_s ELSE 0 END,
             steps = CASE WHEN saved THEN steps ELSE 0 END,
             substeps = CASE WHEN saved THEN substeps ELSE 0 END
         FROM (SELECT EXISTS (SELECT 1 FROM run_states WHERE job_id = $1::uuid) AS saved) AS state
         WHERE id = $1::uuid AND lease_token = $2 AND lease_expires_operating_ms IS NOT NULL",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(i64::from(failed_attempts))
    .bind(not_before_operating_ms)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}
