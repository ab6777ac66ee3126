//! Space of removed jobs, given back to the system in slices between other writes.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;
use std::time::{Duration, Instant};

/// Pages that are kept free for the next jobs: 4 MiB.
const KEPT_PAGES: i64 = 1024;

/// Time for which slices are given back at one heartbeat. Other writes come in between.
const TIME_AT_ONCE: Duration = Duration::from_millis(400);

impl SqliteStore {
    pub(super) async fn maintain(&self) -> Answer<()> {
        self.begin_write(Purpose::Upkeep).await?.commit().await?;
        self.give_back_space().await
    }

    async fn give_back_space(&self) -> Answer<()> {
        let began = Instant::now();
        let mut given = false;
        while self.free_pages().await? > KEPT_PAGES && began.elapsed() < TIME_AT_ONCE {
            // So few pages that other writes wait for less than 50 ms.
            sqlx::query("PRAGMA incremental_vacuum(32)")
                .execute(&self.writer)
                .await?;
            given = true;
        }
        if given {
            // The file becomes shorter once the log is in it.
            sqlx::query("PRAGMA wal_checkpoint(PASSIVE)")
                .execute(&self.writer)
                .await?;
        }
        Ok(())
    }

    /// Number of free pages, where they can be given back.
    async fn free_pages(&self) -> Answer<i64> {
        let free = sqlx::query_scalar(
            "SELECT iif(auto_vacuum = 2, freelist_count, 0)
             FROM pragma_auto_vacuum, pragma_freelist_count",
        );
        Ok(free.fetch_one(self.readers.pool()).await?)
    }
}
