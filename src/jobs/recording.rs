//! The sink of the service: collects the records of a run and writes them to the
//! store at intervals, in few large blocks, at times with the run's state.

use super::job_limits::{Excess, JobLimits};
use super::memory_budget::{MemoryBudget, Reservation};
use super::open_chunk::OpenChunk;
use super::running_jobs::RunningJob;
use super::store::{JobStore, Lease, NewResults, ResumePoint, StoreError, StoredState};
use crate::config::Recording;
use crate::results::chunk::BlockError;
use crate::results::fingerprint::Fingerprint;
use crate::results::flow::StoredSnapshot;
use crate::results::terrain::{MapError, StoredMap};
use crate::runs::{Progress, ProgressBoard, Resources, RunControl, Sink};
use scree_solver::record::{FlowMaps, Record, Sample};
use std::sync::Arc;
use std::time::{Duration, Instant};
use thiserror::Error;
use tokio::runtime::Handle;
use tracing::warn;

/// Time for which the database may refuse results before the run is given up. Until then they
/// are kept in memory: a full disk is often fixed soon.
const PATIENCE: Duration = Duration::from_secs(60);

/// Saving of states takes at most one in this many parts of the time.
const STATE_SHARE: u32 = 50;

/// Time until the first saved state of a run that was cut off before: short, so that it makes
/// progress.
const EARLY_STATE: Duration = Duration::from_millis(500);

/// Reason why results can't be stored.
#[derive(Debug, Error)]
pub enum KeepError {
    /// The job's lease was lost.
    #[error("the job was taken away from its worker")]
    Lost,
    /// The job was stopped while it waited for memory.
    #[error("the job was stopped while it waited for memory")]
    Stopped,
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A block can't be encoded.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A map can't be written.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The job exceeds a limit.
    #[error(transparent)]
    Excess(#[from] Excess),
    /// Records that a saved state depends on are missing.
    #[error("samples recorded before the saved state are missing")]
    Missing,
}

/// Sink that writes a run into the store. Lives on a worker's own thread and waits there
/// for the database, which runs on the service's runtime.
#[derive(Debug)]
pub struct StoreSink {
    store: Arc<dyn JobStore>,
    runtime: Handle,
    lease: Lease,
    recording: Recording,
    limits: JobLimits,
    /// Size of the job's stored results, without chunks that still grow [bytes].
    complete_bytes: u64,
    begun: Instant,
    /// Time after the start at which the first state is due.
    first_state: Duration,
    board: Arc<ProgressBoard>,
    control: Arc<RunControl>,
    memory: Arc<MemoryBudget>,
    /// Memory of the current run.
    reserved: Option<Reservation>,
    open_chunks: Vec<OpenChunk>,
    samples: usize,
    fingerprint: Fingerprint,
    /// Snapshots not written yet.
    snapshots: Vec<StoredSnapshot>,
    /// Maps of the flow not written yet.
    maps: Vec<StoredMap>,
    state: Option<StoredState>,
    progress: Progress,
    times: Times,
}

/// Times of the last writes, and of those due.
#[derive(Debug)]
struct Times {
    flushed: Instant,
    /// Time since which the database has refused writes.
    refused_since: Option<Instant>,
    state_begun: Instant,
    state_due: Instant,
}

impl StoreSink {
    /// A sink for a running job, which takes its memory from this budget.
    pub(super) fn new(
        (store, runtime): (Arc<dyn JobStore>, Handle),
        job: RunningJob,
        (recording, limits): (Recording, JobLimits),
        memory: Arc<MemoryBudget>,
    ) -> Self {
        let now = Instant::now();
        Self {
            store,
            runtime,
            lease: job.lease,
            board: job.board,
            control: job.control,
            memory,
            reserved: None,
            open_chunks: Vec::new(),
            samples: 0,
            fingerprint: Fingerprint::default(),
            snapshots: Vec::new(),
            maps: Vec::new(),
            state: None,
            progress: Progress::default(),
            times: Times {
                flushed: now,
                refused_since: None,
                state_begun: now,
                state_due: now + recording.state_interval(),
            },
            first_state: recording.state_interval(),
            recording,
            limits,
            complete_bytes: 0,
            begun: now,
        }
    }

    /// Starts anew, without any records.
    pub fn start_afresh(&mut self) {
        self.open_chunks.clear();
        self.samples = 0;
        self.fingerprint = Fingerprint::default();
        self.snapshots.clear();
        self.maps.clear();
        self.state = None;
        self.progress = Progress::default();
        self.complete_bytes = 0;
        self.begun = Instant::now();
        (self.times.flushed, self.times.refused_since) = (self.begun, None);
        self.begin_with_a_state_in(self.first_state);
    }

    /// Makes the first state be saved early.
    pub fn save_early(&mut self) {
        self.begin_with_a_state_in(self.first_state.min(EARLY_STATE));
    }

    fn begin_with_a_state_in(&mut self, pause: Duration) {
        self.first_state = pause;
        self.times.state_due = Instant::now() + pause;
    }

    /// Continues the records up to a saved state of a run with
    /// `bodies` bodies.
    ///
    /// # Errors
    /// The store fails, or lacks records that the state depends on.
    pub fn go_on_from(
        &mut self,
        resume_point: &ResumePoint,
        bodies: usize,
    ) -> Result<(), KeepError> {
        for body in 0..bodies {
            let last = self
                .runtime
                .block_on(self.store.last_chunk(self.lease.job, body))?;
            let open = OpenChunk::reopened(last, resume_point.samples).ok_or(KeepError::Missing)?;
            self.open_chunks.push(open);
        }
        let stored = self.store.results_bytes(self.lease.job);
        self.complete_bytes = self.runtime.block_on(stored)?;
        self.samples = resume_point.samples;
        self.fingerprint = Fingerprint::of_bytes(resume_point.fingerprint);
        Ok(())
    }

