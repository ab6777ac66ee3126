//! Operating time of a database: the time for which services have had it open, all together.
//! Leases, waits and retention go by it, since the time of day may jump.

use super::error::Answer;
use crate::jobs::clock::Clock;
use sqlx::SqliteExecutor;
use std::sync::Arc;
use std::time::Duration;

/// Operating time that a crash loses at most [ms], and least time between two notes of it:
/// each is a write.
const NOTED_EVERY_MS: i64 = 10_000;

/// Operating time, counted on from what former services noted.
#[derive(Debug)]
pub(super) struct OperatingTime {
    clock: Arc<dyn Clock>,
    before_ms: i64,
    opened: Duration,
}

impl OperatingTime {
    pub(super) async fn resume(
        connection: impl SqliteExecutor<'_>,
        clock: Arc<dyn Clock>,
    ) -> Answer<Self> {
        let before_ms = sqlx::query_scalar("SELECT total_ms FROM operating_time")
            .fetch_one(connection)
            .await?;
        Ok(Self {
            before_ms,
            opened: clock.uptime(),
            clock,
        })
    }

    /// Operating time now [ms].
    pub(super) fn now_ms(&self) -> i64 {
        let passed = self.clock.uptime().saturating_sub(self.opened);
        let passed_ms = i64::try_from(passed.as_millis()).unwrap_or(i64::MAX);
        self.before_ms.saturating_add(passed_ms)
    }

    /// Notes the operating time in the database, if the last note is old enough.
    pub(super) async fn note(&self, connection: impl SqliteExecutor<'_>) -> Answer<()> {
        self.note_after(NOTED_EVERY_MS, connection).await
    }

    /// Notes the operating time at the end of operation.
    pub(super) async fn note_last(&self, connection: impl SqliteExecutor<'_>) -> Answer<()> {
        self.note_after(1, connection).await
    }

    async fn note_after(&self, least_ms: i64, connection: impl SqliteExecutor<'_>) -> Answer<()> {
        sqlx::query("UPDATE operating_time SET total_ms = ?1 WHERE total_ms <= ?1 - ?2")
            .bind(self.now_ms())
            .bind(least_ms)
            .execute(connection)
            .await?;
        Ok(())
    }
}
