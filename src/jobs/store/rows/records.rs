//! Records of runs and their saved states.

use super::length;
use crate::jobs::job::JobId;
use crate::jobs::store::{ResumePoint, StoreError, StoredChunk, StoredState};
use crate::results::FlowSnapshot;
use crate::results::chunk::{self, Block, BlockError};
use crate::results::flow::StoredSnapshot;
use crate::results::terrain::{MapQuantity, StoredMap};
use sqlx::FromRow;

/// A chunk of a body's trajectory.
#[derive(Debug, FromRow)]
pub(in super::super) struct ChunkRow {
    first_sample: i64,
    samples: i64,
    checksum: Vec<u8>,
    data: Vec<u8>,
}

/// A snapshot of the flow.
#[derive(Debug, FromRow)]
pub(in super::super) struct SnapshotRow {
    time_s: f64,
    points: i64,
    thinning: i64,
    kept: i64,
    has_identifiers: bool,
    checksum: Vec<u8>,
    data: Vec<u8>,
}

/// A map of the flow.
#[derive(Debug, FromRow)]
pub(in super::super) struct MapRow {
    checksum: Vec<u8>,
    data: Vec<u8>,
}

/// The saved state of a run, without its bytes.
#[derive(Debug, FromRow)]
pub(in super::super) struct StateRow {
    time_s: f64,
    samples: i64,
    fingerprint: Vec<u8>,
    bytes: i64,
    checksum: Vec<u8>,
}

impl ChunkRow {
    /// Index of its first sample.
    pub(in super::super) fn first_sample(&self) -> usize {
        length(self.first_sample)
    }

    fn read(self) -> Result<StoredChunk, BlockError> {
        let samples = length(self.samples);
        let columns = chunk::decode(&block(self.checksum, self.data)?, samples)?;
        Ok(StoredChunk {
            next_sample: self.first_sample + self.samples,
            columns,
        })
    }
}

impl SnapshotRow {
    fn read(self) -> Result<FlowSnapshot, BlockError> {
        let stored = StoredSnapshot {
            time_s: self.time_s,
            points: self.points.unsigned_abs(),
            thinning: u32::try_from(self.thinning).map_err(|_| BlockError::Checksum)?,
            kept: length(self.kept),
            has_identifiers: self.has_identifiers,
            block: block(self.checksum, self.data)?,
        };
        stored.unpack()
    }
}

impl StateRow {
    fn read(self, data: Vec<u8>) -> Result<StoredState, BlockError> {
        let exact = |bytes: Vec<u8>| bytes.try_into().map_err(|_| BlockError::Checksum);
        let length = |number| usize::try_from(number).map_err(|_| BlockError::Checksum);
        Ok(StoredState {
            resume_point: ResumePoint {
                time_s: self.time_s,
                samples: length(self.samples)?,
                fingerprint: exact(self.fingerprint)?,
            },
            bytes: length(self.bytes)?,
            block: Block {
                data,
                checksum: exact(self.checksum)?,
            },
        })
    }
}

/// The chunk of a job in this row.
pub(in super::super) fn chunk_of(job: JobId, row: ChunkRow) -> Result<StoredChunk, StoreError> {
    row.read()
        .map_err(|source| StoreError::Block { job, source })
}

/// The snapshot of a job in this row.
pub(in super::super) fn snapshot_of(
    job: JobId,
    row: SnapshotRow,
) -> Result<FlowSnapshot, StoreError> {
    row.read()
        .map_err(|source| StoreError::Block { job, source })
}

/// The map of a job in this row.
pub(in super::super) fn map_of(
    job: JobId,
    quantity: MapQuantity,
    row: MapRow,
) -> Result<StoredMap, StoreError> {
    let file = block(row.checksum, row.data);
    let file = file.map_err(|source| StoreError::Block { job, source })?;
    Ok(StoredMap { quantity, file })
}

/// The saved state of a job in this row, with these bytes.
pub(in super::super) fn state_of(
    job: JobId,
    row: StateRow,
    data: Vec<u8>,
) -> Result<StoredState, StoreError> {
    row.read(data)
        .map_err(|source| StoreError::Block { job, source })
}

fn block(checksum: Vec<u8>, data: Vec<u8>) -> Result<Block, BlockError> {
    let checksum = checksum.try_into().map_err(|_| BlockError::Checksum)?;
    Ok(Block { data, checksum })
}