    /// Fingerprint of all records.
    pub fn fingerprint(&self) -> Fingerprint {
        self.fingerprint
    }

    /// Writes all that is not written yet, with retries.
    ///
    /// # Errors
    /// The lease is lost, the store has refused for too long, or it refuses while
    /// `give_up` is true.
    pub fn finish(&mut self, give_up: impl Fn() -> bool) -> Result<(), KeepError> {
        loop {
            match self.flush() {
                Ok(()) if self.times.refused_since.is_none() => return Ok(()),
                Ok(()) if give_up() => return Err(StoreError::Refused.into()),
                Ok(()) => std::thread::sleep(self.recording.flush_interval()),
                Err(error) => return Err(error),
            }
        }
    }

    /// Tries to write all that is not written yet. A refusal by the database is
    /// tolerated for a while.
    fn flush(&mut self) -> Result<(), KeepError> {
        let mut results = NewResults {
            chunks: Vec::new(),
            snapshots: std::mem::take(&mut self.snapshots),
            maps: std::mem::take(&mut self.maps),
            progress: self.progress,
            state: self.state.take(),
        };
        for (body, open) in self.open_chunks.iter().enumerate() {
            results.chunks.extend(open.sealed(body)?);
        }
        self.times.flushed = Instant::now();
        self.limits
            .check_results(self.complete_bytes + results.bytes())?;
        match self.runtime.block_on(self.store.keep(self.lease, &results)) {
            Ok(true) => {
                self.times.refused_since = None;
                self.complete_bytes += results.complete_bytes();
                self.open_chunks
                    .iter_mut()
                    .for_each(OpenChunk::mark_written);
                Ok(())
            }
            Ok(false) => Err(KeepError::Lost),
            Err(error) => {
                self.snapshots = results.snapshots;
                self.maps = results.maps;
                self.state = results.state;
                self.bear(error)
            }
        }
    }

    fn bear(&mut self, error: StoreError) -> Result<(), KeepError> {
        let now = Instant::now();
        let since = *self.times.refused_since.get_or_insert(now);
        if since == now {
            warn!(%error, "results can't be written now; they are kept in memory");
        }
        if now.duration_since(since) < PATIENCE {
            return Ok(());
        }
        Err(error.into())
    }

    fn take_sample(&mut self, sample: &Sample) -> Result<(), KeepError> {
        self.open_chunks
            .resize_with(sample.bodies.len(), OpenChunk::default);
        for (open, state) in self.open_chunks.iter_mut().zip(&sample.bodies) {
            open.push(sample.time_s, state);
        }
        self.samples += 1;
        let in_trouble = self.times.refused_since.is_some();
        if self.open_chunks.iter().any(OpenChunk::is_full) && !in_trouble {
            return self.flush();
        }
        Ok(())
    }
}

impl Sink for StoreSink {
    type Error = KeepError;

    fn record(&mut self, record: Record) -> Result<(), KeepError> {
        self.fingerprint.take_in(&record);
        match record {
            Record::Sample(sample) => self.take_sample(&sample),
            Record::Snapshot(snapshot) => {
                self.snapshots.push(StoredSnapshot::pack(&snapshot)?);
                Ok(())
            }
        }
    }

    fn flow_maps(&mut self, maps: &FlowMaps) -> Result<(), KeepError> {
        self.maps = StoredMap::all(maps)?;
        Ok(())
    }

    fn before_set_up(&mut self, memory_bytes: u64) -> Result<(), KeepError> {
        self.limits.check_memory(memory_bytes)?;
        // That of the run before is free: waiting for more while holding it could last for ever.
        self.reserved = None;
        let asked = Instant::now();
        let stopped = || self.control.is_raised();
        let reserved = self.memory.reserve(memory_bytes, stopped);
        self.reserved = Some(reserved.ok_or(KeepError::Stopped)?);
        // Waiting is no wall time of the job.
        self.begun += asked.elapsed();
        Ok(JobLimits::check_available(memory_bytes)?)
    }

    fn resources(&mut self, resources: &Resources) -> Result<(), KeepError> {
        let since_begun = self.begun.elapsed().as_secs_f64();
        self.limits.check(&Resources {
            wall_s: resources.wall_s.max(since_begun),
            ..*resources
        })?;
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), KeepError> {
        self.progress = *progress;
        self.board.tell(progress);
        if self.times.flushed.elapsed() < self.recording.flush_interval() {
            return Ok(());
        }
        self.flush()
    }

    fn wants_state(&mut self) -> bool {
        self.times.state_begun = Instant::now();
        self.times.state_begun >= self.times.state_due
    }

    fn state(&mut self, time_s: f64, state: &[u8]) -> Result<(), KeepError> {
        let resume_point = ResumePoint {
            time_s,
            samples: self.samples,
            fingerprint: self.fingerprint.bytes(),
        };
        self.state = Some(StoredState::pack(resume_point, state)?);
        self.flush()?;
        let cost = self.times.state_begun.elapsed();
        let pause = self.recording.state_interval().max(cost * STATE_SHARE);
        self.times.state_due = Instant::now() + pause;
        Ok(())
    }
}
