//! Reading of jobs.

use super::SqliteStore;
use super::error::Answer;
use super::history::attempts_of;
use super::rows::JobRow;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::store::StoreError;

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
}
