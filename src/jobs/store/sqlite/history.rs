//! The attempts at a job: start, end and kind of end.

use super::error::Answer;
use crate::jobs::job::{Attempt, JobId};
use crate::jobs::store::Lease;
use crate::jobs::store::rows::AttemptRow;
use sqlx::sqlite::SqliteConnection;

/// All attempts at a job, in order.
pub(super) async fn attempts_of(
    connection: &mut SqliteConnection,
    job: JobId,
) -> Answer<Vec<Attempt>> {
    let rows: Vec<AttemptRow> = sqlx::query_as(
        "SELECT attempt, owner, started_ms, resumed_from_s, ended_ms, ending, detail
         FROM attempts WHERE job_id = ?1 ORDER BY attempt",
    )
    .bind(job.to_string())
    .fetch_all(connection)
    .await?;
    let id = job.to_string();
    let attempts: Result<_, _> = rows.into_iter().map(|row| row.read(&id)).collect();
    Ok(attempts?)
}

/// Records that a worker of `owner` claimed a job.
pub(super) async fn begin_attempt(
    connection: &mut SqliteConnection,
    lease: Lease,
    owner: &str,
    now_ms: i64,
) -> Answer<()> {
    sqlx::query(
        "INSERT INTO attempts (job_id, attempt, owner, started_ms) VALUES (?1, ?2, ?3, ?4)",
    )
    .bind(lease.job.to_string())
    .bind(lease.attempt)
    .bind(owner)
    .bind(now_ms)
    .execute(connection)
    .await?;
    Ok(())
}

/// Records the end of an attempt: its kind, and details if there are any.
pub(super) async fn end_attempt(
    connection: &mut SqliteConnection,
    lease: Lease,
    now_ms: i64,
    (word, detail): (&str, Option<&str>),
) -> Answer<()> {
    sqlx::query(
        "UPDATE attempts SET ended_ms = ?3, ending = ?4, detail = ?5
         WHERE job_id = ?1 AND attempt = ?2 AND ending IS NULL",
    )
    .bind(lease.job.to_string())
    .bind(lease.attempt)
    .bind(now_ms)
    .bind(word)
    .bind(detail)
    .execute(connection)
    .await?;
    Ok(())
}
