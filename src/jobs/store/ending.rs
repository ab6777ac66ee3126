//! Ends of running jobs: success, failure, release, failed attempts.

use super::history::end_attempt;
use super::{Lease, Store, StoreError};
use crate::jobs::failure::Failure;
use sqlx::sqlite::SqliteConnection;

/// Number of failed attempts in a row after which a job fails: a job that crashes the
/// service must not do so for ever.
pub const TOLERATED_SETBACKS: u32 = 3;

/// Waiting times of a job after its first, second, … failed attempt [ms], and least uptime of
/// the service before it claims the job again.
pub(super) const BACK_OFF_MS: [i64; 2] = [2_000, 8_000];

/// Longest wait after a failed attempt [ms]. A longer remaining wait means
/// that the clock was set back.
pub(super) const LONGEST_BACK_OFF_MS: i64 = BACK_OFF_MS[1];

/// Cause of the end of an attempt through no fault of the scenario.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FailedAttempt {
    /// The process died.
    CutOff,
    /// The lease ran out.
    Expired,
    /// A resource of the run was missing.
    Infrastructure(String),
}

/// Result of a failed attempt for its job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Returned {
    /// The job waits for another attempt.
    Waiting,
    /// The job failed, after too many failed attempts.
    Failed,
    /// The job no longer belonged to this lease; nothing was changed.
    Lost,
}

impl Store {
    /// Ends a running job with its outcome and the fingerprint of its
    /// records. `false` if it no longer runs under this lease.
    ///
    /// # Errors
    /// The database's own.
    pub async fn succeed(
        &self,
        lease: Lease,
        outcome: &str,
        fingerprint: &str,
    ) -> Result<bool, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let done = sqlx::query(
            "UPDATE jobs
             SET status = 'successful', finished_ms = ?3, outcome = ?4, fingerprint = ?5,
                 fraction = 1, eta_s = NULL, lease_owner = NULL, lease_expires_ms = NULL
             WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
        )
        .bind(lease.job.to_string())
        .bind(lease.token)
        .bind(now_ms)
        .bind(outcome)
        .bind(fingerprint)
        .execute(&mut *transaction)
        .await?;
        if done.rows_affected() == 0 {
            return Ok(false);
        }
        end_attempt(&mut transaction, lease, now_ms, ("successful", None)).await?;
        transaction.commit().await?;
        Ok(true)
    }

    /// Ends a running job without an answer. `false` if it no longer runs under
    /// this lease.
    ///
    /// # Errors
    /// The database's own.
    pub async fn fail(&self, lease: Lease, failure: &Failure) -> Result<bool, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let done = fail_row(&mut transaction, lease, failure, now_ms).await?;
        if done {
            let ending = ("failed", Some(failure.detail.as_str()));
            end_attempt(&mut transaction, lease, now_ms, ending).await?;
        }
        transaction.commit().await?;
        Ok(done)
    }

    /// Releases a running job into the queue, with its saved state, because
    /// the service stops. `false` if it no longer runs under this lease.
    ///
    /// # Errors
    /// The database's own.
    pub async fn release(&self, lease: Lease) -> Result<bool, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let done = put_back_row(&mut transaction, lease, 0, 0).await?;
        if done {
            end_attempt(&mut transaction, lease, now_ms, ("handed-back", None)).await?;
        }
        transaction.commit().await?;
        Ok(done)
    }

    /// Fails an attempt at a running job: the job returns to the queue, to
    /// be claimed again after a wait, or fails after too many such attempts.
    ///
    /// # Errors
    /// The database's own.
    pub async fn fail_attempt(
        &self,
        lease: Lease,
        failed_attempt: &FailedAttempt,
    ) -> Result<Returned, StoreError> {
        let mut transaction = self.begin_write().await?;
        let returned = set_back_row(&mut transaction, lease, failed_attempt, self.now_ms()).await?;
        transaction.commit().await?;
        Ok(returned)
    }
}

impl FailedAttempt {
    fn word(&self) -> &'static str {
        match self {
            Self::CutOff => "cut-off",
            Self::Expired => "expired",
            Self::Infrastructure(_) => "infrastructure",
        }
    }

    fn detail(&self) -> Option<&str> {
        match self {
            Self::CutOff | Self::Expired => None,
            Self::Infrastructure(detail) => Some(detail),
        }
    }

    fn failure(&self, times: u32) -> Failure {
        match self {
            Self::CutOff | Self::Expired => Failure::cut_off(times),
            Self::Infrastructure(detail) => Failure::infrastructure(times, detail),
        }
    }
}

pub(super) async fn set_back_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    failed_attempt: &FailedAttempt,
    now_ms: i64,
) -> Result<Returned, StoreError> {
    let found: Option<(u32, bool)> = sqlx::query_as(
        "SELECT setbacks, EXISTS (SELECT 1 FROM run_states WHERE job_id = ?1 AND attempt = ?3)
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
        now_ms,
        (failed_attempt.word(), failed_attempt.detail()),
    )
    .await?;
    let by_death = matches!(
        failed_attempt,
        FailedAttempt::CutOff | FailedAttempt::Expired
    );
    if got_on && by_death {
        // The attempt made progress, and the next one continues from there.
        put_back_row(connection, lease, 0, now_ms).await?;
        return Ok(Returned::Waiting);
    }
    let times = before + 1;
    if times >= TOLERATED_SETBACKS {
        fail_row(connection, lease, &failed_attempt.failure(times), now_ms).await?;
        return Ok(Returned::Failed);
    }
    let wait_ms = match failed_attempt {
        // The next start of the service makes it wait.
        FailedAttempt::CutOff => 0,
        FailedAttempt::Expired | FailedAttempt::Infrastructure(_) => BACK_OFF_MS[before as usize],
    };
    put_back_row(connection, lease, 1, now_ms + wait_ms).await?;
    Ok(Returned::Waiting)
}

async fn fail_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    failure: &Failure,
    now_ms: i64,
) -> Result<bool, StoreError> {
    let problem = serde_json::to_string(failure).map_err(|_| StoreError::Row {
        job: lease.job.to_string(),
        what: "failure",
    })?;
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'failed', finished_ms = ?3, problem = ?4, eta_s = NULL,
             lease_owner = NULL, lease_expires_ms = NULL
         WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(now_ms)
    .bind(problem)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}

/// Puts a running job back into the queue. Its progress is kept if the next
/// attempt can resume from a saved state.
async fn put_back_row(
    connection: &mut SqliteConnection,
    lease: Lease,
    setbacks: u32,
    not_before_ms: i64,
) -> Result<bool, StoreError> {
    let done = sqlx::query(
        "UPDATE jobs
         SET status = 'accepted', started_ms = NULL, setbacks = setbacks + ?3,
             not_before_ms = ?4, lease_owner = NULL, lease_expires_ms = NULL,
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
    .bind(setbacks)
    .bind(not_before_ms)
    .execute(connection)
    .await?;
    Ok(done.rows_affected() == 1)
}
