//! The life of a job: submission, claim, dismissal. The table of jobs is the queue.

use super::error::Answer;
use super::history::{begin_attempt, end_attempt};
use super::size_limit::Purpose;
use super::{Now, SqliteStore};
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::store::ending::BACK_OFF_MS;
use crate::jobs::store::rows::{ClaimedRow, job_status, lease, milliseconds};
use crate::jobs::store::{Claim, Claimant, Dismissal};
use sqlx::sqlite::SqliteConnection;

/// Claims the first job in turn. Without its name the index would not be taken, and all waiting jobs
/// be sorted.
const CLAIM: &str = "UPDATE jobs
     SET status = 'running', started_ms = ?1, solver_version = ?2, attempt = attempt + 1,
         solver_commit = ?6, instructions = ?7,
         lease_owner = ?3, lease_expires_operating_ms = ?4, lease_token = lease_token + 1
     WHERE sequence = (SELECT sequence FROM jobs INDEXED BY jobs_by_turn
                       WHERE status = 'accepted'
                       AND not_before_operating_ms <= ?5
                       AND (failed_attempts = 0 OR ?8 >= iif(failed_attempts = 1, ?9, ?10))
                       ORDER BY priority, sequence LIMIT 1)
     RETURNING id, attempt, lease_token, scenario, failed_attempts, 0 AS planned_work";

impl SqliteStore {
    /// Claims one job: a pack would keep work from the other workers of the process, and spare it
    /// little.
    pub(super) async fn claim(&self, claimant: &Claimant) -> Answer<Vec<Claim>> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let row: Option<ClaimedRow> = sqlx::query_as(CLAIM)
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
            .fetch_optional(&mut *transaction)
            .await?;
        let Some(claim) = row.map(ClaimedRow::read).transpose()? else {
            return Ok(Vec::new());
        };
        begin_attempt(&mut transaction, claim.lease, &claimant.owner, now.wall_ms).await?;
        transaction.commit().await?;
        Ok(vec![claim])
    }

    pub(super) async fn is_idle(&self) -> Answer<bool> {
        let idle = sqlx::query_scalar(
            "SELECT NOT EXISTS (SELECT 1 FROM jobs WHERE status IN ('accepted', 'running'))
                AND NOT EXISTS (SELECT 1 FROM studies WHERE status = 'running')",
        );
        Ok(idle.fetch_one(self.readers.pool()).await?)
    }

    pub(super) async fn dismiss(&self, id: JobId) -> Answer<Dismissal> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let dismissal = dismiss_row(&mut transaction, &id.to_string(), now).await?;
        transaction.commit().await?;
        Ok(dismissal)
    }
}

/// Dismisses a job unless it has ended.
pub(super) async fn dismiss_row(
    connection: &mut SqliteConnection,
    id: &str,
    now: Now,
) -> Answer<Dismissal> {
    let row: Option<(String, i64, i64)> =
        sqlx::query_as("SELECT status, attempt, lease_token FROM jobs WHERE id = ?1")
            .bind(id)
            .fetch_optional(&mut *connection)
            .await?;
    let Some((word, attempt, token)) = row else {
        return Ok(Dismissal::Unknown);
    };
    let status = job_status(id, &word)?;
    match status {
        JobStatus::Dismissed => return Ok(Dismissal::Dismissed),
        JobStatus::Successful | JobStatus::Failed => return Ok(Dismissal::Ended(status)),
        JobStatus::Accepted | JobStatus::Running => {}
    }
    sqlx::query(
        "UPDATE jobs
         SET status = 'dismissed', finished_ms = ?2, ended_operating_ms = ?3, eta_s = NULL,
             lease_owner = NULL, lease_expires_operating_ms = NULL
         WHERE id = ?1",
    )
    .bind(id)
    .bind(now.wall_ms)
    .bind(now.operating_ms)
    .execute(&mut *connection)
    .await?;
    let lease = lease(id, attempt, token)?;
    end_attempt(connection, lease, now.wall_ms, ("dismissed", None)).await?;
    Ok(Dismissal::Dismissed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::clock::SystemClock;
    use sqlx::Row;
    use std::sync::Arc;

    /// However many jobs wait, none but the first in turn are read.
    #[tokio::test]
    async fn a_claim_sorts_no_jobs() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("test.db");
        let clock = Arc::new(SystemClock::default());
        let store = SqliteStore::open_with(&path, None, clock).await.unwrap();
        let explained = sqlx::query(sqlx::AssertSqlSafe(format!("EXPLAIN QUERY PLAN {CLAIM}")));
        let rows = explained.fetch_all(store.readers.pool()).await.unwrap();
        let plan: Vec<String> = rows.iter().map(|row| row.get("detail")).collect();
        let sorts = plan.iter().any(|step| step.contains("TEMP B-TREE"));
        assert!(!sorts, "{plan:#?}");
        assert!(
            plan.iter().any(|step| step.contains("jobs_by_turn")),
            "{plan:#?}"
        );
    }
}
