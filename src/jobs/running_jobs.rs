//! Running jobs of a service: workers wait for work, jobs are stopped, and the cores are shared.

use super::job::JobId;
use super::store::Lease;
use crate::runs::{Progress, ProgressBoard, RunControl, Stop};
use std::collections::BTreeMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::watch;

/// Time after which one of the idle workers looks for work without being woken, in case a job had
/// to wait after a failed attempt.
const IDLE_LOOK: Duration = Duration::from_secs(1);

/// Registry of running jobs: workers wait in it for work, jobs are stopped through it, and share
/// the cores by it.
#[derive(Debug)]
pub struct RunningJobRegistry {
    cores: usize,
    state: Mutex<State>,
    changed: Condvar,
    /// For idle workers alone, of whom one at a time is woken.
    work: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// True if there may be work that no worker has looked for.
    is_news: bool,
    /// Last look of an idle worker without news.
    looked: Option<Instant>,
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
            work: Condvar::new(),
        }
    }

    /// Lets the workers claim jobs: those that were left running, this many, are reclaimed.
    pub(super) fn open(&self, left_running: usize) {
        if left_running > 0 {
            tracing::warn!(left_running, "the last service died under jobs: they go on");
        }
        self.state().open = true;
        self.changed.notify_all();
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

    /// Tells the workers that there may be work: one of them looks, and announces it to the next if
    /// it finds some. So however many are idle, only one asks in vain.
    pub fn announce(&self) {
        self.state().is_news = true;
        self.work.notify_one();
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
        self.work.notify_all();
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

    /// True once the service stops.
    pub(super) fn is_closing(&self) -> bool {
        self.state().is_closing()
    }

    /// Waits until this worker is to look for work, or until the registry closes.
    pub(super) fn wait(&self) {
        let mut state = self.state();
        while !state.is_closing() && !std::mem::take(&mut state.is_news) {
            let since = state.looked.map_or(IDLE_LOOK, |looked| looked.elapsed());
            let Some(left) = IDLE_LOOK.checked_sub(since).filter(|left| !left.is_zero()) else {
                state.looked = Some(Instant::now());
                return;
            };
            let waited = self.work.wait_timeout(state, left);
            (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        }
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
    use std::sync::atomic::{AtomicUsize, Ordering};

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
        assert!(registry.is_closing());
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
        // The first look without news.
        registry.wait();
        registry.announce();
        let began = Instant::now();
        registry.wait();
        assert!(began.elapsed() < IDLE_LOOK);
    }

    #[test]
    fn of_many_idle_workers_one_looks_at_a_time() {
        let registry = RunningJobRegistry::of_cores(2);
        let looks = AtomicUsize::new(0);
        let began = Instant::now();
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    while !registry.is_closing() {
                        registry.wait();
                        looks.fetch_add(1, Ordering::Relaxed);
                    }
                });
            }
            std::thread::sleep(IDLE_LOOK / 2);
            registry.announce();
            std::thread::sleep(IDLE_LOOK);
            registry.close();
        });
        // The first, that of the announcement, one a pause, and that of each when it closes.
        let pauses = began.elapsed().div_duration_f64(IDLE_LOOK) as usize;
        let looks = looks.into_inner();
        assert!((10..=2 + pauses + 8).contains(&looks), "{looks}");
    }
}
