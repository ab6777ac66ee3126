//! Places of webhooks in the order of events.

use super::PostgresStore;
use super::error::Answer;

impl PostgresStore {
    pub(super) async fn webhook_position(&self, name: &str) -> Answer<Option<i64>> {
        let position = sqlx::query_scalar("SELECT position FROM webhooks WHERE name = $1");
        Ok(position.bind(name).fetch_optional(&self.pool).await?)
    }

    pub(super) async fn note_webhook_position(&self, name: &str, position: i64) -> Answer<()> {
        sqlx::query(
            "INSERT INTO webhooks (name, position) VALUES ($1, $2)
             ON CONFLICT (name) DO UPDATE SET position = excluded.position",
        )
        .bind(name)
        .bind(position)
        .execute(&self.pool)
        .await?;
        Ok(())
    }
}
