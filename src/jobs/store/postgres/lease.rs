//! Leases: their renewal, and the reclaiming of jobs from those who lost them.

use super::ending::set_back_row;
use super::error::Answer;
use super::news::Subject;
use super::results::keep_progress;
use super::{Now, PostgresStore};
use crate::jobs::job::JobStatus;
use crate::jobs::store::claim::LOST_CLAIM_MS;
use crate::jobs::store::rows::{lease, milliseconds};
use crate::jobs::store::{FailedAttempt, Lease, Renewal};
use crate::runs::Progress;
use sqlx::{Postgres, Transaction};
use std::time::Duration;

impl PostgresStore {
    pub(super) async fn renew(
        &self,
        lease: Lease,
        lease_duration: Duration,
        progress: &Progress,
    ) -> Answer<Renewal> {
        let now = self.now().await?;
        let expires_ms = now.operating_ms + milliseconds(lease_duration);
        let status = keep_progress(&self.pool, lease, progress, Some(expires_ms)).await?;
        Ok(match status {
            Some(JobStatus::Running) => Renewal::Held,
            Some(_) => Renewal::Dismissed,
            None => Renewal::Lost,
        })
    }

    pub(super) async fn reclaim_own(&self, owner: &str) -> Answer<usize> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id::text, attempt, lease_token FROM jobs
             WHERE lease_owner = $1 ORDER BY sequence FOR UPDATE",
        )
        .bind(owner)
        .fetch_all(&mut *transaction)
        .await?;
        self.set_back(transaction, &left, (&FailedAttempt::CutOff, now))
            .await
    }

    pub(super) async fn reclaim_expired(&self, owner: &str) -> Answer<usize> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        // Those that others reclaim at this moment are left to them.
        let left: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id::text, attempt, lease_token FROM jobs
             WHERE lease_owner IS NOT NULL
               AND lease_expires_operating_ms <= CASE WHEN lease_owner = $1 THEN $3 ELSE $2 END
             ORDER BY sequence FOR UPDATE SKIP LOCKED",
        )
        .bind(owner)
        .bind(now.operating_ms)
        .bind(now.operating_ms - LOST_CLAIM_MS)
        .fetch_all(&mut *transaction)
        .await?;
        self.set_back(transaction, &left, (&FailedAttempt::Expired, now))
            .await
    }

    async fn set_back(
        &self,
        mut transaction: Transaction<'static, Postgres>,
        left: &[(String, i64, i64)],
        (failed_attempt, now): (&FailedAttempt, Now),
    ) -> Answer<usize> {
        if left.is_empty() {
            return Ok(0);
        }
        for (id, attempt, token) in left {
            let lease = lease(id, *attempt, *token)?;
            set_back_row(&mut transaction, lease, failed_attempt, now).await?;
        }
        transaction.commit().await?;
        self.news.tell(&[Subject::Queue, Subject::Events]);
        Ok(left.len())
    }
}
