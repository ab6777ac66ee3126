//! The workers: threads of their own, so that computations and answers
//! don't delay each other.

use super::job::JobId;
use super::job_limits::JobLimits;
use super::lease_heartbeat::LeaseHeartbeat;
use super::memory_budget::MemoryBudget;
use super::store::{JobStore, Lease};
use super::worker;
use crate::config::{PoolSize, Queue, Recording, Retention, ServiceConfig};
use crate::runs::{Progress, ProgressBoard, RunControl, Stop};
use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use tokio::sync::watch;

/// Time after which an idle worker looks for work without being woken, in case a job had to
/// wait after a failed attempt.
const IDLE_LOOK: Duration = Duration::from_secs(1);

/// Share of the drain time after which a job that has not saved its state is cancelled.
pub(super) const GRACE: f64 = 0.7;

/// The workers of a service.
#[derive(Debug)]
pub struct Pool {
    threads: Vec<JoinHandle<()>>,
    equipment: Equipment,
    /// Time that running jobs have once the pool stops.
    drain: Duration,
    /// Dropped last: leases are renewed until every worker has ended.
    _keeper: LeaseHeartbeat,
}

/// Resources that a worker needs.
#[derive(Debug, Clone)]
pub(super) struct Equipment {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) runtime: Handle,
    pub(super) registry: Arc<RunningJobRegistry>,
    pub(super) threads: usize,
    pub(super) memory: Arc<MemoryBudget>,
    pub(super) started: Instant,
    pub(super) queue: Queue,
    pub(super) recording: Recording,
    pub(super) job_limits: JobLimits,
    pub(super) retention: Retention,
}

/// Registry of running jobs: workers wait in it for work, jobs are stopped through it, and share
/// the cores by it.
#[derive(Debug)]
pub struct RunningJobRegistry {
    cores: usize,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Number of jobs submitted so far.
    submissions: u64,
    /// True once jobs may be claimed.
    open: bool,
    /// When the service began to stop.
    closing: Option<Instant>,
    running: BTreeMap<JobId, RegisteredRun>,
}

impl State {
    fn is_closing(&self) -> bool {
        self.closing.is_some()
    }

    /// Shares the cores among the running jobs, those that came first having one more if they do
    /// not divide evenly.
    fn share(&self, cores: usize) {
        let jobs = self.running.len().max(1);
        for (place, registered) in self.running.values().enumerate() {
            let threads = cores / jobs + usize::from(place < cores % jobs);
            registered.run.control.ask_for_threads(threads.max(1));
        }
    }
}

#[derive(Debug)]
struct RegisteredRun {
    run: RunningJob,
    ended: watch::Receiver<()>,
}

/// A running job, as seen by the lease heartbeat.
#[derive(Debug, Clone)]
pub(super) struct RunningJob {
    pub(super) lease: Lease,
    pub(super) control: Arc<RunControl>,
    pub(super) board: Arc<ProgressBoard>,
}

/// Guard of a running job's entry in the registry; dropping it notifies those who wait.
#[derive(Debug)]
pub(super) struct RunningJobGuard {
    registry: Arc<RunningJobRegistry>,
    pub(super) run: RunningJob,
    _ended: watch::Sender<()>,
}

impl Pool {
    /// Starts the workers. They use the current tokio runtime for the database. `left_running`
    /// is the number of jobs reclaimed from a former process; `None`: they could not be yet.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn start(
        store: Arc<dyn JobStore>,
        size: PoolSize,
        config: &ServiceConfig,
        job_limits: JobLimits,
        left_running: Option<usize>,
    ) -> io::Result<Self> {
        let equipment = Equipment {
            store,
            runtime: Handle::current(),
            registry: Arc::new(RunningJobRegistry::of_cores(size.cores)),
            threads: size.threads_per_worker,
            memory: Arc::new(MemoryBudget::new(job_limits.memory_of_all_bytes)),
            started: Instant::now(),
            queue: config.queue.clone(),
            recording: config.recording.clone(),
            job_limits,
            retention: config.retention.clone(),
        };
        if let Some(count) = left_running {
            equipment.registry.open(count);
        }
        let mut pool = Self {
            threads: Vec::new(),
            equipment: equipment.clone(),
            drain: config.limits.drain_timeout(),
            _keeper: LeaseHeartbeat::start(equipment.clone())?,
        };
        for index in 0..size.workers {
            let equipment = equipment.clone();
            let thread = std::thread::Builder::new()
                .name(format!("worker-{index}"))
                .spawn(move || worker::work(&equipment))?;
            pool.threads.push(thread);
        }
        Ok(pool)
    }

    /// Registry of the running jobs.
    pub fn registry(&self) -> Arc<RunningJobRegistry> {
        Arc::clone(&self.equipment.registry)
    }

    /// Makes running jobs save their state and return to the queue, and waits
    /// until every worker has ended. A job whose current step takes too long returns with the
    /// state saved last; a worker that can't be stopped by then, since it sets up a very large run,
    /// is left behind without its job. Blocks.
    pub fn stop(mut self) {
        let registry = self.registry();
        let end = Instant::now() + self.drain;
        registry.close();
        registry.wait_until_idle(self.drain.mul_f64(GRACE));
        registry.cancel();
        registry.wait_until_idle(end.saturating_duration_since(Instant::now()));
        let left = registry.runs();
        for run in &left {
            self.equipment.take_from_worker(run.lease);
        }
        for thread in self.threads.drain(..) {
            if left.is_empty() && thread.join().is_err() {
                tracing::error!("a worker thread had panicked");
            }
        }
    }
}

