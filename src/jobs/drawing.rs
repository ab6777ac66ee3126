//! Pictures of a job's answer, drawn from its records.

use super::JobService;
use super::job::{Job, JobId};
use super::store::StoreError;
use crate::pictures::{self, PictureError};
use crate::results::FlowSnapshot;
use scree_solver::record::{Outcome, Sample};
use scree_solver::scenario::Scenario;
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

/// Records of a job that a picture is drawn from.
#[derive(Debug)]
pub struct Drawing {
    picture: Picture,
    scenario: Box<RawValue>,
    outcome: Box<RawValue>,
    samples: Vec<Sample>,
    snapshots: Vec<FlowSnapshot>,
}

impl JobService {
    /// Reads what a picture of a job's answer is drawn from.
    ///
    /// # Errors
    /// The job has no outcome, or the store's own.
    pub async fn drawing(&self, job: Job, picture: Picture) -> Result<Drawing, DrawError> {
        let outcome = job.outcome.ok_or(DrawError::NoOutcome)?;
        let id = job.summary.id;
        let samples = self.samples(id, job.bodies, MOST_STATES).await?;
        let snapshots = match picture {
            Picture::Motion => Vec::new(),
            Picture::Aerial => self.shown_snapshots(id, &samples).await?,
        };
        Ok(Drawing {
            picture,
            scenario: job.scenario,
            outcome,
            samples,
            snapshots,
        })
    }

    /// The snapshots that the aerial view shows.
    async fn shown_snapshots(
        &self,
        job: JobId,
        samples: &[Sample],
    ) -> Result<Vec<FlowSnapshot>, StoreError> {
        let times_s = self.snapshot_times(job).await?;
        let mut snapshots = Vec::new();
        for shown in pictures::shown_instants(samples, &times_s) {
            snapshots.extend(self.snapshot(job, Some(times_s[shown])).await?);
        }
        Ok(snapshots)
    }
}

impl Drawing {
    /// The picture as an SVG document; work for the admission pool.
    ///
    /// # Errors
    /// A document can't be read, or the drawing library fails.
    pub fn draw(self) -> Result<String, DrawError> {
        let scenario: Scenario = serde_json::from_str(self.scenario.get())?;
        let outcome: Outcome = serde_json::from_str(self.outcome.get())?;
        Ok(match self.picture {
            Picture::Motion => pictures::motion(&scenario, &self.samples, &outcome)?,
            Picture::Aerial => pictures::aerial_view(&scenario, &self.samples, &self.snapshots)?,
        })
    }
}
