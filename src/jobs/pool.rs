//! The workers: threads of their own, so that a long computation never holds up
//! an answer, and an answer never holds up a computation.

use super::job::JobId;
use super::keeper::Keeper;
use super::progress::ProgressBoard;
use super::runner::{Stop, StopFlag};
use super::store::{Lease, Store};
use super::worker;
use crate::config::{PoolSize, Queue, Recording, Retention, ServiceConfig};
use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use tokio::sync::watch;

/// Time that an idle worker sleeps before it looks for work unasked, in case a job had to
/// wait after a failed attempt.
const IDLE_LOOK: Duration = Duration::from_secs(1);

/// The workers of a service.
#[derive(Debug)]
pub struct Pool {
    bench: Arc<Bench>,
    threads: Vec<JoinHandle<()>>,
    /// Dropped last: leases are kept until every worker has gone home.
    _keeper: Keeper,
}

/// Equipment that a worker needs to work.
#[derive(Debug, Clone)]
pub(super) struct Equipment {
    pub(super) store: Store,
    pub(super) runtime: Handle,
    pub(super) bench: Arc<Bench>,
    pub(super) threads: usize,
    pub(super) started: Instant,
    pub(super) queue: Queue,
    pub(super) recording: Recording,
    pub(super) retention: Retention,
}

/// Bench where workers wait for work, and where running jobs can be stopped.
#[derive(Debug, Default)]
pub struct Bench {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    /// Grows with every job that was submitted.
    submissions: u64,
    closing: bool,
    running: BTreeMap<JobId, Seated>,
}

#[derive(Debug)]
struct Seated {
    run: Run,
    ended: watch::Receiver<()>,
}

/// A running job, for whoever keeps its lease.
#[derive(Debug, Clone)]
pub(super) struct Run {
    pub(super) lease: Lease,
    pub(super) stop: Arc<StopFlag>,
    pub(super) board: Arc<ProgressBoard>,
}

/// A running job's place on the bench; leaving it tells those who wait.
#[derive(Debug)]
pub(super) struct Place {
    bench: Arc<Bench>,
    pub(super) run: Run,
    _ended: watch::Sender<()>,
}

impl Pool {
    /// Starts the workers. They use the current tokio runtime for the database.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn start(store: &Store, size: PoolSize, config: &ServiceConfig) -> io::Result<Self> {
        let equipment = Equipment {
            store: store.clone(),
            runtime: Handle::current(),
            bench: Arc::default(),
            threads: size.threads_per_worker,
            started: Instant::now(),
            queue: config.queue.clone(),
            recording: config.recording.clone(),
            retention: config.retention.clone(),
        };
        let mut pool = Self {
            bench: Arc::clone(&equipment.bench),
            threads: Vec::new(),
            _keeper: Keeper::start(equipment.clone())?,
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

    /// Bench where the workers wait.
    pub fn bench(&self) -> Arc<Bench> {
        Arc::clone(&self.bench)
    }

    /// Has running jobs save their state and go back into the queue, and waits
    /// until every worker has gone home. Blocks.
    pub fn stop(mut self) {
        self.bench.close();
        for thread in self.threads.drain(..) {
            if thread.join().is_err() {
                tracing::error!("a worker thread had panicked");
            }
        }
    }
}

/// A pool that is dropped, because the service could not start or was never
/// stopped, at least sends its workers home.
impl Drop for Pool {
    fn drop(&mut self) {
        self.bench.close();
    }
}

impl Bench {
    /// Tells the workers that a job was submitted.
    pub fn announce(&self) {
        self.state().submissions += 1;
        self.changed.notify_all();
    }

    /// Asks a running job to stop, and returns what to wait on for its end;
    /// `None` if no worker runs it.
    pub fn stop_job(&self, job: JobId) -> Option<watch::Receiver<()>> {
        let state = self.state();
        let seated = state.running.get(&job)?;
        seated.run.stop.raise();
        Some(seated.ended.clone())
    }

    fn close(&self) {
        let mut state = self.state();
        state.closing = true;
        for seated in state.running.values() {
            seated.run.stop.ask(Stop::OnceSaved);
        }
        self.changed.notify_all();
    }

    /// The jobs that run.
    pub(super) fn runs(&self) -> Vec<Run> {
        let state = self.state();
        state
            .running
            .values()
            .map(|seated| seated.run.clone())
            .collect()
    }

    /// Waits a while, or less if the bench closes. Whether it is still open.
    pub(super) fn pause(&self, pause: Duration) -> bool {
        let state = self.state();
        let waited = self
            .changed
            .wait_timeout_while(state, pause, |state| !state.closing);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        !state.closing
    }

    /// Submissions so far; `None` once the bench is closed.
    pub fn submissions(&self) -> Option<u64> {
        let state = self.state();
        (!state.closing).then_some(state.submissions)
    }

    /// Waits for a submission after the `seen`-th, or for the bench to close.
    pub(super) fn wait(&self, seen: u64) {
        let state = self.state();
        let idle = |state: &mut State| !state.closing && state.submissions == seen;
        // Woken or timed out: the worker looks for work either way.
        drop(self.changed.wait_timeout_while(state, IDLE_LOOK, idle));
    }

    /// Gives a job that is about to run its place.
    pub(super) fn seat(self: &Arc<Self>, lease: Lease) -> Place {
        let run = Run {
            lease,
            stop: Arc::default(),
            board: Arc::default(),
        };
        let (sender, ended) = watch::channel(());
        let mut state = self.state();
        if state.closing {
            run.stop.ask(Stop::OnceSaved);
        }
        let seated = Seated {
            run: run.clone(),
            ended,
        };
        state.running.insert(lease.job, seated);
        Place {
            bench: Arc::clone(self),
            run,
            _ended: sender,
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Every critical section leaves the state whole, even one that panicked.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.bench.state().running.remove(&self.run.lease.job);
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
    fn a_job_seated_on_a_closing_bench_is_asked_to_stop_at_once() {
        let bench = Arc::new(Bench::default());
        let early = bench.seat(lease());
        assert!(!early.run.stop.is_raised());
        bench.close();
        assert_eq!(early.run.stop.asked(), Stop::OnceSaved);
        assert!(bench.seat(lease()).run.stop.is_raised());
        assert_eq!(bench.submissions(), None);
    }

    #[test]
    fn a_job_that_left_its_place_can_not_be_stopped() {
        let bench = Arc::new(Bench::default());
        let lease = lease();
        let job = lease.job;
        let place = bench.seat(lease);
        assert_eq!(bench.runs().len(), 1);
        let ended = bench.stop_job(job).unwrap();
        assert_eq!(place.run.stop.asked(), Stop::AtOnce);
        assert!(ended.has_changed().is_ok());
        drop(place);
        assert!(
            ended.has_changed().is_err(),
            "the end is seen as a closed channel"
        );
        assert!(bench.stop_job(job).is_none());
    }

    #[test]
    fn a_submission_before_the_wait_is_not_slept_through() {
        let bench = Bench::default();
        let seen = bench.submissions().unwrap();
        bench.announce();
        let began = Instant::now();
        bench.wait(seen);
        assert!(began.elapsed() < IDLE_LOOK);
    }
}
