//! Reading jobs.

use super::history::attempts_of;
use super::rows::{JobRow, SummaryRow};
use super::{Store, StoreError};
use crate::jobs::job::{Job, JobId, JobStatus, JobSummary};

/// Which jobs a list shows, newest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Page {
    /// Only jobs of this state.
    pub status: Option<JobStatus>,
    /// Only jobs submitted before the one with this sequence number.
    pub before: Option<i64>,
    /// At most this many.
    pub limit: u32,
}

impl Store {
    /// The job, if there is one.
    ///
    /// # Errors
    /// The database's own, or an unreadable row.
    pub async fn job(&self, id: JobId) -> Result<Option<Job>, StoreError> {
        // One transaction, so that the attempts are those of the row.
        let mut transaction = self.readers.begin().await?;
        let row: Option<JobRow> = sqlx::query_as("SELECT * FROM jobs WHERE id = ?1")
            .bind(id.to_string())
            .fetch_optional(&mut *transaction)
            .await?;
        let Some(row) = row else { return Ok(None) };
        let attempts = attempts_of(&mut transaction, id).await?;
        row.read(attempts).map(Some)
    }

    /// A page of jobs.
    ///
    /// # Errors
    /// The database's own, or an unreadable row.
    pub async fn page(&self, page: Page) -> Result<Vec<JobSummary>, StoreError> {
        // Two statements, so that each can use its index.
        let query = match page.status {
            None => sqlx::query_as(
                "SELECT * FROM jobs WHERE sequence < ?1 ORDER BY sequence DESC LIMIT ?2",
            ),
            Some(_) => sqlx::query_as(
                "SELECT * FROM jobs WHERE sequence < ?1 AND status = ?3
                 ORDER BY sequence DESC LIMIT ?2",
            ),
        };
        let mut query = query.bind(page.before.unwrap_or(i64::MAX)).bind(page.limit);
        if let Some(status) = page.status {
            query = query.bind(status.word());
        }
        let rows: Vec<SummaryRow> = query.fetch_all(&self.readers).await?;
        rows.into_iter().map(SummaryRow::read).collect()
    }
}
