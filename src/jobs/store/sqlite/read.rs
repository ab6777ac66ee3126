//! Reading of jobs.

use super::SqliteStore;
use super::error::Answer;
use super::history::attempts_of;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::store::rows::{JobRow, job_status};

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
        Ok(Some(row.read(attempts)?))
    }

    pub(super) async fn status(&self, id: JobId) -> Answer<Option<JobStatus>> {
        let word: Option<String> = sqlx::query_scalar("SELECT status FROM jobs WHERE id = ?1")
            .bind(id.to_string())
            .fetch_optional(self.readers.pool())
            .await?;
        let read = |word: String| job_status(&id.to_string(), &word);
        Ok(word.map(read).transpose()?)
    }
}
