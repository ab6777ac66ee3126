//! Largest size of a database. What is asked for by the operator, and what ends a job, still finds
//! room in a database that is full of jobs and results.

use super::pools::PAGE_BYTES;
use sqlx::SqliteExecutor;

/// Space beyond the limit for dismissals, removals and ends of jobs [bytes].
const RESERVE_BYTES: u64 = 4 << 20;

/// Largest size of a database [bytes]; `None`: as the disk has room.
#[derive(Debug, Clone, Copy)]
pub(super) struct SizeLimit(pub(super) Option<u64>);

/// Purpose of a write.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    /// New jobs and results, which need room within the limit.
    Growth,
    /// All else, which may use the reserve.
    Upkeep,
}

impl SizeLimit {
    /// Sets the limit for the next transaction of a connection. A database that is larger is not
    /// cut: then only what is free in it can be used.
    pub(super) async fn set(
        self,
        purpose: Purpose,
        connection: impl SqliteExecutor<'_>,
    ) -> Result<(), sqlx::Error> {
        let Some(limit) = self.0 else { return Ok(()) };
        let bytes = match purpose {
            Purpose::Growth => limit,
            Purpose::Upkeep => limit.saturating_add(RESERVE_BYTES),
        };
        let pages = (bytes / PAGE_BYTES).clamp(1, u64::from(u32::MAX) - 1);
        let statement = format!("PRAGMA max_page_count = {pages}");
        sqlx::query(sqlx::AssertSqlSafe(statement))
            .execute(connection)
            .await?;
        Ok(())
    }
}
