//! Leases: their renewal, and the reclaiming of jobs from those who lost them.

use super::SqliteStore;
use super::ending::set_back_row;
use super::error::Answer;
use super::results::keep_progress;
use super::size_limit::Purpose;
use crate::jobs::job::JobStatus;
use crate::jobs::store::claim::LOST_CLAIM_MS;
use crate::jobs::store::rows::{lease, milliseconds};
use crate::jobs::store::{FailedAttempt, Lease, Renewal};
use crate::runs::Progress;
use std::time::Duration;

impl SqliteStore {
    pub(super) async fn renew(
        &self,
        lease: Lease,
        lease_duration: Duration,
        progress: &Progress,
    ) -> Answer<Renewal> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let kept = keep_progress(&mut transaction, lease, progress).await?;
        let renewal = match kept {
            Some(JobStatus::Running) => Renewal::Held,
            Some(_) => Renewal::Dismissed,
            None => return Ok(Renewal::Lost),
        };
        if renewal == Renewal::Held {
            sqlx::query("UPDATE jobs SET lease_expires_operating_ms = ?2 WHERE id = ?1")
                .bind(lease.job.to_string())
                .bind(self.operating_ms() + milliseconds(lease_duration))
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(renewal)
    }

    pub(super) async fn reclaim_own(&self, owner: &str) -> Answer<usize> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, attempt, lease_token FROM jobs
             WHERE status = 'running' AND lease_owner = ?1 ORDER BY sequence",
        )
        .bind(owner)
        .fetch_all(&mut *transaction)
        .await?;
        for (id, attempt, token) in &left {
            let lease = lease(id, *attempt, *token)?;
            set_back_row(&mut transaction, lease, &FailedAttempt::CutOff, self.now()).await?;
        }
        transaction.commit().await?;
        Ok(left.len())
    }

    pub(super) async fn reclaim_expired(&self, owner: &str) -> Answer<usize> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id, attempt, lease_token FROM jobs
             WHERE status = 'running'
               AND lease_expires_operating_ms <= iif(lease_owner = ?1, ?3, ?2) ORDER BY sequence",
        )
        .bind(owner)
        .bind(now.operating_ms)
        .bind(now.operating_ms - LOST_CLAIM_MS)
        .fetch_all(&mut *transaction)
        .await?;
        for (id, attempt, token) in &left {
            let lease = lease(id, *attempt, *token)?;
            set_back_row(&mut transaction, lease, &FailedAttempt::Expired, now).await?;
        }
        transaction.commit().await?;
        Ok(left.len())
    }
}
