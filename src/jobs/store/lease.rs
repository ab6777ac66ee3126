//! Leases: their renewal, and the reclaiming of jobs from those who lost them.

use super::ending::{FailedAttempt, set_back_row};
use super::queue::lease;
use super::results::keep_progress;
use super::{Lease, Store, StoreError};
use crate::jobs::job::JobStatus;
use crate::jobs::progress::Progress;
use std::time::Duration;

/// Answer to a heartbeat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Renewal {
    /// The lease is renewed.
    Held,
    /// A client dismissed the job.
    Dismissed,
    /// The job has another lease, or has ended.
    Lost,
}

impl Store {
    /// Renews the lease of a running job from now on, and stores its progress.
    ///
    /// # Errors
    /// The database's own.
    pub async fn renew(
        &self,
        lease: Lease,
        lease_duration: Duration,
        progress: &Progress,
    ) -> Result<Renewal, StoreError> {
        let mut transaction = self.begin_write().await?;
        let kept = keep_progress(&mut transaction, lease, progress).await?;
        let renewal = match kept {
            Some(JobStatus::Running) => Renewal::Held,
            Some(_) => Renewal::Dismissed,
            None => return Ok(Renewal::Lost),
        };
        if renewal == Renewal::Held {
            sqlx::query("UPDATE jobs SET lease_expires_ms = ?2 WHERE id = ?1")
                .bind(lease.job.to_string())
                .bind(self.now_ms() + milliseconds(lease_duration))
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(renewal)
    }

    /// Reclaims the jobs that a former process of this name left running when it died.
    /// They may be claimed again at once. Returns their number.
    ///
    /// # Errors
    /// The database's own.
    pub async fn reclaim_own(&self, owner: &str) -> Result<usize, StoreError> {
        let mut transaction = self.begin_write().await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, attempt, lease_token FROM jobs
             WHERE status = 'running' AND lease_owner = ?1 ORDER BY sequence",
        )
        .bind(owner)
        .fetch_all(&mut *transaction)
        .await?;
        for (id, attempt, token) in &left {
            let lease = lease(id, *attempt, *token)?;
            set_back_row(
                &mut transaction,
                lease,
                &FailedAttempt::CutOff,
                self.now_ms(),
            )
            .await?;
        }
        transaction.commit().await?;
        Ok(left.len())
    }

    /// Reclaims jobs of other services whose lease, of at most `longest`, has run
    /// out. Returns their number.
    ///
    /// A lease that ends later than possible is from before the clock was set
    /// back: a live worker renews it, and the fencing token makes other writes harmless.
    ///
    /// # Errors
    /// The database's own.
    pub async fn reclaim_expired(
        &self,
        owner: &str,
        longest: Duration,
    ) -> Result<usize, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, attempt, lease_token FROM jobs
             WHERE status = 'running' AND lease_owner <> ?1
               AND (lease_expires_ms <= ?2 OR lease_expires_ms > ?3) ORDER BY sequence",
        )
        .bind(owner)
        .bind(now_ms)
        .bind(now_ms + 2 * milliseconds(longest))
        .fetch_all(&mut *transaction)
        .await?;
        for (id, attempt, token) in &left {
            let lease = lease(id, *attempt, *token)?;
            set_back_row(&mut transaction, lease, &FailedAttempt::Expired, now_ms).await?;
        }
        transaction.commit().await?;
        Ok(left.len())
    }
}

pub(super) fn milliseconds(duration: Duration) -> i64 {
    i64::try_from(duration.as_millis()).unwrap_or(i64::MAX / 4)
}
