//! The queue: claims of jobs, and their dismissal.

use super::error::Answer;
use super::history::end_attempt;
use super::news::Subject;
use super::{Now, PostgresStore};
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::store::ending::BACK_OFF_MS;
use crate::jobs::store::rows::{ClaimedRow, integer, job_status, lease, milliseconds};
use crate::jobs::store::{Claim, Claimant, Dismissal};
use sqlx::PgConnection;

/// Claims the first job in turn that no other transaction is claiming, and with it those behind it
/// that no worker has had before, as long as they fit into the pack. One statement, so that a claim
/// is one message to the server and back.
const CLAIM: &str = "WITH pack AS (
         SELECT sequence, row_number() OVER turn AS place, sum(planned_work) OVER turn AS work,
                bool_and(attempt = 0) OVER turn AS fresh
         FROM jobs WHERE sequence = ANY (ARRAY (SELECT first_jobs($5, $8, $9, $10, $13, $11)))
         WINDOW turn AS (ORDER BY priority, sequence ROWS UNBOUNDED PRECEDING)
     ), claimed AS (
         UPDATE jobs
         SET status = 'running', started_ms = $1, solver_version = $2, attempt = attempt + 1,
             solver_commit = $6, instructions = $7, begun = (place = 1),
             lease_owner = $3, lease_expires_operating_ms = $4, lease_token = lease_token + 1
         FROM pack
         WHERE jobs.sequence = pack.sequence AND (place = 1 OR fresh AND work <= $12)
         RETURNING place, id, attempt, lease_token, scenario, failed_attempts, planned_work
     ), begun AS (
         INSERT INTO attempts (job_id, attempt, owner, started_ms)
         SELECT id, attempt, $3, $1 FROM claimed
     )
     SELECT id::text AS id, attempt, lease_token, scenario, failed_attempts, planned_work
     FROM claimed ORDER BY place";

impl PostgresStore {
    pub(super) async fn claim(&self, claimant: &Claimant) -> Answer<Vec<Claim>> {
        let now = self.now().await?;
        let rows: Vec<ClaimedRow> = sqlx::query_as(CLAIM)
            .bind(now.wall_ms)
            .bind(claimant.solver.version)
            .bind(&claimant.owner)
            .bind(now.operating_ms + milliseconds(claimant.lease_duration))
            .bind(now.operating_ms)
            .bind(claimant.solver.commit)
            .bind(claimant.solver.instructions)
            .bind(milliseconds(claimant.up_for))
            .bind(BACK_OFF_MS[0])
            .bind(BACK_OFF_MS[1])
            .bind(i64::from(claimant.pack.jobs))
            .bind(integer(claimant.pack.work))
            .bind(integer(claimant.memory_bytes))
            .fetch_all(&self.pool)
            .await?;
        if !rows.is_empty() {
            self.news.tell(&[Subject::Events]);
        }
        let claims: Result<_, _> = rows.into_iter().map(ClaimedRow::read).collect();
        Ok(claims?)
    }

    pub(super) async fn dismiss(&self, id: JobId) -> Answer<Dismissal> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        let dismissal = dismiss_row(&mut transaction, id, now).await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(dismissal)
    }

    pub(super) async fn is_idle(&self, memory_bytes: u64) -> Answer<bool> {
        let idle = sqlx::query_scalar(
            "SELECT NOT EXISTS (SELECT 1 FROM jobs WHERE lease_owner IS NOT NULL)
                AND NOT EXISTS (SELECT 1 FROM jobs
                                WHERE status = 'accepted' AND planned_memory_bytes <= $1)
                AND NOT EXISTS (SELECT 1 FROM studies WHERE status = 'running')",
        );
        Ok(idle
            .bind(integer(memory_bytes))
            .fetch_one(&self.pool)
            .await?)
    }
}

/// Dismisses a job unless it has ended.
pub(super) async fn dismiss_row(
    connection: &mut PgConnection,
    id: JobId,
    now: Now,
) -> Answer<Dismissal> {
    let id = id.to_string();
    let row: Option<(String, i64, i64)> = sqlx::query_as(
        "SELECT status, attempt, lease_token FROM jobs WHERE id = $1::uuid FOR UPDATE",
    )
    .bind(&id)
    .fetch_optional(&mut *connection)
    .await?;
    let Some((word, attempt, token)) = row else {
        return Ok(Dismissal::Unknown);
    };
    let status = job_status(&id, &word)?;
    match status {
        JobStatus::Dismissed => return Ok(Dismissal::Dismissed),
        JobStatus::Successful | JobStatus::Failed => return Ok(Dismissal::Ended(status)),
        JobStatus::Accepted | JobStatus::Running => {}
    }
    sqlx::query(
        "UPDATE jobs
         SET status = 'dismissed', finished_ms = $2, ended_operating_ms = $3, eta_s = NULL,
             lease_owner = NULL, lease_expires_operating_ms = NULL
         WHERE id = $1::uuid",
    )
    .bind(&id)
    .bind(now.wall_ms)
    .bind(now.operating_ms)
    .execute(&mut *connection)
    .await?;
    let lease = lease(&id, attempt, token)?;
    end_attempt(connection, lease, now.wall_ms, ("dismissed", None)).await?;
    Ok(Dismissal::Dismissed)
}
