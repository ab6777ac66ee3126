//! Running jobs of a service: workers wait for work, jobs are stopped, and the cores are shared.

use super::job::JobId;
use super::store::Lease;
use crate::runs::{Progress, ProgressBoard, RunControl, Stop};
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Time after which an idle worker looks for work without being woken, in case a job had to
/// wait after a failed attempt.
const IDLE_LOOK: Duration = Duration::from_secs(1);

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

    /// Shares the cores among the jobs that have begun, those that came first having one more if
    /// they do not divide evenly.
    fn share(&self, cores: usize) {
        let begun = || self.running.values().filter(|registered| registered.begun);
        let jobs = begun().count().max(1);
        for (place, registered) in begun().enumerate() {
            let threads = cores / jobs + usize::from(place < cores % jobs);
            registered.run.control.ask_for_threads(threads.max(1));
        }
    }
}

#[derive(Debug)]
struct RegisteredRun {
    run: RunningJob,
    /// False while it waits in its worker's pack.
    begun: bool,
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

impl RunningJobRegistry {
    /// Without jobs yet, on a machine with so many cores.
    pub(super) fn of_cores(cores: usize) -> Self {
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

    pub(super) fn is_open(&self) -> bool {
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

    pub(super) fn close(&self) {
        let mut state = self.state();
        state.closing.get_or_insert_with(Instant::now);
        for registered in state.running.values() {
            registered.run.control.ask(Stop::OnceSaved);
        }
        self.changed.notify_all();
    }

    /// Waits until no job runs any more, at most for this time.
    pub(super) fn wait_until_idle(&self, longest: Duration) {
        let is_busy = |state: &mut State| !state.running.is_empty();
        let waited = self
            .changed
            .wait_timeout_while(self.state(), longest, is_busy);
        drop(waited);
    }

    /// Cancels all running jobs.
    pub(super) fn cancel(&self) {
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

    /// Registers a job that a worker has claimed; it takes no cores until it begins.
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
            begun: false,
            ended,
        };
        state.running.insert(lease.job, registered);
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

impl RunningJobGuard {
    /// Gives the job its share of the cores: it is about to run.
    pub(super) fn begin(&self) {
        let mut state = self.registry.state();
        if let Some(registered) = state.running.get_mut(&self.run.lease.job) {
            registered.begun = true;
        }
        state.share(self.registry.cores);
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
        let begun = || {
            let guard = registry.register(lease());
            guard.begin();
            guard
        };
        let first = begun();
        let _waits = registry.register(lease());
        assert_eq!(threads(&first), 5);
        let second = begun();
        assert_eq!(threads(&first) + threads(&second), 5);
        assert!(threads(&first).abs_diff(threads(&second)) == 1);
        drop(first);
        assert_eq!(threads(&second), 5);
        let crowd: Vec<_> = (0..6).map(|_| begun()).collect();
        assert!(crowd.iter().all(|guard| threads(guard) == 1));
    }

    #[test]
    fn a_job_registered_while_closing_is_asked_to_stop_at_once() {
        let registry = Arc::new(RunningJobRegistry::of_cores(2));
        let early = registry.register(lease());
        assert!(!early.run.control.is_raised());
        registry.close();
        assert_eq!(early.run.control.asked(), Stop::OnceSaved);
        assert!(registry.register(lease()).run.control.is_raised());
        assert_eq!(registry.submissions(), None);
    }

    #[test]
    fn a_job_that_has_ended_can_not_be_stopped() {
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
