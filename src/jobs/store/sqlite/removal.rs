//! Removal of jobs that have ended, with all that belongs to them.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;
use crate::jobs::job::JobId;
use crate::jobs::store::Removal;
use crate::jobs::store::page::REMOVED_AT_ONCE;

impl SqliteStore {
    pub(super) async fn remove(&self, id: JobId) -> Answer<Removal> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
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
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let done = sqlx::query(
            "DELETE FROM jobs WHERE id IN (
                 SELECT id FROM jobs WHERE ended_operating_ms <= ?1
                 ORDER BY ended_operating_ms LIMIT ?2)",
        )
        .bind(self.operating_ms().saturating_sub(age_ms))
        .bind(REMOVED_AT_ONCE)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(done.rows_affected())
    }
}
