//! The workers: threads of their own, so that a long computation never holds up
//! an answer, and an answer never holds up a computation.

use super::job::JobId;
use super::runner::StopFlag;
use super::store::Store;
use super::worker;
use crate::config::PoolSize;
use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::runtime::Handle;
use tokio::sync::watch;

/// How long an idle worker sleeps before it looks for work unasked, in case
/// the database failed when it was told.
const IDLE_LOOK: Duration = Duration::from_secs(5);

/// The workers of a service.
#[derive(Debug)]
pub struct Pool {
    bench: Arc<Bench>,
    threads: Vec<JoinHandle<()>>,
}

/// What a worker needs to work.
#[derive(Debug, Clone)]
pub(super) struct Equipment {
    pub(super) store: Store,
    pub(super) runtime: Handle,
    pub(super) bench: Arc<Bench>,
    pub(super) threads: usize,
    pub(super) flush_interval: Duration,
}

/// Where workers wait for work, and where running jobs can be stopped.
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
    running: BTreeMap<JobId, Run>,
}

#[derive(Debug)]
struct Run {
    stop: Arc<StopFlag>,
    ended: watch::Receiver<()>,
}

/// A running job's place on the bench; leaving it tells those who wait.
#[derive(Debug)]
pub(super) struct Place {
    bench: Arc<Bench>,
    job: JobId,
    pub(super) stop: Arc<StopFlag>,
    _ended: watch::Sender<()>,
}

impl Pool {
    /// Starts the workers. They use the current tokio runtime for the database.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn start(store: &Store, size: PoolSize, flush_interval: Duration) -> io::Result<Self> {
        let mut pool = Self {
            bench: Arc::default(),
            threads: Vec::new(),
        };
        let equipment = Equipment {
            store: store.clone(),
            runtime: Handle::current(),
            bench: Arc::clone(&pool.bench),
            threads: size.threads_per_worker,
            flush_interval,
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

    /// Where the workers wait.
    pub fn bench(&self) -> Arc<Bench> {
        Arc::clone(&self.bench)
    }

    /// Interrupts running jobs, which go back into the queue, and waits until
    /// every worker has gone home. Blocks.
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
        let run = state.running.get(&job)?;
        run.stop.raise();
        Some(run.ended.clone())
    }

    fn close(&self) {
        let mut state = self.state();
        state.closing = true;
        state.running.values().for_each(|run| run.stop.raise());
        self.changed.notify_all();
    }

    /// Submissions so far; `None` once the bench is closed.
    pub(super) fn submissions(&self) -> Option<u64> {
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
    pub(super) fn seat(self: &Arc<Self>, job: JobId) -> Place {
        let stop = Arc::new(StopFlag::default());
        let (sender, ended) = watch::channel(());
        let mut state = self.state();
        if state.closing {
            stop.raise();
        }
        state.running.insert(
            job,
            Run {
                stop: Arc::clone(&stop),
                ended,
            },
        );
        Place {
            bench: Arc::clone(self),
            job,
            stop,
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
        self.bench.state().running.remove(&self.job);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_job_seated_on_a_closing_bench_is_asked_to_stop_at_once() {
        let bench = Arc::new(Bench::default());
        let early = bench.seat(JobId::new());
        assert!(!early.stop.is_raised());
        bench.close();
        assert!(early.stop.is_raised());
        assert!(bench.seat(JobId::new()).stop.is_raised());
        assert_eq!(bench.submissions(), None);
    }

    #[test]
    fn a_job_that_left_its_place_can_not_be_stopped() {
        let bench = Arc::new(Bench::default());
        let job = JobId::new();
        let place = bench.seat(job);
        let ended = bench.stop_job(job).unwrap();
        assert!(place.stop.is_raised());
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
        let began = std::time::Instant::now();
        bench.wait(seen);
        assert!(began.elapsed() < IDLE_LOOK);
    }
}
