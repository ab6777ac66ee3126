//! Writing and reading the records of runs.

use super::SqliteStore;
use super::error::Answer;
use super::flow_maps::write_map;
use super::size_limit::Purpose;
use super::states::write_state;
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::store::rows::{ChunkRow, SnapshotRow, chunk_of, integer, snapshot_of};
use crate::jobs::store::{Lease, NewChunk, NewResults, StoredChunk};
use crate::results::FlowSnapshot;
use crate::results::chunk::{self, CHUNK_SAMPLES};
use crate::results::columns::{Selection, TrajectoryColumns};
use crate::results::flow::StoredSnapshot;
use crate::runs::Progress;
use sqlx::sqlite::SqliteConnection;

impl SqliteStore {
    pub(super) async fn keep(&self, lease: Lease, results: &NewResults) -> Answer<bool> {
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        let status = keep_progress(&mut transaction, lease, &results.progress).await?;
        let Some(status) = status else {
            return Ok(false);
        };
        for chunk in &results.chunks {
            write_chunk(&mut transaction, lease.job, chunk).await?;
        }
        for snapshot in &results.snapshots {
            write_snapshot(&mut transaction, lease.job, snapshot).await?;
        }
        for map in &results.maps {
            write_map(&mut transaction, lease.job, map).await?;
        }
        if let (Some(state), JobStatus::Running) = (&results.state, status) {
            write_state(&mut transaction, lease, state, self.now_ms()).await?;
        }
        transaction.commit().await?;
        Ok(true)
    }

    pub(super) async fn chunk(
        &self,
        job: JobId,
        body: usize,
        from_sample: i64,
        selection: &Selection,
    ) -> Answer<Option<StoredChunk>> {
        let row: Option<ChunkRow> = sqlx::query_as(
            "SELECT first_sample, samples, checksum, data FROM trajectory_chunks
             WHERE job_id = ?1 AND body = ?2 AND first_sample >= ?3
               AND last_time_s >= ?4 AND first_time_s <= ?5
             ORDER BY first_sample LIMIT 1",
        )
        .bind(job.to_string())
        .bind(integer(body as u64))
        .bind(from_sample)
        .bind(selection.earliest_s())
        .bind(selection.latest_s())
        .fetch_optional(self.readers.pool())
        .await?;
        Ok(row.map(|row| chunk_of(job, row)).transpose()?)
    }

    pub(super) async fn results_bytes(&self, job: JobId) -> Answer<u64> {
        let bytes: i64 = sqlx::query_scalar(
            "SELECT (SELECT coalesce(sum(length(data)), 0) FROM trajectory_chunks
                     WHERE job_id = ?1 AND samples >= ?2)
                  + (SELECT coalesce(sum(length(data)), 0) FROM flow_snapshots WHERE job_id = ?1)
                  + (SELECT coalesce(sum(length(data)), 0) FROM flow_maps WHERE job_id = ?1)",
        )
        .bind(job.to_string())
        .bind(integer(CHUNK_SAMPLES as u64))
        .fetch_one(self.readers.pool())
        .await?;
        Ok(u64::try_from(bytes).unwrap_or(0))
    }

    pub(super) async fn samples(&self, job: JobId, body: usize) -> Answer<usize> {
        let end: Option<i64> = sqlx::query_scalar(
            "SELECT max(first_sample + samples) FROM trajectory_chunks WHERE job_id = ?1 AND body = ?2",
        )
        .bind(job.to_string())
        .bind(integer(body as u64))
        .fetch_one(self.readers.pool())
        .await?;
        Ok(end.and_then(|end| usize::try_from(end).ok()).unwrap_or(0))
    }

    pub(super) async fn snapshot_times(&self, job: JobId) -> Answer<Vec<f64>> {
        let times = sqlx::query_scalar(
            "SELECT time_s FROM flow_snapshots WHERE job_id = ?1 ORDER BY time_s",
        );
        Ok(times
            .bind(job.to_string())
            .fetch_all(self.readers.pool())
            .await?)
    }

    pub(super) async fn last_chunk(
        &self,
        job: JobId,
        body: usize,
    ) -> Answer<Option<(usize, TrajectoryColumns)>> {
        let row: Option<ChunkRow> = sqlx::query_as(
            "SELECT first_sample, samples, checksum, data FROM trajectory_chunks
             WHERE job_id = ?1 AND body = ?2 ORDER BY first_sample DESC LIMIT 1",
        )
        .bind(job.to_string())
        .bind(integer(body as u64))
        .fetch_optional(self.readers.pool())
        .await?;
        let Some(row) = row else { return Ok(None) };
        let first_sample = row.first_sample();
        Ok(Some((first_sample, chunk_of(job, row)?.columns)))
    }

    pub(super) async fn snapshot(
        &self,
        job: JobId,
        time_s: Option<f64>,
    ) -> Answer<Option<FlowSnapshot>> {
        let row: Option<SnapshotRow> = sqlx::query_as(
            // The nearest is found among the times alone: blocks are not sorted.
            "SELECT time_s, points, thinning, kept, has_identifiers, checksum, data
             FROM flow_snapshots
             WHERE job_id = ?1 AND time_s = (
                 SELECT time_s FROM flow_snapshots WHERE job_id = ?1
                 ORDER BY iif(?2 IS NULL, -time_s, abs(time_s - ?2)), time_s LIMIT 1)",
        )
        .bind(job.to_string())
        .bind(time_s)
        .fetch_optional(self.readers.pool())
        .await?;
        Ok(row.map(|row| snapshot_of(job, row)).transpose()?)
    }
}

