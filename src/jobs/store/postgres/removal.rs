//! Removal of jobs that have ended, with all that belongs to them.

use super::PostgresStore;
use super::error::Answer;
use super::locks::Turn;
use super::news::Subject;
use crate::jobs::job::JobId;
use crate::jobs::store::Removal;
use crate::jobs::store::page::REMOVED_AT_ONCE;

impl PostgresStore {
    pub(super) async fn remove(&self, id: JobId) -> Answer<Removal> {
        let mut transaction = self.begin_in_turn(Turn::Removal).await?;
        let ended: Option<bool> = sqlx::query_scalar(
            "SELECT finished_ms IS NOT NULL FROM jobs WHERE id = $1::uuid FOR UPDATE",
        )
        .bind(id.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
        match ended {
            None => return Ok(Removal::Unknown),
            Some(false) => return Ok(Removal::Active),
            Some(true) => {}
        }
        sqlx::query("DELETE FROM jobs WHERE id = $1::uuid")
            .bind(id.to_string())
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(Removal::Removed)
    }

    pub(super) async fn remove_ended(&self, age_ms: i64) -> Answer<u64> {
        let now = self.now().await?;
        let mut transaction = self.begin_in_turn(Turn::Removal).await?;
        let done = sqlx::query(
            "DELETE FROM jobs WHERE sequence IN (
                 SELECT sequence FROM jobs WHERE ended_operating_ms <= $1
                 ORDER BY ended_operating_ms LIMIT $2)",
        )
        .bind(now.operating_ms.saturating_sub(age_ms))
        .bind(i64::from(REMOVED_AT_ONCE))
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        if done.rows_affected() > 0 {
            self.news.tell(&[Subject::Events]);
        }
        Ok(done.rows_affected())
    }
}
