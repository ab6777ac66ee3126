//! Job service: all operations on jobs that clients may ask for.

use super::admission::InFlight;
use super::admission_pool::{AdmissionError, AdmissionPool, Admitted};
use super::forecast::{ForecastError, Planned, forecast};
use super::job::{Job, JobId, JobStatus};
use super::news::{Followers, News};
use super::recent::Recent;
use super::running_jobs::RunningJobRegistry;
use super::running_progress::RunningProgress;
use super::store::{Dismissal, Event, JobCounts, JobPage, JobStore, Page, Removal, StoreError};
use super::submit::{self, AffordableJob, Means, NewJob};
use crate::config::Limits;
use crate::terrains::{ReadError, ScenarioReader};
use scree_solver::scenario::Scenario;
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;
use tokio::time::{Instant, timeout, timeout_at};

/// Time that a dismissal waits for the run to end, so that its answer shows the job's final
/// state. A run stops after the current sub-step, well within this time.
const STOP_WAIT: Duration = Duration::from_millis(450);

/// Service that clients use to submit, follow, dismiss and remove jobs.
#[derive(Debug, Clone)]
pub struct JobService {
    pub(super) store: Arc<dyn JobStore>,
    pub(super) registry: Arc<RunningJobRegistry>,
    pub(super) limits: Limits,
    pub(super) in_flight: InFlight,
    pub(super) pool: AdmissionPool,
    means: Means,
    /// Reader of scenarios with their maps.
    pub(super) reader: ScenarioReader,
    followers: Followers,
    counts: Arc<Recent<Result<JobCounts, StoreError>>>,
    probed: Arc<Recent<Result<(), StoreError>>>,
    pub(super) running: Arc<Recent<Result<RunningProgress, StoreError>>>,
}

/// Reason why there is no plan.
#[derive(Debug, Error)]
pub enum PlanError {
    /// The scenario can't be read.
    #[error(transparent)]
    Scenario(#[from] ReadError),
    /// The first steps fail.
    #[error(transparent)]
    Forecast(#[from] ForecastError),
    /// The request is not admitted.
    #[error(transparent)]
    Admission(#[from] AdmissionError),
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
        (pool, means, reader): (AdmissionPool, Means, ScenarioReader),
        followers: Followers,
    ) -> Self {
        Self {
            followers,
            reader,
            store,
            registry,
            limits,
            in_flight: InFlight::default(),
            pool,
            means,
            counts: Arc::default(),
            probed: Arc::default(),
            running: Arc::default(),
        }
    }

    /// Takes a place in the admission pool for a request of this caller.
    ///
    /// # Errors
    /// The pool is full, or the caller has its share of it.
    pub fn enter(&self, caller: &str) -> Result<Admitted, AdmissionError> {
        self.pool.enter(caller)
    }

    /// Checks a scenario; work for the admission pool.
    ///
    /// # Errors
    /// All rules that the scenario breaks; or the store's own.
    pub fn validate(&self, scenario: &str, labels: Vec<String>) -> Result<NewJob, ReadError> {
        submit::validate(scenario, (&self.means, &self.reader), labels)
    }

    /// Reads a scenario with its maps; work for the admission pool.
    ///
    /// # Errors
    /// All rules that it breaks; or the store's own.
    pub fn read(&self, scenario: &str) -> Result<Scenario, ReadError> {
        self.reader.read(scenario)
    }

    /// Gives a stored scenario its maps; work for the admission pool.
    ///
    /// # Errors
    /// A map is not there any more; or the store's own.
    pub fn complete(&self, scenario: Scenario) -> Result<Scenario, ReadError> {
        self.reader.complete(scenario)
    }

    /// Plan of a job with this scenario, and a forecast of its wall time, for this caller.
    ///
    /// # Errors
    /// The scenario is invalid, its first steps fail, or the caller is not admitted.
    pub async fn plan(&self, caller: &str, scenario: String) -> Result<Planned, PlanError> {
        let place = self.enter(caller)?;
        let (means, reader) = (self.means, self.reader.clone());
        let AffordableJob { scene, plan, .. } = place
            .work(move |_| submit::read_affordable(&scenario, (&means, &reader)))
            .await??;
        let scenario = scene.scenario;
        let threads = scenario.numerics.threads;
        let threads = threads.unwrap_or(means.threads_per_worker);
        let planned = place
            .time(move |cancellation| forecast(&scenario, plan, threads, cancellation))
            .await?;
        Ok(planned?)
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
    pub async fn page(&self, page: &Page) -> Result<JobPage, StoreError> {
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

    /// Stops the run of a job that has been dismissed, if this service runs it.
    pub fn stop_running(&self, id: JobId) {
        // Nobody waits for its end.
        drop(self.registry.stop_job(id));
    }

    /// Tells the workers that there are new jobs.
    pub fn announce(&self) {
        self.registry.announce();
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
        let mut news = self.news();
        let goes_on = |status: Option<JobStatus>| status.is_some_and(|status| !status.is_final());
        while goes_on(self.status(id).await?) {
            // Until there is news of it; one who is behind looks at the job itself.
            loop {
                match timeout_at(end, news.recv()).await {
                    Err(_) | Ok(Ok(News::Closing) | Err(RecvError::Closed)) => return Ok(()),
                    Ok(Ok(News::Events(events))) if events.iter().all(|event| event.job != id) => {}
                    Ok(Ok(News::Events(_)) | Err(RecvError::Lagged(_))) => break,
                }
            }
        }
        Ok(())
    }

    /// News of jobs: of all events that are stored after this returns.
    pub fn news(&self) -> Receiver<News> {
        self.followers.join()
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

    /// Counts jobs, or has counted them just now.
    pub async fn count_jobs(&self) -> Arc<Result<JobCounts, StoreError>> {
        self.counts.get(self.store.count_jobs()).await
    }

    /// Checks with a real write that a job can be stored now, or has done so just now.
    pub async fn probe(&self) -> Arc<Result<(), StoreError>> {
        self.probed.get(self.store.probe()).await
    }

    /// Checks that the database answers.
    ///
    /// # Errors
    /// The database does not answer.
    pub async fn ping(&self) -> Result<(), StoreError> {
        self.store.ping().await
    }
}
