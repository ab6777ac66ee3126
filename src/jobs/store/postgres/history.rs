//! The attempts at a job: their ends.

use super::error::Answer;
use crate::jobs::job::{Attempt, JobId};
use crate::jobs::store::Lease;
use crate::jobs::store::rows::AttemptRow;
use sqlx::PgConnection;

/// All attempts at a job, in order.
pub(super) async fn attempts_of(connection: &mut PgConnection, job: JobId) -> Answer<Vec<Attempt>> {
    let id = job.to_string();
    let rows: Vec<AttemptRow> = sqlx::query_as(
        "SELECT attempt, owner, started_ms, resumed_from_s, ended_ms, ending, detail
         FROM attempts WHERE job_id = $1::uuid ORDER BY attempt",
    )
    .bind(&id)
    .fetch_all(connection)
    .await?;
    let attempts: Result<_, _> = rows.into_iter().map(|row| row.read(&id)).collect();
    Ok(attempts?)
}

/// Records the end of an attempt: its kind, and details if there are any.
pub(super) async fn end_attempt(
    connection: &mut PgConnection,
    lease: Lease,
    now_ms: i64,
    (word, detail): (&str, Option<&str>),
) -> Answer<()> {
    sqlx::query(
        "UPDATE attempts SET ended_ms = $3, ending = $4, detail = $5
         WHERE job_id = $1::uuid AND attempt = $2 AND ending IS NULL",
    )
    .bind(lease.job.to_string())
    .bind(i64::from(lease.attempt))
    .bind(now_ms)
    .bind(word)
    .bind(detail)
    .execute(connection)
    .await?;
    Ok(())
}
