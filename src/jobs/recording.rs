//! The sink of the service: gathers what a run records and writes it to the
//! store every so often, in few large blocks.

use super::progress::Progress;
use super::runner::Sink;
use super::store::{Hold, NewChunk, NewResults, Store, StoreError};
use crate::results::chunk::{self, BlockError, CHUNK_SAMPLES};
use crate::results::columns::TrajectoryColumns;
use crate::results::flow::StoredSnapshot;
use scree_solver::record::{Record, Sample};
use std::time::{Duration, Instant};
use thiserror::Error;
use tokio::runtime::Handle;

/// Why results can't be kept.
#[derive(Debug, Error)]
pub enum KeepError {
    /// The job is not this run's any more.
    #[error("the job was taken away from its worker")]
    Lost,
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A block can't be made.
    #[error(transparent)]
    Block(#[from] BlockError),
}

/// Writes a run into the store. Lives on a worker's own thread and waits there
/// for the database, which runs on the service's runtime.
#[derive(Debug)]
pub struct StoreSink {
    store: Store,
    runtime: Handle,
    hold: Hold,
    flush_interval: Duration,
    flushed: Instant,
    open_chunks: Vec<OpenChunk>,
    snapshots: Vec<StoredSnapshot>,
    progress: Progress,
}

/// The last chunk of one body's trajectory, still growing.
#[derive(Debug, Default)]
struct OpenChunk {
    first_sample: usize,
    written: usize,
    columns: TrajectoryColumns,
}

impl StoreSink {
    /// A sink for the job of this hold.
    pub fn new(store: Store, runtime: Handle, hold: Hold, flush_interval: Duration) -> Self {
        Self {
            store,
            runtime,
            hold,
            flush_interval,
            flushed: Instant::now(),
            open_chunks: Vec::new(),
            snapshots: Vec::new(),
            progress: Progress::default(),
        }
    }

    /// Writes all that is not written yet.
    ///
    /// # Errors
    /// The job is lost, or the store fails.
    pub fn flush(&mut self) -> Result<(), KeepError> {
        let mut results = NewResults {
            chunks: Vec::new(),
            snapshots: std::mem::take(&mut self.snapshots),
            progress: self.progress,
        };
        for (body, open) in self.open_chunks.iter().enumerate() {
            results.chunks.extend(open.sealed(body)?);
        }
        self.flushed = Instant::now();
        if !self
            .runtime
            .block_on(self.store.keep(self.hold, &results))?
        {
            return Err(KeepError::Lost);
        }
        self.open_chunks
            .iter_mut()
            .for_each(OpenChunk::mark_written);
        Ok(())
    }

    fn take_sample(&mut self, sample: &Sample) -> Result<(), KeepError> {
        self.open_chunks
            .resize_with(sample.bodies.len(), OpenChunk::default);
        for (open, state) in self.open_chunks.iter_mut().zip(&sample.bodies) {
            open.columns.push(sample.time_s, state);
        }
        if self.open_chunks.iter().any(OpenChunk::is_full) {
            return self.flush();
        }
        Ok(())
    }
}

impl Sink for StoreSink {
    type Error = KeepError;

    fn record(&mut self, record: Record) -> Result<(), KeepError> {
        match record {
            Record::Sample(sample) => self.take_sample(&sample),
            Record::Snapshot(snapshot) => {
                self.snapshots.push(StoredSnapshot::pack(&snapshot)?);
                Ok(())
            }
        }
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), KeepError> {
        self.progress = *progress;
        if self.flushed.elapsed() < self.flush_interval {
            return Ok(());
        }
        self.flush()
    }
}

impl OpenChunk {
    fn is_full(&self) -> bool {
        self.columns.len() >= CHUNK_SAMPLES
    }

    /// The chunk as it is to be written; nothing if nothing is new in it.
    fn sealed(&self, body: usize) -> Result<Option<NewChunk>, BlockError> {
        let times = &self.columns.time_s;
        let (Some(&first_time_s), Some(&last_time_s)) = (times.first(), times.last()) else {
            return Ok(None);
        };
        if times.len() == self.written {
            return Ok(None);
        }
        Ok(Some(NewChunk {
            body,
            first_sample: self.first_sample,
            samples: times.len(),
            first_time_s,
            last_time_s,
            block: chunk::encode(&self.columns)?,
        }))
    }

    /// Notes that all is written; a full chunk makes way for the next.
    fn mark_written(&mut self) {
        self.written = self.columns.len();
        if self.is_full() {
            *self = Self {
                first_sample: self.first_sample + self.columns.len(),
                ..Self::default()
            };
        }
    }
}