/// A pool that is dropped, because the service could not start or was never
/// stopped, still ends its workers.
impl Drop for Pool {
    fn drop(&mut self) {
        self.equipment.registry.close();
    }
}

impl Equipment {
    /// Releases a job whose worker does not do so in time. Whatever that still writes is refused.
    fn take_from_worker(&self, lease: Lease) {
        tracing::warn!(id = %lease.job, "its worker can't be stopped in time and is left behind");
        if let Err(error) = self.runtime.block_on(self.store.release(lease)) {
            // The row stays as it is, and the next start reclaims the job.
            tracing::warn!(id = %lease.job, %error, "it can't be released");
        }
    }

    /// Reclaims the jobs that a former process of this name left running, once the store can
    /// be written. Until then no worker claims a job, so that none of its own is taken back.
    pub(super) fn reclaim_former_jobs(&self) {
        if self.registry.is_open() {
            return;
        }
        match self
            .runtime
            .block_on(self.store.reclaim_own(&self.queue.name))
        {
            Ok(count) => self.registry.open(count),
            Err(error) => tracing::warn!(%error, "former jobs can't be reclaimed now"),
        }
    }
}

impl RunningJobRegistry {
    /// Without jobs yet, on a machine with so many cores.
    fn of_cores(cores: usize) -> Self {
        Self {
            cores,
            state: Mutex::default(),
            changed: Condvar::new(),
        }
    }

    /// Lets the workers claim jobs: those that were left running, this many, are reclaimed.
    pub(super) fn open(&self, left_running: usize) {
        if left_running > 0 {
            tracing::warn!(left_running, "the last service died under jobs: they go on");
        }
        self.state().open = true;
        self.announce();
    }

    fn is_open(&self) -> bool {
        self.state().open
    }

    /// Waits until jobs may be claimed. False if the registry closes first.
    pub(super) fn wait_until_open(&self) -> bool {
        let shut = |state: &mut State| !state.open && state.closing.is_none();
        let waited = self.changed.wait_while(self.state(), shut);
        !waited.unwrap_or_else(PoisonError::into_inner).is_closing()
    }

    /// Notifies the workers of a submitted job.
    pub fn announce(&self) {
        self.state().submissions += 1;
        self.changed.notify_all();
    }

    /// Asks a running job to stop, and returns a receiver that signals its end;
    /// `None` if no worker runs it.
    pub fn stop_job(&self, job: JobId) -> Option<watch::Receiver<()>> {
        let state = self.state();
        let registered = state.running.get(&job)?;
        registered.run.control.raise();
        Some(registered.ended.clone())
    }

    fn close(&self) {
        let mut state = self.state();
        state.closing.get_or_insert_with(Instant::now);
        for registered in state.running.values() {
            registered.run.control.ask(Stop::OnceSaved);
        }
        self.changed.notify_all();
    }

    /// Waits until no job runs any more, at most for this time.
    fn wait_until_idle(&self, longest: Duration) {
        let is_busy = |state: &mut State| !state.running.is_empty();
        let waited = self
            .changed
            .wait_timeout_while(self.state(), longest, is_busy);
        drop(waited);
    }

    /// Cancels all running jobs.
    fn cancel(&self) {
        for registered in self.state().running.values() {
            tracing::warn!(id = %registered.run.lease.job, "its state can't be saved in time: it goes back as it was saved last");
            registered.run.control.raise();
        }
    }

    /// Progress of a running job; `None` if no worker of this service runs it.
    pub(super) fn progress(&self, job: JobId) -> Option<Progress> {
        let state = self.state();
        state
            .running
            .get(&job)
            .map(|running| running.run.board.read())
    }

