//! The service as a whole: started with a configuration, stopped gracefully.

use crate::config::{ConfigError, Database, PoolSize, ServiceConfig};
use crate::database::{self, Part};
use crate::http::{self, Services};
use crate::jobs::pool::{Pool, PoolStart};
use crate::jobs::store::sqlite::backup;
use crate::jobs::store::{JobStore, StoreError, StoreErrorKind, StudyStore, TerrainStore};
use crate::jobs::submit::Means;
use crate::jobs::{AdmissionPool, Followers, JobLimits, JobService};
use crate::machine::cores;
use crate::studies::{self, StudyService};
use crate::terrains::TerrainService;
use crate::webhooks;
use std::io;
use std::net::SocketAddr;
use std::path::Path;
use std::sync::Arc;
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::sync::watch;
use tokio::task::JoinHandle;

pub use backup::{Backup, BackupError};

/// Connections of a service to a database on a server, besides those of its workers.
const CONNECTIONS: u32 = 8;

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
        source: io::Error,
    },
    /// The database can't be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The workers can't be started.
    #[error("cannot start the workers: {0}")]
    Workers(io::Error),
}

/// A service that takes requests and runs jobs until it is stopped.
#[derive(Debug)]
pub struct RunningService {
    address: SocketAddr,
    store: Arc<dyn StudyStore>,
    tasks: Tasks,
}

/// Tasks of a service.
#[derive(Debug)]
struct Tasks {
    pool: Pool,
    news: JoinHandle<()>,
    driver: JoinHandle<()>,
    webhooks: Vec<JoinHandle<()>>,
    /// It only ends by itself if its listener is dead; `None` once that has been told.
    server: Option<JoinHandle<io::Result<()>>>,
    stop: watch::Sender<bool>,
}

impl RunningService {
    /// Address of the listener; if port 0 was asked for, with the actual port.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Returns why the service serves no requests any more, without having been stopped.
    pub async fn broken(&mut self) -> String {
        let Some(server) = &mut self.tasks.server else {
            return "the server has ended".to_owned();
        };
        let ended = server.await;
        self.tasks.server = None;
        match ended {
            Ok(Ok(())) => "the server has ended".to_owned(),
            Ok(Err(error)) => format!("no connection can be accepted any more: {error}"),
            Err(error) => format!("the server broke off: {error}"),
        }
    }

    /// Refuses new requests, completes those in progress, saves running jobs and
    /// releases them into the queue, and returns once all is written.
    pub async fn stop(self) {
        let Tasks {
            pool,
            news,
            driver,
            webhooks,
            server,
            stop,
        } = self.tasks;
        stop.send_replace(true);
        let workers = tokio::task::spawn_blocking(move || pool.stop());
        if let Some(server) = server
            && let Err(error) = server.await
        {
            tracing::error!(%error, "the server did not stop as it should");
        }
        for webhook in webhooks {
            if let Err(error) = webhook.await {
                tracing::error!(%error, "a webhook did not stop as it should");
            }
        }
        for (what, ended) in [
            ("workers", workers.await),
            ("news", news.await),
            ("studies", driver.await),
        ] {
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
    let size = config.check(cores())?;
    let (listener, address) = listen(config.listen).await?;
    let connections = CONNECTIONS + u32::try_from(size.workers).unwrap_or(u32::MAX);
    let store = database::open(&config, Part::Service, connections).await?;
    match serve(&config, size, &store, listener).await {
        Ok(tasks) => {
            tracing::info!(%address, ?size, database = %config.database, "serving");
            Ok(RunningService {
                address,
                store,
                tasks,
            })
        }
        Err(error) => {
            store.close().await;
            Err(error)
        }
    }
}

/// Copies a database, which a service may be using, to a file.
///
/// # Errors
/// [`BackupError`]; the destination is unchanged then.
pub async fn back_up(
    database: &Database,
    destination: &Path,
    replace: bool,
) -> Result<Backup, BackupError> {
    match database {
        Database::File(path) => backup::back_up(path, destination, replace).await,
        Database::Postgres(_) => Err(BackupError::OnServer),
    }
}

async fn serve(
    config: &ServiceConfig,
    size: PoolSize,
    studies_store: &Arc<dyn StudyStore>,
    listener: TcpListener,
) -> Result<Tasks, StartError> {
    let store: &Arc<dyn JobStore> = &(Arc::clone(studies_store) as Arc<dyn JobStore>);
    let name = database::name_of_process(config);
    let left_running = left_running(&name, store).await?;
    let job_limits = JobLimits::new(&config.limits);
    let means = Means {
        threads_per_worker: size.threads_per_worker,
        point_steps: config.limits.job_point_steps,
        memory_bytes: job_limits.memory_bytes,
    };
    let start = PoolStart {
        size,
        name,
        job_limits,
        left_running,
        removes_old: true,
    };
    let pool = Pool::start(Arc::clone(store), config, start).map_err(StartError::Workers)?;
    let (stop, stopped) = watch::channel(false);
    let (followers, news) = Followers::start(Arc::clone(store), stopped.clone());
    let admission = AdmissionPool::new(&config.admission, cores());
    let terrains = TerrainService::new(
        Arc::clone(studies_store) as Arc<dyn TerrainStore>,
        admission.clone(),
        config.limits.clone(),
    );
    let jobs = JobService::new(
        Arc::clone(store),
        pool.registry(),
        config.limits.clone(),
        (admission, means, pool.reader()),
        followers,
    );
    let webhooks = webhooks::start(&config.webhooks, store, &jobs, &stopped);
    let studies = StudyService::new(
        Arc::clone(studies_store),
        jobs.clone(),
        size.workers,
        (config.limits.studies, config.retention.ended_jobs()),
    );
    let driver = studies::driver::start(studies.clone());
    let router = http::router(
        Services {
            jobs,
            studies,
            terrains,
        },
        config,
    );
    let server = http::server::serve(listener, router, config.limits.clone(), stopped);
    Ok(Tasks {
        pool,
        news,
        driver,
        webhooks,
        server: Some(tokio::spawn(server)),
        stop,
    })
}

/// Number of jobs that a former process left running, once they are reclaimed; `None` if the
/// database can't be written now.
async fn left_running(name: &str, store: &Arc<dyn JobStore>) -> Result<Option<usize>, StoreError> {
    match store.reclaim_own(name).await {
        Ok(count) => Ok(Some(count)),
        Err(error) => match error.kind() {
            StoreErrorKind::Damaged | StoreErrorKind::Defect => Err(error),
            StoreErrorKind::Full | StoreErrorKind::Unavailable => {
                tracing::error!(%error, "no job is run until the database can be written");
                Ok(None)
            }
        },
    }
}

async fn listen(address: SocketAddr) -> Result<(TcpListener, SocketAddr), StartError> {
    let failed = |source| StartError::Listen { address, source };
    let listener = TcpListener::bind(address).await.map_err(failed)?;
    let address = listener.local_addr().map_err(failed)?;
    Ok((listener, address))
}
