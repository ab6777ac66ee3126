//! Job service: all operations on jobs that clients may ask for.

use super::admission::InFlight;
use super::forecast::{ForecastError, Planned, forecast};
use super::job::{Job, JobId, JobStatus, JobSummary};
use super::pool::RunningJobRegistry;
use super::store::{Dismissal, Event, JobCounts, JobStore, Page, Removal, StoreError};
use super::submit::{self, Means, NewJob, ScenarioError};
use crate::config::Limits;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;
use tokio::sync::Mutex;
use tokio::task::spawn_blocking;
use tokio::time::{Instant, sleep, timeout};

/// Time that a dismissal waits for the run to end, so that its answer shows the job's final
/// state. A run stops after the current sub-step, well within this time.
const STOP_WAIT: Duration = Duration::from_millis(450);

/// Time between two polls for the end of a job.
const LOOK_PAUSE: Duration = Duration::from_millis(50);

/// Service that clients use to submit, follow, dismiss and remove jobs.
#[derive(Debug, Clone)]
pub struct JobService {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) registry: Arc<RunningJobRegistry>,
    pub(super) limits: Limits,
    pub(super) in_flight: InFlight,
    threads_per_worker: usize,
    planning: Arc<Mutex<()>>,
}

/// Reason why there is no plan.
#[derive(Debug, Error)]
pub enum PlanError {
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The first steps fail.
    #[error(transparent)]
    Forecast(#[from] ForecastError),
    /// The planning task panicked or was cancelled.
    #[error("planning broke off: {0}")]
    BrokenOff(String),
}

/// Result of a request to dismiss a job.
#[derive(Debug, Clone)]
pub enum Dismissed {
    /// The job does not exist.
    Unknown,
    /// The job is dismissed, by this or an earlier request.
    Done(Box<Job>),
    /// The job had already ended in this state.
    TooLate(JobStatus),
}

impl JobService {
    /// Service for the jobs in this store, run by the workers of this registry.
    pub fn new(
        store: Arc<dyn JobStore>,
        registry: Arc<RunningJobRegistry>,
        limits: Limits,
        threads_per_worker: usize,
    ) -> Self {
        Self {
            store,
            registry,
            limits,
            in_flight: InFlight::default(),
            threads_per_worker,
            planning: Arc::default(),
        }
    }

    /// Checks a scenario.
    ///
    /// # Errors
    /// All rules that the scenario breaks.
    pub fn validate(&self, scenario: &str, labels: Vec<String>) -> Result<NewJob, ScenarioError> {
        let means = Means {
            threads_per_worker: self.threads_per_worker,
            point_steps: self.limits.job_point_steps,
        };
        submit::validate(scenario, &means, labels)
    }

    /// Plan of a job with this scenario, and a forecast of its wall time.
    ///
    /// # Errors
    /// The scenario is invalid, or its first steps fail.
    pub async fn plan(&self, scenario: &str) -> Result<Planned, PlanError> {
        let threads = self.threads_per_worker;
        let prepared = submit::read(scenario, threads)?;
        let threads = prepared.scenario.numerics.threads.unwrap_or(threads);
        // One plan at a time: concurrent timings would slow each other.
        let _alone = self.planning.lock().await;
        let planned = spawn_blocking(move || forecast(&prepared, threads)).await;
        planned
            .map_err(|error| PlanError::BrokenOff(error.to_string()))?
            .map_err(Into::into)
    }

    /// The job, if there is one.
    ///
    /// # Errors
    /// The store's own.
    pub async fn job(&self, id: JobId) -> Result<Option<Job>, StoreError> {
        self.store.job(id).await
    }

    /// A page of jobs, newest first.
    ///
    /// # Errors
    /// The store's own.
    pub async fn page(&self, page: &Page) -> Result<Vec<JobSummary>, StoreError> {
        self.store.page(page).await
    }

    /// Dismisses a job. A running one is stopped and keeps its records.
    ///
    /// # Errors
    /// The store's own.
    pub async fn dismiss(&self, id: JobId) -> Result<Dismissed, StoreError> {
        match self.store.dismiss(id).await? {
            Dismissal::Unknown => return Ok(Dismissed::Unknown),
            Dismissal::Ended(status) => return Ok(Dismissed::TooLate(status)),
            Dismissal::Dismissed => {}
        }
        if let Some(mut ended) = self.registry.stop_job(id) {
            // Nothing is ever sent: the wait ends when the run's guard is dropped.
            // A run that takes longer is dismissed all the same.
            drop(timeout(STOP_WAIT, ended.changed()).await);
        }
        let job = self.store.job(id).await?;
        Ok(job.map_or(Dismissed::Unknown, |job| Dismissed::Done(Box::new(job))))
    }

    /// The state of a job, if there is one.
    ///
    /// # Errors
    /// The store's own.
    pub async fn status(&self, id: JobId) -> Result<Option<JobStatus>, StoreError> {
        self.store.status(id).await
    }

    /// Waits until a job has ended or been removed, or until the time is over.
    ///
    /// # Errors
    /// The store's own.
    pub async fn wait_for_end(&self, id: JobId, longest: Duration) -> Result<(), StoreError> {
        let end = Instant::now() + longest;
        while self
            .status(id)
            .await?
            .is_some_and(|status| !status.is_final())
        {
            if Instant::now() >= end || self.is_closing() {
                break;
            }
            sleep(LOOK_PAUSE.min(end.duration_since(Instant::now()))).await;
        }
        Ok(())
    }

    /// Removes a job that has ended, with all its records.
    ///
    /// # Errors
    /// The store's own.
    pub async fn remove(&self, id: JobId) -> Result<Removal, StoreError> {
        self.store.remove(id).await
    }

    /// The next events after number `after`, of one job or of all.
    ///
    /// # Errors
    /// The store's own.
    pub async fn events(&self, after: i64, job: Option<JobId>) -> Result<Vec<Event>, StoreError> {
        self.store.events(after, job).await
    }

    /// Number of the last event.
    ///
    /// # Errors
    /// The store's own.
    pub async fn last_event(&self) -> Result<i64, StoreError> {
        self.store.last_event().await
    }

    /// True if the service is stopping.
    pub fn is_closing(&self) -> bool {
        self.registry.submissions().is_none()
    }

    /// Counts jobs.
    ///
    /// # Errors
    /// The store's own.
    pub async fn count_jobs(&self) -> Result<JobCounts, StoreError> {
        self.store.count_jobs().await
    }

    /// Checks with a real write that a job could be stored now.
    ///
    /// # Errors
    /// A job could not be stored.
    pub async fn probe(&self) -> Result<(), StoreError> {
        self.store.probe().await
    }

    /// Checks that the database answers.
    ///
    /// # Errors
    /// The database does not answer.
    pub async fn ping(&self) -> Result<(), StoreError> {
        self.store.ping().await
    }
}
