//! Places of webhooks in the order of events.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;

impl SqliteStore {
    pub(super) async fn webhook_position(&self, name: &str) -> Answer<Option<i64>> {
        let position = sqlx::query_scalar("SELECT position FROM webhooks WHERE name = ?1");
        Ok(position
            .bind(name)
            .fetch_optional(self.readers.pool())
            .await?)
    }

    pub(super) async fn note_webhook_position(&self, name: &str, position: i64) -> Answer<()> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        sqlx::query(
            "INSERT INTO webhooks (name, position) VALUES (?1, ?2)
             ON CONFLICT (name) DO UPDATE SET position = excluded.position",
        )
        .bind(name)
        .bind(position)
        .execute(&mut *transaction)
        .await?;
        Ok(transaction.commit().await?)
    }
}
