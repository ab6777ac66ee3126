//! Admission of jobs: no request is admitted twice, and none beyond the capacity of the queue.

use super::JobService;
use super::admission_pool::AdmissionError;
use super::job::JobId;
use super::pool::GRACE;
use super::store::{self, FormerRequest, KeptAnswer, Key, Room, StoreError, Submitted};
use super::submit::{NewJob, ScenarioError};
use crate::terrains::{ReadError, TerrainHash};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};
use thiserror::Error;

/// Contents of one request.
#[derive(Debug, Clone)]
pub struct SubmissionRequest {
    /// Its jobs.
    pub jobs: Vec<NewJob>,
    /// Name of the access token of the request.
    pub submitter: Option<String>,
    /// Largest number of jobs of this submitter that may wait or run.
    pub quota: Option<u32>,
    /// Its Idempotency-Key.
    pub key: Option<Key>,
}

/// Result of a request: its jobs, and the answer it got if it came before.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Submission {
    /// Its jobs, in its order.
    pub jobs: Vec<JobId>,
    /// The answer kept of the first request with its key.
    pub answer: Option<KeptAnswer>,
}

/// Reason why jobs are refused.
#[derive(Debug, Error)]
pub enum SubmitError {
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The request is not admitted.
    #[error(transparent)]
    Admission(#[from] AdmissionError),
    /// The jobs can't be stored, or their maps can't be had.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The service stops, and has no time left for it.
    #[error("the service stops, and has no time left to store it")]
    Closing,
    /// A request with this key is in progress.
    #[error("a request with this Idempotency-Key is being answered")]
    InFlight,
    /// The key was used before with another request.
    #[error("this Idempotency-Key came before with another request")]
    OtherRequest,
    /// A job names a terrain that does not exist, or not any more.
    #[error("this service has no terrain {0}: upload its file first")]
    NoTerrain(TerrainHash),
    /// Too many jobs wait.
    #[error("{waiting} jobs wait, and the queue of this service takes {limit}")]
    QueueFull {
        /// Number of waiting jobs.
        waiting: u32,
        /// Largest number allowed.
        limit: u32,
    },
    /// Too many jobs of this submitter wait or run.
    #[error("{active} jobs of this token wait or run, and it may have {limit}")]
    QuotaSpent {
        /// Number of jobs of the submitter that wait or run.
        active: u32,
        /// Largest number allowed.
        limit: u32,
    },
}

impl From<ReadError> for SubmitError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Scenario(error) => Self::Scenario(error),
            ReadError::Store(error) => Self::Store(error),
        }
    }
}

/// Keys of requests in progress.
#[derive(Debug, Clone, Default)]
pub(super) struct InFlight(Arc<Mutex<BTreeSet<(String, String)>>>);

/// A key that is reserved until this is dropped.
struct Taken {
    keys: InFlight,
    key: (String, String),
}

impl InFlight {
    fn take(&self, submitter: &str, key: &str) -> Option<Taken> {
        let key = (submitter.to_owned(), key.to_owned());
        let is_new = self.set().insert(key.clone());
        is_new.then(|| Taken {
            keys: self.clone(),
            key,
        })
    }

    fn set(&self) -> std::sync::MutexGuard<'_, BTreeSet<(String, String)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Taken {
    fn drop(&mut self) {
        self.keys.set().remove(&self.key);
    }
}

impl Submission {
    fn of_former(former: FormerRequest) -> Result<Self, SubmitError> {
        match former {
            FormerRequest::Other => Err(SubmitError::OtherRequest),
            FormerRequest::Same { jobs, answer } => Ok(Self { jobs, answer }),
        }
    }
}

impl JobService {
    /// Puts the jobs of a request into the queue, all or none; they are on disk when this
    /// returns. Once begun it is carried through, also if its client leaves.
    ///
    /// # Errors
    /// The queue is full, the key is in use or was another request's, or the jobs can't be stored.
    pub async fn submit(&self, request: SubmissionRequest) -> Result<Submission, SubmitError> {
        let service = self.clone();
        let carried_through = tokio::spawn(async move { service.store_request(&request).await });
        carried_through
            .await
            .map_err(|error| StoreError::Defect(error.into()))?
    }

    async fn store_request(&self, request: &SubmissionRequest) -> Result<Submission, SubmitError> {
        let submitter = request.submitter.as_deref();
        let key = request.key.as_ref();
        let _taken = key
            .map(|key| {
                let taken = self
                    .in_flight
                    .take(submitter.unwrap_or_default(), &key.text);
                taken.ok_or(SubmitError::InFlight)
            })
            .transpose()?;
        let room = Room {
            queue: self.limits.queued_jobs,
            submitter: request.quota,
        };
        // What is begun now is carried through, and would delay the stop.
        if self.registry.closing_for() > self.limits.drain_timeout().mul_f64(GRACE) {
            return Err(SubmitError::Closing);
        }
        let submission = store::Submission {
            jobs: &request.jobs,
            submitter,
            key,
            room,
        };
        match self.store.submit(&submission).await? {
            Submitted::Accepted => {
                self.registry.announce();
                Ok(Submission {
                    jobs: request.jobs.iter().map(|job| job.id).collect(),
                    answer: None,
                })
            }
            Submitted::Before(former) => Submission::of_former(former),
            Submitted::NoTerrain(terrain) => Err(SubmitError::NoTerrain(terrain)),
            Submitted::QueueFull(waiting) => Err(SubmitError::QueueFull {
                waiting,
                limit: room.queue,
            }),
            Submitted::QuotaSpent(active) => Err(SubmitError::QuotaSpent {
                active,
                limit: room.submitter.unwrap_or_default(),
            }),
        }
    }

    /// The first request with this key, if there was one.
    ///
    /// # Errors
    /// It was another request, or the store's own.
    pub async fn former_request(
        &self,
        submitter: Option<&str>,
        key: &Key,
    ) -> Result<Option<Submission>, SubmitError> {
        let former = self.store.former_request(submitter, key).await?;
        former.map(Submission::of_former).transpose()
    }

    /// Keeps the answer to a request with a key for its repetitions, and returns the one to be
    /// sent: that of a repetition may have been kept sooner.
    pub async fn keep_answer(
        &self,
        submitter: Option<&str>,
        key: &Key,
        answer: KeptAnswer,
    ) -> KeptAnswer {
        match self.store.keep_answer(submitter, key, &answer).await {
            Ok(former) => former.unwrap_or(answer),
            Err(error) => {
                // The jobs are stored: a refusal would be wrong. A repetition makes its answer anew.
                tracing::warn!(%error, key = key.text, "an answer can't be kept");
                answer
            }
        }
    }

    /// A successful job with the same scenario, run by this same program.
    ///
    /// # Errors
    /// The store's own.
    pub async fn finished_like(&self, job: &NewJob) -> Result<Option<JobId>, StoreError> {
        let solver = (job.solver_version, crate::runs::COMMIT);
        self.store.finished_like(&job.scenario_hash, solver).await
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_taken_until_its_request_is_answered() {
        let keys = InFlight::default();
        let taken = keys.take("a", "1").expect("it is free");
        assert!(keys.take("a", "1").is_none());
        assert!(
            keys.take("b", "1").is_some(),
            "another's key is another key"
        );
        drop(taken);
        assert!(keys.take("a", "1").is_some());
    }
}
