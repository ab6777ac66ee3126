//! Pictures of a job's answer, drawn from its records in the admission pool.

use super::JobService;
use super::admission_pool::AdmissionError;
use super::job::{Job, JobId};
use super::store::StoreError;
use crate::pictures::{self, PictureError};
use crate::results::FlowSnapshot;
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;
use thiserror::Error;

/// States of bodies that a picture is drawn from, of all bodies together: more than it can show.
const MOST_STATES: usize = 50_000;

/// Kind of picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Picture {
    /// Displacement and speed of the bodies over time.
    Motion,
    /// Flow and bodies from above, at some instants.
    Aerial,
}

/// Reason why there is no picture.
#[derive(Debug, Error)]
pub enum DrawError {
    /// The job has no outcome.
    #[error("the job has no outcome: a picture is drawn of a successful one")]
    NoOutcome,
    /// The pool is full, or the drawing took too long.
    #[error(transparent)]
    Admission(#[from] AdmissionError),
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored document is not what this version reads.
    #[error("a stored document: {0}")]
    Document(#[from] serde_json::Error),
    /// The drawing library fails.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

impl JobService {
    /// A picture of a job's answer as an SVG document, drawn for this caller.
    ///
    /// # Errors
    /// [`DrawError`].
    pub async fn draw(
        &self,
        caller: &str,
        job: &Job,
        picture: Picture,
    ) -> Result<String, DrawError> {
        let outcome: Outcome = read(job.outcome.as_deref().ok_or(DrawError::NoOutcome)?)?;
        let scenario: Scenario = read(&job.scenario)?;
        // Before the records are read, so that no more of them are in memory than requests.
        let place = self.enter(caller)?;
        let id = job.summary.id;
        let samples = self.samples(id, job.bodies, MOST_STATES).await?;
        let snapshots = match picture {
            Picture::Motion => Vec::new(),
            Picture::Aerial => self.all_snapshots(id).await?,
        };
        let drawn = place.work(move |_| match picture {
            Picture::Motion => pictures::motion(&scenario, &samples, &outcome),
            Picture::Aerial => pictures::aerial_view(&scenario, &samples, &snapshots),
        });
        Ok(drawn.await??)
    }

    async fn all_snapshots(&self, job: JobId) -> Result<Vec<FlowSnapshot>, StoreError> {
        let mut snapshots = Vec::new();
        for time_s in self.snapshot_times(job).await? {
            snapshots.extend(self.snapshot(job, Some(time_s)).await?);
        }
        Ok(snapshots)
    }
}

fn read<T: DeserializeOwned>(document: &RawValue) -> Result<T, serde_json::Error> {
    serde_json::from_str(document.get())
}
