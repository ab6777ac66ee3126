//! The service as a whole: started with a configuration, stopped gracefully.

use crate::config::{ConfigError, PoolSize, ServiceConfig};
use crate::http;
use crate::jobs::JobService;
use crate::jobs::clock::SystemClock;
use crate::jobs::pool::Pool;
use crate::jobs::store::sqlite::{SqliteStore, backup};
use crate::jobs::store::{JobStore, StoreError, StoreErrorKind};
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::sync::watch;
use tokio::task::JoinHandle;

pub use backup::{Backup, BackupError};

/// Error at the start of the service.
#[derive(Debug, Error)]
pub enum StartError {
    /// The configuration is not allowed.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The service can't listen at the address.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address asked for.
        address: SocketAddr,
        /// Error of the system.
        source: std::io::Error,
    },
    /// The database can't be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The workers can't be started.
    #[error("cannot start the workers: {0}")]
    Workers(std::io::Error),
}

/// A service that takes requests and runs jobs until it is stopped.
#[derive(Debug)]
pub struct RunningService {
    address: SocketAddr,
    store: Arc<dyn JobStore>,
    pool: Pool,
    server: JoinHandle<()>,
    stop: watch::Sender<bool>,
}

impl RunningService {
    /// Address of the listener; if port 0 was asked for, with the actual port.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Refuses new requests, completes those in progress, saves running jobs and
    /// releases them into the queue, and returns once all is written.
    pub async fn stop(self) {
        self.stop.send_replace(true);
        let pool = self.pool;
        let workers = tokio::task::spawn_blocking(move || pool.stop());
        let (server, workers) = tokio::join!(self.server, workers);
        for (what, ended) in [("server", server), ("workers", workers)] {
            if let Err(error) = ended {
                tracing::error!(%error, what, "did not stop as it should");
            }
        }
        self.store.close().await;
        tracing::info!("stopped");
    }
}

/// Starts the service on the current tokio runtime. Runs the jobs that were waiting
/// when the last service stopped, and those under which it died.
///
/// # Errors
/// [`StartError`]; nothing is left running then.
pub async fn start(config: ServiceConfig) -> Result<RunningService, StartError> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let size = config.check(cores)?;
    let (listener, address) = listen(config.listen).await?;
    let store = open_store(&config).await?;
    match serve(&config, size, &store, listener).await {
        Ok((pool, server, stop)) => {
            tracing::info!(%address, ?size, database = %config.database.display(), "serving");
            Ok(RunningService {
                address,
                store,
                pool,
                server,
                stop,
            })
        }
        Err(error) => {
            store.close().await;
            Err(error)
        }
    }
}

/// The store of the service: the one place that names a database.
async fn open_store(config: &ServiceConfig) -> Result<Arc<dyn JobStore>, StoreError> {
    let largest = config.limits.database_bytes;
    let store =
        SqliteStore::open_with(&config.database, largest, Arc::new(SystemClock::default())).await?;
    Ok(Arc::new(store))
}

/// Copies a database, which a service may be using, to a file.
///
/// # Errors
/// [`BackupError`]; the destination is unchanged then.
pub async fn back_up(
    database: &Path,
    destination: &Path,
    replace: bool,
) -> Result<Backup, BackupError> {
    backup::back_up(database, destination, replace).await
}

async fn serve(
    config: &ServiceConfig,
    size: PoolSize,
    store: &Arc<dyn JobStore>,
    listener: TcpListener,
) -> Result<(Pool, JoinHandle<()>, watch::Sender<bool>), StartError> {
    let left_running = left_running(config, store).await?;
    let pool = Pool::start(Arc::clone(store), size, config, left_running);
    let pool = pool.map_err(StartError::Workers)?;
    let limits = config.limits.clone();
    let jobs = JobService::new(
        Arc::clone(store),
        pool.registry(),
        limits,
        size.threads_per_worker,
    );
    let router = http::router(jobs, config);
    let (stop, stopped) = watch::channel(false);
    let server = http::server::serve(listener, router, config.limits.clone(), stopped);
    Ok((pool, tokio::spawn(server), stop))
}

/// Number of jobs that a former process left running, once they are reclaimed; `None` if the
/// database can't be written now.
async fn left_running(
    config: &ServiceConfig,
    store: &Arc<dyn JobStore>,
) -> Result<Option<usize>, StoreError> {
    match store.reclaim_own(&config.queue.name).await {
        Ok(count) => Ok(Some(count)),
        Err(error) if error.kind() == StoreErrorKind::Defect => Err(error),
        Err(error) => {
            tracing::error!(%error, "no job is run until the database can be written");
            Ok(None)
        }
    }
}

async fn listen(address: SocketAddr) -> Result<(TcpListener, SocketAddr), StartError> {
    let failed = |source| StartError::Listen { address, source };
    let listener = TcpListener::bind(address).await.map_err(failed)?;
    let address = listener.local_addr().map_err(failed)?;
    Ok((listener, address))
}
