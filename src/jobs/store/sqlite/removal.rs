//! Removal of jobs that have ended, with all that belongs to them.

use super::SqliteStore;
use super::error::Answer;
use crate::jobs::job::JobId;
use crate::jobs::store::Removal;
use crate::jobs::store::page::REMOVED_AT_ONCE;

impl SqliteStore {
    pub(super) async fn remove(&self, id: JobId) -> Answer<Removal> {
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

    pub(super) async fn remove_ended(&self, age_ms: i64) -> Answer<u64> {
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
