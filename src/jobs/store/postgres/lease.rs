//! Leases: their renewal, and the reclaiming of jobs from those who lost them.

use super::ending::set_back_row;
use super::error::Answer;
use super::news::Subject;
use super::{Now, PostgresStore};
use crate::jobs::job::JobStatus;
use crate::jobs::store::claim::LOST_CLAIM_MS;
use crate::jobs::store::rows::{integer, job_status, lease, milliseconds};
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
        let id = lease.job.to_string();
        let word: Option<String> = sqlx::query_scalar(
            "UPDATE jobs
             SET fraction = $3, simulated_time_s = $4, steps = $5, substeps = $6,
                 point_steps_per_s = $7,
                 eta_s = CASE WHEN status = 'running' THEN $8 END,
                 lease_expires_operating_ms = CASE WHEN status = 'running' THEN $9 END
             WHERE id = $1::uuid AND lease_token = $2
               AND (lease_expires_operating_ms IS NOT NULL OR status = 'dismissed')
             RETURNING status",
        )
        .bind(&id)
        .bind(lease.token)
        .bind(progress.fraction)
        .bind(progress.simulated_time_s)
        .bind(integer(progress.steps))
        .bind(integer(progress.substeps))
        .bind(progress.point_steps_per_s)
        .bind(progress.eta_s)
        .bind(now.operating_ms + milliseconds(lease_duration))
        .fetch_optional(&self.pool)
        .await?;
        Ok(match word.map(|word| job_status(&id, &word)).transpose()? {
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
