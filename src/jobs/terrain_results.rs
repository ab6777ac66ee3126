//! Results of a job on a terrain: maps of its flow, tracks and outlines.

use super::JobService;
use super::job::{Job, JobId};
use super::store::StoreError;
use crate::pictures::MapsSeen;
use crate::results::terrain::{
    Coordinates, FlowOutlines, MapError, MapQuantity, NoCoordinates, StoredMap, TerrainRun,
};
use crate::terrains::ReadError;
use scree_solver::record::{Outcome, Sample};
use scree_solver::scenario::{Scenario, ScenarioError};
use thiserror::Error;

/// States of bodies in tracks, of all bodies together.
const MOST_STATES: usize = 50_000;

/// Reason why there are no results on a terrain.
#[derive(Debug, Error)]
pub enum TerrainResultsError {
    /// The job's flow and bodies are in a channel.
    #[error("the job has no terrain: it is in a channel")]
    NoTerrain,
    /// The job has no outcome.
    #[error("the job has no outcome: only a successful one has tracks and outlines")]
    NoOutcome,
    /// Places have no such coordinates.
    #[error(transparent)]
    Coordinates(#[from] NoCoordinates),
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A stored scenario can't be read any more.
    #[error("a stored scenario: {0}")]
    Scenario(ScenarioError),
    /// A map of the flow that can't be read.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A stored document is not what this version reads.
    #[error("a stored document: {0}")]
    Document(#[from] serde_json::Error),
}

impl From<ReadError> for TerrainResultsError {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Scenario(error) => Self::Scenario(error),
            ReadError::Store(error) => Self::Store(error),
        }
    }
}

/// Coordinates that a client may ask for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AskedCoordinates {
    /// Longitude and latitude.
    Wgs84,
    /// Those of the height map.
    Map,
}

/// Records of a job that its tracks and outlines are made of.
#[derive(Debug)]
pub struct Tracks {
    scenario: Scenario,
    outcome: Outcome,
    samples: Vec<Sample>,
    /// Arrival time and deposit.
    flow: Option<[StoredMap; 2]>,
}

impl JobService {
    /// The quantities of which a job has maps of its flow.
    ///
    /// # Errors
    /// The job is in a channel, or the store's own.
    pub async fn flow_maps(&self, job: &Job) -> Result<Vec<MapQuantity>, TerrainResultsError> {
        on_terrain(job)?;
        Ok(self.store.flow_maps(job.summary.id).await?)
    }

    /// The map of a quantity, if the job has it.
    ///
    /// # Errors
    /// The job is in a channel, or the store's own.
    pub async fn flow_map(
        &self,
        job: &Job,
        quantity: MapQuantity,
    ) -> Result<Option<StoredMap>, TerrainResultsError> {
        on_terrain(job)?;
        Ok(self.store.flow_map(job.summary.id, quantity).await?)
    }

    /// Reads what tracks and outlines of a job are made of.
    ///
    /// # Errors
    /// The job is in a channel or has no outcome, or the store's own.
    pub async fn tracks(&self, job: Job) -> Result<Tracks, TerrainResultsError> {
        let scenario = on_terrain(&job)?;
        let outcome = job.outcome.ok_or(TerrainResultsError::NoOutcome)?;
        let id = job.summary.id;
        let arrival_time = self.store.flow_map(id, MapQuantity::ArrivalTime).await?;
        let deposit = self.store.flow_map(id, MapQuantity::Deposit).await?;
        Ok(Tracks {
            scenario,
            outcome: serde_json::from_str(outcome.get())?,
            samples: self.samples(id, job.bodies, MOST_STATES).await?,
            flow: arrival_time.zip(deposit).map(<[StoredMap; 2]>::from),
        })
    }

    /// The maps of a job's flow that a picture shows, if it has them.
    pub(super) async fn maps_seen(&self, job: JobId) -> Result<Option<[StoredMap; 3]>, StoreError> {
        let mut found = Vec::new();
        for quantity in [
            MapQuantity::FlowHeightMax,
            MapQuantity::ArrivalTime,
            MapQuantity::Deposit,
        ] {
            found.extend(self.store.flow_map(job, quantity).await?);
        }
        Ok(found.try_into().ok())
    }
}

/// The rasters of the maps that a picture shows.
pub(super) fn seen(maps: [StoredMap; 3]) -> Result<MapsSeen, MapError> {
    let [height, arrival, deposit] = maps;
    Ok(MapsSeen {
        flow_height_max: height.raster()?,
        outlines: outlines([arrival, deposit])?,
    })
}

fn outlines([arrival_time, deposit]: [StoredMap; 2]) -> Result<FlowOutlines, MapError> {
    Ok(FlowOutlines {
        arrival_time: arrival_time.raster()?,
        deposit: deposit.raster()?,
    })
}

/// The scenario of a job on a terrain, without its maps.
fn on_terrain(job: &Job) -> Result<Scenario, TerrainResultsError> {
    let scenario: Scenario = serde_json::from_str(job.scenario.get())?;
    match scenario.terrain() {
        Some(_) => Ok(scenario),
        None => Err(TerrainResultsError::NoTerrain),
    }
}

impl Tracks {
    /// Tracks and outlines as GeoJSON; work for the admission pool.
    ///
    /// # Errors
    /// Places have no such coordinates, or a stored map can't be read.
    pub fn geojson(
        self,
        jobs: &JobService,
        asked: AskedCoordinates,
    ) -> Result<String, TerrainResultsError> {
        let scenario = jobs.complete(self.scenario)?;
        let terrain = scenario.terrain();
        let terrain = terrain.ok_or(TerrainResultsError::NoTerrain)?;
        let epsg = terrain.height().epsg;
        let coordinates = match asked {
            AskedCoordinates::Wgs84 => Coordinates::wgs_84(epsg)?,
            AskedCoordinates::Map => Coordinates::Map(epsg),
        };
        let outlines = self.flow.map(outlines).transpose()?;
        let run = TerrainRun {
            scenario: &scenario,
            samples: &self.samples,
            outcome: &self.outcome,
            flow: outlines.as_ref(),
        };
        let features = run.features(&coordinates)?;
        let features = features.ok_or(TerrainResultsError::NoTerrain)?;
        Ok(features.to_string())
    }
}
