//! Reading of jobs.

use super::PostgresStore;
use super::error::Answer;
use super::history::attempts_of;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::store::rows::{JobRow, job_status};

impl PostgresStore {
    pub(super) async fn job(&self, id: JobId) -> Answer<Option<Job>> {
        // One view of the data, so that the attempts match the row.
        let begin = "BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY";
        let mut transaction = self.pool.begin_with(begin).await?;
        let row: Option<JobRow> = sqlx::query_as(
            "SELECT sequence, id::text AS id, status, title, created_ms, started_ms, finished_ms,
                    fraction, simulated_time_s, steps, substeps, point_steps_per_s, eta_s,
                    bodies, attempt, threads, solver_version, solver_commit, instructions,
                    scenario_hash, submitter, scenario, plan, outcome, fingerprint, problem,
                    (SELECT coalesce(json_agg(label ORDER BY label COLLATE \"C\"), '[]')::text FROM labels
                     WHERE job_id = jobs.id) AS labels
             FROM jobs WHERE id = $1::uuid",
        )
        .bind(id.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        let attempts = attempts_of(&mut transaction, id).await?;
        Ok(Some(row.read(attempts)?))
    }

    pub(super) async fn status(&self, id: JobId) -> Answer<Option<JobStatus>> {
        let id = id.to_string();
        let word: Option<String> =
            sqlx::query_scalar("SELECT status FROM jobs WHERE id = $1::uuid")
                .bind(&id)
                .fetch_optional(&self.pool)
                .await?;
        Ok(word.map(|word| job_status(&id, &word)).transpose()?)
    }
}