    /// The running jobs.
    pub(super) fn runs(&self) -> Vec<RunningJob> {
        let state = self.state();
        state
            .running
            .values()
            .map(|registered| registered.run.clone())
            .collect()
    }

    /// Waits for this time, or less if the registry closes. True if it is still open.
    pub(super) fn pause(&self, pause: Duration) -> bool {
        let state = self.state();
        let waited = self
            .changed
            .wait_timeout_while(state, pause, |state| !state.is_closing());
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        !state.is_closing()
    }

    /// Time since the service began to stop; zero before.
    pub fn closing_for(&self) -> Duration {
        let closing = self.state().closing;
        closing.map_or(Duration::ZERO, |since| since.elapsed())
    }

    /// Number of submissions so far; `None` once the registry is closed.
    pub fn submissions(&self) -> Option<u64> {
        let state = self.state();
        (!state.is_closing()).then_some(state.submissions)
    }

    /// Waits for a submission after the `seen`-th, or for the registry to close.
    pub(super) fn wait(&self, seen: u64) {
        let state = self.state();
        let idle = |state: &mut State| !state.is_closing() && state.submissions == seen;
        // Woken or timed out, the worker looks for work in either case.
        drop(self.changed.wait_timeout_while(state, IDLE_LOOK, idle));
    }

    /// Registers a job that is about to run.
    pub(super) fn register(self: &Arc<Self>, lease: Lease) -> RunningJobGuard {
        let run = RunningJob {
            lease,
            control: Arc::default(),
            board: Arc::default(),
        };
        let (sender, ended) = watch::channel(());
        let mut state = self.state();
        if state.is_closing() {
            run.control.ask(Stop::OnceSaved);
        }
        let registered = RegisteredRun {
            run: run.clone(),
            ended,
        };
        state.running.insert(lease.job, registered);
        state.share(self.cores);
        RunningJobGuard {
            registry: Arc::clone(self),
            run,
            _ended: sender,
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Every critical section leaves the state consistent, even if it panics.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for RunningJobGuard {
    fn drop(&mut self) {
        let mut state = self.registry.state();
        state.running.remove(&self.run.lease.job);
        state.share(self.registry.cores);
        drop(state);
        self.registry.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lease() -> Lease {
        Lease {
            job: JobId::new(),
            attempt: 1,
            token: 1,
        }
    }

    #[test]
    fn the_jobs_that_run_share_the_cores() {
        let registry = Arc::new(RunningJobRegistry::of_cores(5));
        let threads = |guard: &RunningJobGuard| guard.run.control.threads().unwrap_or(0);
        let first = registry.register(lease());
        assert_eq!(threads(&first), 5);
        let second = registry.register(lease());
        assert_eq!(threads(&first) + threads(&second), 5);
        assert!(threads(&first).abs_diff(threads(&second)) == 1);
        drop(first);
        assert_eq!(threads(&second), 5);
        let crowd: Vec<_> = (0..6).map(|_| registry.register(lease())).collect();
        assert!(crowd.iter().all(|guard| threads(guard) == 1));
    }

    #[test]
    fn a_job_seated_on_a_closing_bench_is_asked_to_stop_at_once() {
        let registry = Arc::new(RunningJobRegistry::of_cores(2));
        let early = registry.register(lease());
        assert!(!early.run.control.is_raised());
        registry.close();
        assert_eq!(early.run.control.asked(), Stop::OnceSaved);
        assert!(registry.register(lease()).run.control.is_raised());
        assert_eq!(registry.submissions(), None);
    }

    #[test]
    fn a_job_that_left_its_place_can_not_be_stopped() {
        let registry = Arc::new(RunningJobRegistry::of_cores(2));
        let lease = lease();
        let job = lease.job;
        let guard = registry.register(lease);
        assert_eq!(registry.runs().len(), 1);
        let ended = registry.stop_job(job).unwrap();
        assert_eq!(guard.run.control.asked(), Stop::AtOnce);
        assert!(ended.has_changed().is_ok());
        drop(guard);
        assert!(
            ended.has_changed().is_err(),
            "the end is seen as a closed channel"
        );
        assert!(registry.stop_job(job).is_none());
    }

    #[test]
    fn a_submission_before_the_wait_is_not_slept_through() {
        let registry = RunningJobRegistry::of_cores(2);
        let seen = registry.submissions().unwrap();
        registry.announce();
        let began = Instant::now();
        registry.wait(seen);
        assert!(began.elapsed() < IDLE_LOOK);
    }
}
