//! Operating time of all services and workers that share a database: it passes while any of them
//! has it open. Leases, waits and retention go by it, since the time of day may jump and differs
//! from machine to machine.
//!
//! Each process counts on with its own monotonic clock, and now and then compares itself with the
//! time in the database: one that is behind catches up, one that is ahead notes its time there. So
//! all agree to within about [`COMPARED_EVERY`] and the time of a query, whatever their clocks say.

use super::error::Answer;
use crate::jobs::clock::Clock;
use sqlx::PgPool;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};
use std::time::Duration;

/// Time after which a process compares its time with that of the others.
const COMPARED_EVERY: Duration = Duration::from_secs(1);

/// Time by which a process is ahead before it notes its own [ms]: each note is a write.
const NOTED_EVERY_MS: i64 = 1_000;

/// Operating time, counted on from what is noted.
#[derive(Debug)]
pub(super) struct OperatingTime {
    clock: Arc<dyn Clock>,
    /// Operating time at the beginning of the clock's uptime [ms]; it only grows.
    offset_ms: AtomicI64,
    /// Uptime at the last comparison [ms].
    compared_ms: AtomicI64,
}

impl OperatingTime {
    pub(super) async fn resume(pool: &PgPool, clock: Arc<dyn Clock>) -> Answer<Self> {
        let time = Self {
            offset_ms: AtomicI64::new(i64::MIN),
            compared_ms: AtomicI64::new(0),
            clock,
        };
        time.catch_up(noted(pool).await?);
        Ok(time)
    }

    /// Operating time now [ms].
    pub(super) fn now_ms(&self) -> i64 {
        self.offset_ms
            .load(Ordering::Relaxed)
            .saturating_add(self.uptime_ms())
    }

    /// Compares the time with that of the others, if the last comparison is long enough ago.
    pub(super) async fn compare(&self, pool: &PgPool) -> Answer<()> {
        let uptime_ms = self.uptime_ms();
        let compared_ms = self.compared_ms.load(Ordering::Relaxed);
        if uptime_ms - compared_ms < COMPARED_EVERY.as_millis() as i64 {
            return Ok(());
        }
        let noted_ms = noted(pool).await?;
        self.catch_up(noted_ms);
        if self.now_ms() >= noted_ms + NOTED_EVERY_MS {
            self.note(pool).await?;
        }
        // Only now: after an error the next call tries again.
        self.compared_ms.store(uptime_ms, Ordering::Relaxed);
        Ok(())
    }

    /// Notes the time, unless another process has noted a later one.
    pub(super) async fn note(&self, pool: &PgPool) -> Answer<()> {
        sqlx::query("UPDATE operating_time SET total_ms = $1 WHERE total_ms < $1")
            .bind(self.now_ms())
            .execute(pool)
            .await?;
        Ok(())
    }

    fn catch_up(&self, noted_ms: i64) {
        let offset_ms = noted_ms.saturating_sub(self.uptime_ms());
        self.offset_ms.fetch_max(offset_ms, Ordering::Relaxed);
    }

    fn uptime_ms(&self) -> i64 {
        i64::try_from(self.clock.uptime().as_millis()).unwrap_or(i64::MAX)
    }
}

async fn noted(pool: &PgPool) -> Answer<i64> {
    let noted = sqlx::query_scalar("SELECT total_ms FROM operating_time");
    Ok(noted.fetch_one(pool).await?)
}
