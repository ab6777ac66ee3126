//! Health and size of the database.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;
use crate::jobs::job::JobStatus;
use crate::jobs::store::JobCounts;

/// Space whose lack means that the database can't store a job [bytes].
const PROBED_ROOM: u32 = 65_536;

impl SqliteStore {
    pub(super) async fn ping(&self) -> Answer<()> {
        sqlx::query("SELECT 1")
            .execute(self.readers.operator())
            .await?;
        Ok(())
    }

    pub(super) async fn probe(&self) -> Answer<()> {
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        sqlx::query(
            "INSERT OR REPLACE INTO probes (id, written_ms, room) VALUES (1, ?1, zeroblob(?2))",
        )
        .bind(self.now_ms())
        .bind(PROBED_ROOM)
        .execute(&mut *transaction)
        .await?;
        sqlx::query("UPDATE probes SET room = x''")
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(())
    }

    pub(super) async fn running_jobs(&self) -> Answer<u64> {
        let count: i64 = sqlx::query_scalar("SELECT count(*) FROM jobs WHERE status = 'running'")
            .fetch_one(self.readers.pool())
            .await?;
        Ok(count.unsigned_abs())
    }

    pub(super) async fn count_jobs(&self) -> Answer<JobCounts> {
        let counts: Vec<(String, i64)> =
            sqlx::query_as("SELECT status, count(*) FROM jobs GROUP BY status")
                .fetch_all(self.readers.operator())
                .await?;
        let count = |status: JobStatus| {
            let found = counts.iter().find(|(word, _)| word == status.word());
            found.map_or(0, |(_, count)| count.unsigned_abs())
        };
        let attempts: Vec<(String, i64)> =
            sqlx::query_as("SELECT ending, total FROM attempt_totals ORDER BY ending")
                .fetch_all(self.readers.operator())
                .await?;
        let oldest_waiting_ms: Option<i64> = sqlx::query_scalar(
            "SELECT created_operating_ms FROM jobs WHERE status = 'accepted' ORDER BY sequence LIMIT 1",
        )
        .fetch_optional(self.readers.operator())
        .await?;
        let pages: i64 = sqlx::query_scalar(
            "SELECT page_count * page_size FROM pragma_page_count, pragma_page_size",
        )
        .fetch_one(self.readers.operator())
        .await?;
        Ok(JobCounts {
            jobs: JobStatus::ALL.map(|status| (status, count(status))),
            database_bytes: pages.unsigned_abs(),
            attempts: attempts
                .into_iter()
                .map(|(ending, count)| (ending, count.unsigned_abs()))
                .collect(),
            oldest_waiting_s: oldest_waiting_ms.map_or(0.0, |since| {
                // After a crash some operating time may be lost.
                ((self.operating_ms() - since) as f64 * 1e-3).max(0.0)
            }),
        })
    }
}
