//! Health and size of the database.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::job::JobStatus;
use crate::jobs::store::JobCounts;

/// Space whose lack means that the database can't store a job [bytes].
const PROBED_ROOM: usize = 65_536;

impl PostgresStore {
    pub(super) async fn ping(&self) -> Answer<()> {
        sqlx::query("SELECT 1").execute(&self.pool).await?;
        Ok(())
    }

    pub(super) async fn probe(&self) -> Answer<()> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        for room in [&[0_u8; PROBED_ROOM][..], &[]] {
            sqlx::query(
                "INSERT INTO probes (id, written_ms, room) VALUES (1, $1, $2)
                 ON CONFLICT (id) DO UPDATE SET written_ms = $1, room = $2",
            )
            .bind(now.wall_ms)
            .bind(room)
            .execute(&mut *transaction)
            .await?;
        }
        transaction.commit().await?;
        Ok(())
    }

    /// Vacuuming is the server's own task: only the operating time is compared, and noted.
    pub(super) async fn maintain(&self) -> Answer<()> {
        self.now().await?;
        Ok(())
    }

    pub(super) async fn running_jobs(&self) -> Answer<u64> {
        let count: i64 =
            sqlx::query_scalar("SELECT count(*) FROM jobs WHERE lease_owner IS NOT NULL")
                .fetch_one(&self.pool)
                .await?;
        Ok(count.unsigned_abs())
    }

    pub(super) async fn count_jobs(&self) -> Answer<JobCounts> {
        let now = self.now().await?;
        let counts: Vec<(String, i64)> =
            sqlx::query_as("SELECT status, count(*) FROM jobs GROUP BY status")
                .fetch_all(&self.pool)
                .await?;
        let count = |status: JobStatus| {
            let found = counts.iter().find(|(word, _)| word == status.word());
            found.map_or(0, |(_, count)| count.unsigned_abs())
        };
        let attempts: Vec<(String, i64)> = sqlx::query_as(
            "SELECT ending, sum(total)::bigint FROM attempt_totals GROUP BY ending ORDER BY ending",
        )
        .fetch_all(&self.pool)
        .await?;
        let oldest_waiting_ms: Option<i64> = sqlx::query_scalar(
            "SELECT min(created_operating_ms) FROM jobs WHERE status = 'accepted'",
        )
        .fetch_one(&self.pool)
        .await?;
        let bytes: i64 = sqlx::query_scalar("SELECT pg_database_size(current_database())")
            .fetch_one(&self.pool)
            .await?;
        Ok(JobCounts {
            jobs: JobStatus::ALL.map(|status| (status, count(status))),
            database_bytes: bytes.unsigned_abs(),
            attempts: attempts
                .into_iter()
                .map(|(ending, count)| (ending, count.unsigned_abs()))
                .collect(),
            oldest_waiting_s: oldest_waiting_ms.map_or(0.0, |since| {
                // Clocks of several machines agree to about a second.
                ((now.operating_ms - since) as f64 * 1e-3).max(0.0)
            }),
        })
    }
}
