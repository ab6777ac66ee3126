//! Saved states of runs, from which the next attempt resumes. The store treats them
//! as bytes.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;
use crate::jobs::job::JobId;
use crate::jobs::store::rows::{StateRow, integer, state_of};
use crate::jobs::store::{AttemptStart, Lease, ResumePoint, StoredState};
use sqlx::sqlite::SqliteConnection;

/// Bytes of one stored piece.
const PIECE_BYTES: usize = 8 << 20;

impl SqliteStore {
    pub(super) async fn state(&self, job: JobId) -> Answer<Option<StoredState>> {
        // One transaction, so that all pieces belong to one state.
        let mut transaction = self.readers.pool().begin().await?;
        let row: Option<StateRow> = sqlx::query_as(
            "SELECT time_s, samples, fingerprint, bytes, checksum FROM run_states WHERE job_id = ?1",
        )
        .bind(job.to_string())
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(row) = row else { return Ok(None) };
        let pieces: Vec<Vec<u8>> = sqlx::query_scalar(
            "SELECT data FROM run_state_pieces WHERE job_id = ?1 ORDER BY piece",
        )
        .bind(job.to_string())
        .fetch_all(&mut *transaction)
        .await?;
        Ok(Some(state_of(job, row, pieces.concat())?))
    }

    pub(super) async fn begin(
        &self,
        lease: Lease,
        beginning: &AttemptStart,
        threads: usize,
    ) -> Answer<bool> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        let done = sqlx::query(
            "UPDATE jobs SET threads = ?3
             WHERE id = ?1 AND lease_token = ?2 AND status = 'running'",
        )
        .bind(lease.job.to_string())
        .bind(lease.token)
        .bind(integer(threads as u64))
        .execute(&mut *transaction)
        .await?;
        if done.rows_affected() == 0 {
            return Ok(false);
        }
        match beginning {
            AttemptStart::Afresh => clear(&mut transaction, lease.job).await?,
            AttemptStart::At(resume_point) => rewind(&mut transaction, lease, resume_point).await?,
        }
        transaction.commit().await?;
        Ok(true)
    }
}

/// Replaces the saved state, and resets the count of failed attempts: the job
/// has made progress.
pub(super) async fn write_state(
    connection: &mut SqliteConnection,
    lease: Lease,
    state: &StoredState,
    now_ms: i64,
) -> Answer<()> {
    let id = lease.job.to_string();
    for statement in [
        "DELETE FROM run_states WHERE job_id = ?1",
        "UPDATE jobs SET failed_attempts = 0 WHERE id = ?1",
    ] {
        sqlx::query(statement)
            .bind(&id)
            .execute(&mut *connection)
            .await?;
    }
    sqlx::query(
        "INSERT INTO run_states
             (job_id, attempt, saved_ms, time_s, samples, fingerprint, bytes, checksum)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
    )
    .bind(&id)
    .bind(lease.attempt)
    .bind(now_ms)
    .bind(state.resume_point.time_s)
    .bind(integer(state.resume_point.samples as u64))
    .bind(&state.resume_point.fingerprint[..])
    .bind(integer(state.bytes as u64))
    .bind(&state.block.checksum[..])
    .execute(&mut *connection)
    .await?;
    for (piece, data) in state.block.data.chunks(PIECE_BYTES).enumerate() {
        sqlx::query("INSERT INTO run_state_pieces (job_id, piece, data) VALUES (?1, ?2, ?3)")
            .bind(&id)
            .bind(integer(piece as u64))
            .bind(data)
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

async fn clear(connection: &mut SqliteConnection, job: JobId) -> Answer<()> {
    for statement in [
        "DELETE FROM run_states WHERE job_id = ?1",
        "DELETE FROM trajectory_chunks WHERE job_id = ?1",
        "DELETE FROM flow_snapshots WHERE job_id = ?1",
        "DELETE FROM flow_maps WHERE job_id = ?1",
        "UPDATE jobs SET fraction = 0, simulated_time_s = 0, steps = 0, substeps = 0 WHERE id = ?1",
    ] {
        sqlx::query(statement)
            .bind(job.to_string())
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

/// Removes records after the resume point: they will be recorded again with the same bits and
/// would clash. The chunk that contains the resume point stays, and its rest is
/// overwritten.
async fn rewind(
    connection: &mut SqliteConnection,
    lease: Lease,
    resume_point: &ResumePoint,
) -> Answer<()> {
    let id = lease.job.to_string();
    sqlx::query("UPDATE attempts SET resumed_from_s = ?3 WHERE job_id = ?1 AND attempt = ?2")
        .bind(&id)
        .bind(lease.attempt)
        .bind(resume_point.time_s)
        .execute(&mut *connection)
        .await?;
    sqlx::query("DELETE FROM trajectory_chunks WHERE job_id = ?1 AND first_sample >= ?2")
        .bind(&id)
        .bind(integer(resume_point.samples as u64))
        .execute(&mut *connection)
        .await?;
    sqlx::query("DELETE FROM flow_maps WHERE job_id = ?1")
        .bind(&id)
        .execute(&mut *connection)
        .await?;
    sqlx::query("DELETE FROM flow_snapshots WHERE job_id = ?1 AND time_s > ?2")
        .bind(&id)
        .bind(resume_point.time_s)
        .execute(&mut *connection)
        .await?;
    Ok(())
}