/// Stores the progress of a job that this lease still owns; returns whether the job
/// runs or was dismissed meanwhile.
pub(super) async fn keep_progress(
    connection: &mut SqliteConnection,
    lease: Lease,
    progress: &Progress,
) -> Answer<Option<JobStatus>> {
    let word: Option<String> = sqlx::query_scalar(
        "UPDATE jobs
         SET fraction = ?3, simulated_time_s = ?4, steps = ?5, substeps = ?6,
             point_steps_per_s = ?7, eta_s = iif(status = 'running', ?8, NULL)
         WHERE id = ?1 AND lease_token = ?2 AND status IN ('running', 'dismissed')
         RETURNING status",
    )
    .bind(lease.job.to_string())
    .bind(lease.token)
    .bind(progress.fraction)
    .bind(progress.simulated_time_s)
    .bind(integer(progress.steps))
    .bind(integer(progress.substeps))
    .bind(progress.point_steps_per_s)
    .bind(progress.eta_s)
    .fetch_optional(connection)
    .await?;
    Ok(word.and_then(|word| JobStatus::from_word(&word)))
}

async fn write_chunk(
    connection: &mut SqliteConnection,
    job: JobId,
    chunk: &NewChunk,
) -> Answer<()> {
    sqlx::query(
        "INSERT INTO trajectory_chunks
             (job_id, body, first_sample, samples, first_time_s, last_time_s, encoding, checksum, data)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)
         ON CONFLICT (job_id, body, first_sample) DO UPDATE
         SET samples = excluded.samples, last_time_s = excluded.last_time_s,
             checksum = excluded.checksum, data = excluded.data",
    )
    .bind(job.to_string())
    .bind(integer(chunk.body as u64))
    .bind(integer(chunk.first_sample as u64))
    .bind(integer(chunk.samples as u64))
    .bind(chunk.first_time_s)
    .bind(chunk.last_time_s)
    .bind(chunk::ENCODING)
    .bind(&chunk.block.checksum[..])
    .bind(&chunk.block.data)
    .execute(connection)
    .await?;
    Ok(())
}

async fn write_snapshot(
    connection: &mut SqliteConnection,
    job: JobId,
    snapshot: &StoredSnapshot,
) -> Answer<()> {
    sqlx::query(
        "INSERT INTO flow_snapshots
             (job_id, time_s, points, thinning, kept, encoding, checksum, data, has_identifiers)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)
         -- Written again only if it is not known whether it was written.
         ON CONFLICT (job_id, time_s) DO NOTHING",
    )
    .bind(job.to_string())
    .bind(snapshot.time_s)
    .bind(integer(snapshot.points))
    .bind(snapshot.thinning)
    .bind(integer(snapshot.kept as u64))
    .bind(chunk::ENCODING)
    .bind(&snapshot.block.checksum[..])
    .bind(&snapshot.block.data)
    .bind(snapshot.has_identifiers)
    .execute(connection)
    .await?;
    Ok(())
}
