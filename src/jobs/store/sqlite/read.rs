//! Reading of jobs.

use super::SqliteStore;
use super::error::Answer;
use super::history::attempts_of;
use super::rows::{JobRow, SummaryRow};
use crate::jobs::job::{Job, JobId, JobStatus, JobSummary};
use crate::jobs::store::{Page, StoreError};

/// A job's row and its labels.
macro_rules! with_labels {
    ($rest:expr) => {
        concat!(
            "SELECT *, (SELECT json_group_array(label) FROM labels WHERE job_id = jobs.id) AS labels
             FROM jobs ",
            $rest
        )
    };
}

/// The same for a page of jobs.
macro_rules! listed {
    ($condition:expr) => {
        with_labels!(concat!($condition, " ORDER BY sequence DESC LIMIT ?2"))
    };
}

impl SqliteStore {
    pub(super) async fn job(&self, id: JobId) -> Answer<Option<Job>> {
        // One transaction, so that the attempts match the row.
        let mut transaction = self.readers.pool().begin().await?;
        let row: Option<JobRow> = sqlx::query_as(with_labels!("WHERE id = ?1"))
            .bind(id.to_string())
            .fetch_optional(&mut *transaction)
            .await?;
        let Some(row) = row else { return Ok(None) };
        let attempts = attempts_of(&mut transaction, id).await?;
        row.read(attempts).map(Some)
    }

    pub(super) async fn status(&self, id: JobId) -> Answer<Option<JobStatus>> {
        let word: Option<String> = sqlx::query_scalar("SELECT status FROM jobs WHERE id = ?1")
            .bind(id.to_string())
            .fetch_optional(self.readers.pool())
            .await?;
        let read = |word: String| {
            JobStatus::from_word(&word).ok_or_else(|| StoreError::Row {
                job: id.to_string(),
                what: "status",
            })
        };
        Ok(word.map(read).transpose()?)
    }

    pub(super) async fn page(&self, page: &Page) -> Answer<Vec<JobSummary>> {
        // Separate statements, so that each can use its index.
        let query = match (page.status, &page.label) {
            (None, None) => sqlx::query_as(listed!("WHERE sequence < ?1")),
            (Some(_), None) => sqlx::query_as(listed!("WHERE sequence < ?1 AND status = ?3")),
            (None, Some(_)) => sqlx::query_as(listed!(
                "WHERE sequence IN (SELECT sequence FROM labels
                     WHERE label = ?4 AND sequence < ?1
                     ORDER BY sequence DESC LIMIT ?2)"
            )),
            (Some(_), Some(_)) => sqlx::query_as(listed!(
                "WHERE sequence IN (SELECT sequence FROM labels
                     WHERE label = ?4 AND status = ?3 AND sequence < ?1
                     ORDER BY sequence DESC LIMIT ?2)"
            )),
        };
        let rows: Vec<SummaryRow> = query
            .bind(page.before.unwrap_or(i64::MAX))
            .bind(page.limit)
            .bind(page.status.map(JobStatus::word))
            .bind(&page.label)
            .fetch_all(self.readers.pool())
            .await?;
        rows.into_iter().map(SummaryRow::read).collect()
    }
}
