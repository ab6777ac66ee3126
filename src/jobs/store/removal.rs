//! Removal of jobs that have ended, with all that belongs to them.

use super::{Store, StoreError};
use crate::jobs::job::JobId;

/// Largest number of jobs removed at once: a long list must not delay submissions.
const REMOVED_AT_ONCE: u32 = 20;

/// Result of a request to remove a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Removal {
    /// The job does not exist.
    Unknown,
    /// The job is removed, with its results.
    Removed,
    /// The job has not ended.
    Active,
}

impl Store {
    /// Removes a job that has ended.
    ///
    /// # Errors
    /// The database's own.
    pub async fn remove(&self, id: JobId) -> Result<Removal, StoreError> {
        let mut transaction = self.begin_write().await?;
        let ended: Option<bool> =
            sqlx::query_scalar("SELECT finished_ms IS NOT NULL FROM jobs WHERE id = ?1")
                .bind(id.to_string())
                .fetch_optional(&mut *transaction)
                .await?;
        match ended {
            None => return Ok(Removal::Unknown),
            Some(false) => return Ok(Removal::Active),
            Some(true) => {}
        }
        sqlx::query("DELETE FROM jobs WHERE id = ?1")
            .bind(id.to_string())
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(Removal::Removed)
    }

    /// Removes some of the jobs that ended at least this long ago [ms] and returns their
    /// number. To be called until it returns 0.
    ///
    /// A job with an evidently wrong end time counts as ended now, as soon as the
    /// clock is no longer evidently wrong.
    ///
    /// # Errors
    /// The database's own.
    pub async fn remove_ended(&self, age_ms: i64) -> Result<u64, StoreError> {
        let now_ms = self.now_ms();
        let mut transaction = self.begin_write().await?;
        sqlx::query(
            "UPDATE jobs SET kept_since_ms = ?1
             WHERE finished_ms IS NOT NULL AND kept_since_ms IS NULL
               AND ?1 >= (SELECT max(created_ms) FROM jobs)
               AND ?1 >= (SELECT max(finished_ms) FROM jobs WHERE finished_ms IS NOT NULL)",
        )
        .bind(now_ms)
        .execute(&mut *transaction)
        .await?;
        let done = sqlx::query(
            "DELETE FROM jobs WHERE id IN (
                 SELECT id FROM jobs WHERE finished_ms IS NOT NULL AND kept_since_ms <= ?1
                 ORDER BY kept_since_ms LIMIT ?2)",
        )
        .bind(now_ms - age_ms)
        .bind(REMOVED_AT_ONCE)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(done.rows_affected())
    }
}
