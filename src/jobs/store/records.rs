//! Records of runs, as they are written and read.

use super::StoredState;
use crate::results::chunk::{Block, CHUNK_SAMPLES};
use crate::results::columns::TrajectoryColumns;
use crate::results::flow::StoredSnapshot;
use crate::results::terrain::StoredMap;
use crate::runs::Progress;

/// A chunk to be written; it replaces one that begins with the same sample.
#[derive(Debug, Clone, PartialEq)]
pub struct NewChunk {
    /// Index of the body.
    pub body: usize,
    /// Index of its first sample.
    pub first_sample: usize,
    /// Number of samples in it.
    pub samples: usize,
    /// Time of its first sample [s].
    pub first_time_s: f64,
    /// Time of its last sample [s].
    pub last_time_s: f64,
    /// The samples.
    pub block: Block,
}

/// Results that a run writes to the database at once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NewResults {
    /// Chunks of trajectories.
    pub chunks: Vec<NewChunk>,
    /// Snapshots of the flow.
    pub snapshots: Vec<StoredSnapshot>,
    /// Maps of the flow, at the end of a run on a terrain; they replace those of the same name.
    pub maps: Vec<StoredMap>,
    /// Progress of the run.
    pub progress: Progress,
    /// State of the run after these results.
    pub state: Option<StoredState>,
}

impl NewResults {
    /// Size of the results, without the state [bytes].
    pub fn bytes(&self) -> u64 {
        self.bytes_of(|_| true)
    }

    /// Size of those that are never written again [bytes]: without the chunks that still grow.
    pub fn complete_bytes(&self) -> u64 {
        self.bytes_of(|chunk| chunk.samples >= CHUNK_SAMPLES)
    }

    fn bytes_of(&self, counts: impl Fn(&NewChunk) -> bool) -> u64 {
        let chunks = self.chunks.iter().filter(|chunk| counts(chunk));
        let chunks = chunks.map(|chunk| chunk.block.data.len());
        let snapshots = self.snapshots.iter();
        let snapshots = snapshots.map(|snapshot| snapshot.block.data.len());
        let maps = self.maps.iter().map(|map| map.file.data.len());
        chunks.chain(snapshots).chain(maps).sum::<usize>() as u64
    }
}

/// A chunk read from the store.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredChunk {
    /// Index of the first sample after it.
    pub next_sample: i64,
    /// Its samples.
    pub columns: TrajectoryColumns,
}
