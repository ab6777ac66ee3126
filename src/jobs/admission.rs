//! Admission of jobs: no request is admitted twice, and none beyond the capacity of the queue.

use super::JobService;
use super::job::JobId;
use super::store::{Key, Room, StoreError, Submission, Submitted};
use super::submit::{NewJob, ScenarioError};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};
use thiserror::Error;

/// Contents of one request.
#[derive(Debug, Clone, Copy)]
pub struct SubmissionRequest<'a> {
    /// Its jobs.
    pub jobs: &'a [NewJob],
    /// Name of the access token of the request.
    pub submitter: Option<&'a str>,
    /// Largest number of jobs of this submitter that may wait or run.
    pub quota: Option<u32>,
    /// Its Idempotency-Key.
    pub key: Option<Key<'a>>,
}

/// Reason why jobs are refused.
#[derive(Debug, Error)]
pub enum SubmitError {
    /// The scenario is invalid.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The jobs can't be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A request with this key is in progress.
    #[error("a request with this Idempotency-Key is being answered")]
    InFlight,
    /// The key was used before with another body.
    #[error("this Idempotency-Key came before with another request")]
    OtherBody,
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

impl JobService {
    /// Puts the jobs of a request into the queue, all or none; they are on disk
    /// when this returns. A repeated request gets the jobs of the first one.
    ///
    /// # Errors
    /// The queue is full, the key is invalid, or the jobs can't be stored.
    pub async fn submit(
        &self,
        admission: &SubmissionRequest<'_>,
    ) -> Result<Vec<JobId>, SubmitError> {
        let taken = match &admission.key {
            None => None,
            Some(key) => {
                let submitter = admission.submitter.unwrap_or_default();
                let taken = self.in_flight.take(submitter, key.text);
                Some(taken.ok_or(SubmitError::InFlight)?)
            }
        };
        let room = Room {
            queue: self.limits.queued_jobs,
            submitter: admission.quota,
        };
        let submission = Submission {
            jobs: admission.jobs,
            submitter: admission.submitter,
            key: admission.key,
            room,
        };
        let submitted = self.store.submit(&submission).await;
        drop(taken);
        match submitted? {
            Submitted::Accepted => {
                self.registry.announce();
                Ok(admission.jobs.iter().map(|job| job.id).collect())
            }
            Submitted::Before(jobs) => Ok(jobs),
            Submitted::OtherBody => Err(SubmitError::OtherBody),
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
