//! State of the router: the services that requests use.

use crate::jobs::JobService;
use crate::studies::StudyService;
use crate::terrains::TerrainService;
use axum::extract::FromRef;

/// Services that requests use.
#[derive(Debug, Clone)]
pub struct Services {
    /// Jobs.
    pub jobs: JobService,
    /// Studies.
    pub studies: StudyService,
    /// Terrains.
    pub terrains: TerrainService,
}

impl FromRef<Services> for JobService {
    fn from_ref(services: &Services) -> Self {
        services.jobs.clone()
    }
}

impl FromRef<Services> for StudyService {
    fn from_ref(services: &Services) -> Self {
        services.studies.clone()
    }
}

impl FromRef<Services> for TerrainService {
    fn from_ref(services: &Services) -> Self {
        services.terrains.clone()
    }
}
