//! A process of workers alone, for a database that services and other such processes share. It keeps
//! nothing of its own: jobs, results and saved states are in the database.

use crate::config::{ConfigError, PoolSize, ServiceConfig};
use crate::database::{self, Part};
use crate::jobs::JobLimits;
use crate::jobs::pool::{Pool, PoolStart};
use crate::jobs::store::{JobStore, StoreError, StudyStore};
use std::io;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;
use tokio::time::sleep;

/// Most connections of a process to the database, besides one that listens.
const CONNECTIONS_AT_MOST: usize = 8;

/// Time between two looks whether the queue is empty.
const LOOK_PAUSE: Duration = Duration::from_millis(500);

/// Error at the start of a worker process.
#[derive(Debug, Error)]
pub enum StartError {
    /// The configuration is not allowed.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The database is a file, which only a service uses.
    #[error(
        "the database {0} is a file, which one service alone can use, with workers of its own: \
         workers beside it need a PostgreSQL database (--database postgres://user@host/name)"
    )]
    NotShared(String),
    /// The database can't be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The workers can't be started.
    #[error("cannot start the workers: {0}")]
    Workers(io::Error),
}

/// Workers of a process.
#[derive(Debug)]
pub struct WorkerProcess {
    pool: Pool,
    store: Arc<dyn StudyStore>,
    /// Memory that a job may have here.
    memory_bytes: u64,
}

impl WorkerProcess {
    /// Returns once no job waits or runs, here or elsewhere, and no study runs.
    pub async fn until_empty(&self) {
        loop {
            match self.store.is_idle(self.memory_bytes).await {
                Ok(true) => return,
                Ok(false) => {}
                Err(error) => tracing::warn!(%error, "it is not known whether the queue is empty"),
            }
            sleep(LOOK_PAUSE).await;
        }
    }

    /// Saves running jobs, releases them into the queue, and returns once all is written.
    pub async fn stop(self) {
        let Self { pool, store, .. } = self;
        if let Err(error) = tokio::task::spawn_blocking(move || pool.stop()).await {
            tracing::error!(%error, "the workers did not stop as they should");
        }
        store.close().await;
        tracing::info!("stopped");
    }
}

/// Starts workers on the current tokio runtime: as many as `threads`, which they share.
///
/// # Errors
/// [`StartError`]; nothing is left running then.
pub async fn start(
    config: &ServiceConfig,
    threads: NonZeroUsize,
) -> Result<WorkerProcess, StartError> {
    config.check(threads.get())?;
    if !config.database.is_shared() {
        return Err(StartError::NotShared(config.database.to_string()));
    }
    let size = PoolSize {
        workers: threads.get(),
        threads_per_worker: threads.get(),
        cores: threads.get(),
    };
    // One for each worker and the heartbeat, as far as they need them at the same time.
    let connections = (size.workers + 1).min(CONNECTIONS_AT_MOST) as u32;
    let store = database::open(config, Part::Worker, connections).await?;
    let job_limits = JobLimits::new(&config.limits);
    let memory_bytes = job_limits.memory_bytes;
    let start = PoolStart {
        size,
        name: database::name_of_process(config),
        job_limits,
        left_running: Some(0),
        removes_old: false,
    };
    let name = start.name.clone();
    match Pool::start(Arc::clone(&store) as Arc<dyn JobStore>, config, start) {
        Ok(pool) => {
            tracing::info!(name, ?size, database = %config.database, "working");
            Ok(WorkerProcess {
                pool,
                store,
                memory_bytes,
            })
        }
        Err(error) => {
            store.close().await;
            Err(StartError::Workers(error))
        }
    }
}
