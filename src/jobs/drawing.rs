//! Pictures of a job's answer, drawn from its records.

use super::JobService;
use super::job::{Job, JobId};
use super::store::StoreError;
use super::terrain_results::seen;
use crate::pictures::{self, PictureError};
use crate::results::FlowSnapshot;
use crate::results::terrain::{MapError, StoredMap};
use crate::terrains::ReadError;
use scree_solver::record::{Outcome, Sample};
use scree_solver::scenario::{Scenario, ScenarioError};
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
    /// A stored scenario can't be read any more.
    #[error("a stored scenario: {0}")]
    Scenario(ScenarioError),
    /// A map of the flow that can't be read.
    #[error(transparent)]
    Map(#[from] MapError),
}

impl From<ReadError> for DrawError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Scenario(error) => Self::Scenario(error),
            ReadError::Store(error) => Self::Store(error),
        }
    }
}

/// Records of a job that a picture is drawn from.
#[derive(Debug)]
pub struct Drawing {
    scenario: Scenario,
    outcome: Box<RawValue>,
    samples: Vec<Sample>,
    flow: DrawnFlow,
}

/// What a picture shows of the flow, by the ground.
#[derive(Debug)]
enum DrawnFlow {
    /// Nothing.
    Hidden,
    /// Snapshots in a channel.
    InChannel(Vec<FlowSnapshot>),
    /// What it did to a terrain, of which these are the maps.
    OnTerrain(Option<[StoredMap; 3]>),
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
        let scenario: Scenario = serde_json::from_str(job.scenario.get())?;
        let flow = match (picture, scenario.terrain()) {
            (Picture::Motion, _) => DrawnFlow::Hidden,
            (Picture::Aerial, None) => {
                DrawnFlow::InChannel(self.shown_snapshots(id, &samples).await?)
            }
            (Picture::Aerial, Some(_)) => DrawnFlow::OnTerrain(self.maps_seen(id).await?),
        };
        Ok(Drawing {
            scenario,
            outcome,
            samples,
            flow,
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
    pub fn draw(self, jobs: &JobService) -> Result<String, DrawError> {
        let Self {
            scenario,
            outcome,
            samples,
            flow,
        } = self;
        Ok(match flow {
            DrawnFlow::Hidden => {
                let outcome: Outcome = serde_json::from_str(outcome.get())?;
                pictures::motion(&scenario, &samples, &outcome)?
            }
            DrawnFlow::InChannel(snapshots) => {
                pictures::aerial_view(&scenario, &samples, &snapshots)?
            }
            DrawnFlow::OnTerrain(flow) => {
                let scenario = jobs.complete(scenario)?;
                let flow = flow.map(seen).transpose()?;
                pictures::terrain_view(&scenario, &samples, flow.as_ref())?
            }
        })
    }
}
