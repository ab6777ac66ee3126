//! The workers: threads of their own, so that computations and answers
//! don't delay each other.

use super::job_limits::JobLimits;
use super::lease_heartbeat::LeaseHeartbeat;
use super::memory_budget::MemoryBudget;
use super::running_jobs::RunningJobRegistry;
use super::store::{JobStore, Lease, TerrainStore};
use super::worker;
use crate::config::{PoolSize, Queue, Recording, Retention, ServiceConfig};
use crate::terrains::ScenarioReader;
use std::io;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tokio::runtime::Handle;
use tokio::task::AbortHandle;

/// Share of the drain time after which a job that has not saved its state is cancelled.
pub(super) const GRACE: f64 = 0.7;

/// The workers of a service.
#[derive(Debug)]
pub struct Pool {
    threads: Vec<JoinHandle<()>>,
    equipment: Equipment,
    /// Time that running jobs have once the pool stops.
    drain: Duration,
    /// Announces jobs that other processes have put into the queue.
    announcer: AbortHandle,
    /// Dropped last: leases are renewed until every worker has ended.
    _keeper: LeaseHeartbeat,
}

/// Resources that a worker needs.
#[derive(Debug, Clone)]
pub(super) struct Equipment {
    /// Name of the process among those that share the database.
    pub(super) name: String,
    pub(super) store: Arc<dyn JobStore>,
    /// Reader of scenarios with their maps.
    pub(super) reader: ScenarioReader,
    pub(super) runtime: Handle,
    pub(super) registry: Arc<RunningJobRegistry>,
    pub(super) threads: usize,
    pub(super) memory: Arc<MemoryBudget>,
    pub(super) started: Instant,
    pub(super) queue: Queue,
    pub(super) recording: Recording,
    pub(super) job_limits: JobLimits,
    /// Retention of jobs that have ended; `None`: it is left to others.
    pub(super) retention: Option<Retention>,
}

/// Terms on which a pool is started.
#[derive(Debug)]
pub struct PoolStart {
    /// Size of the pool.
    pub size: PoolSize,
    /// Name of the process among those that share the database.
    pub name: String,
    /// Limits of jobs.
    pub job_limits: JobLimits,
    /// Number of jobs reclaimed from a former process; `None`: they could not be yet.
    pub left_running: Option<usize>,
    /// True if old jobs are removed by this process.
    pub removes_old: bool,
}

impl Pool {
    /// Starts the workers. They use the current tokio runtime for the database.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub fn start(
        store: Arc<dyn JobStore>,
        config: &ServiceConfig,
        PoolStart {
            size,
            name,
            job_limits,
            left_running,
            removes_old,
        }: PoolStart,
    ) -> io::Result<Self> {
        let equipment = Equipment {
            name,
            reader: ScenarioReader::new(Arc::clone(&store) as Arc<dyn TerrainStore>),
            store,
            runtime: Handle::current(),
            registry: Arc::new(RunningJobRegistry::of_cores(size.cores)),
            threads: size.threads_per_worker,
            memory: Arc::new(MemoryBudget::new(job_limits.memory_of_all_bytes)),
            started: Instant::now(),
            queue: config.queue.clone(),
            recording: config.recording.clone(),
            job_limits,
            retention: removes_old.then(|| config.retention.clone()),
        };
        if let Some(count) = left_running {
            equipment.registry.open(count);
        }
        let mut pool = Self {
            threads: Vec::new(),
            equipment: equipment.clone(),
            drain: config.limits.drain_timeout(),
            announcer: announce(&equipment),
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

    /// Reader of scenarios with their maps, which it shares with the workers.
    pub fn reader(&self) -> ScenarioReader {
        self.equipment.reader.clone()
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
        self.announcer.abort();
        self.equipment.registry.close();
    }
}

/// Wakes the workers whenever another process has put jobs into the queue.
fn announce(equipment: &Equipment) -> AbortHandle {
    let (store, registry) = (equipment.store.clone(), equipment.registry.clone());
    let announcing = async move {
        loop {
            store.wait_for_jobs().await;
            registry.announce();
        }
    };
    equipment.runtime.spawn(announcing).abort_handle()
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
        match self.runtime.block_on(self.store.reclaim_own(&self.name)) {
            Ok(count) => self.registry.open(count),
            Err(error) => tracing::warn!(%error, "former jobs can't be reclaimed now"),
        }
    }
}
