//! Scenarios with the maps that they name.

use super::hash::TerrainHash;
use super::rasters::{LoadError, NamedRaster, Rasters};
use super::reading::FilePurpose;
use crate::jobs::store::{StoreError, TerrainStore};
use crate::jobs::submit::Violation;
use scree_solver::scenario::{MapUse, Maps, NamedMap, Scenario, ScenarioError};
use std::sync::Arc;
use thiserror::Error;
use tokio::runtime::Handle;

/// Error of a scenario that can't be read.
#[derive(Debug, Error)]
pub enum ReadError {
    /// It breaks rules.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The maps that it names can't be had now.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Reader of scenarios with maps from the store, for threads that may wait.
#[derive(Debug, Clone)]
pub struct ScenarioReader {
    rasters: Rasters,
    runtime: Handle,
}

/// Maps that a scenario names, as far as they are there, and what is wrong with the others.
#[derive(Debug, Default)]
struct Found {
    maps: Maps,
    violations: Vec<Violation>,
}

impl ScenarioReader {
    /// Reader with the maps of this store, which uses the current tokio runtime for them.
    pub fn new(store: Arc<dyn TerrainStore>) -> Self {
        Self {
            rasters: Rasters::new(store),
            runtime: Handle::current(),
        }
    }

    /// Reads a scenario. Blocks.
    ///
    /// # Errors
    /// The text is no scenario, or breaks rules; or the store's own.
    pub fn read(&self, text: &str) -> Result<Scenario, ReadError> {
        let found = self.find(&Scenario::maps_named(text)?)?;
        let read = Scenario::from_json_with(text, &found.maps);
        let scenario = read.map_err(|error| with_reasons(error, &found.violations))?;
        // A file may suit one of its uses and not another.
        if found.violations.is_empty() {
            Ok(scenario)
        } else {
            Err(ScenarioError::Invalid(found.violations).into())
        }
    }

    /// Gives a stored scenario its maps. Blocks.
    ///
    /// # Errors
    /// A map is not there any more; or the store's own.
    pub fn complete(&self, scenario: Scenario) -> Result<Scenario, ReadError> {
        if scenario.terrain().is_none() {
            return Ok(scenario);
        }
        let found = self.find(&Scenario::maps_named(&scenario.to_json())?)?;
        if found.violations.is_empty() {
            Ok(scenario.with_maps(&found.maps))
        } else {
            Err(ScenarioError::Invalid(found.violations).into())
        }
    }

    fn find(&self, named: &[NamedMap]) -> Result<Found, StoreError> {
        let mut found = Found::default();
        for map in named {
            let asked = NamedRaster {
                pointer: map.pointer.clone(),
                name: map.name.clone(),
                purpose: purpose(map.of),
            };
            match self.runtime.block_on(self.rasters.load(&[asked])) {
                Ok(rasters) => rasters
                    .into_iter()
                    .for_each(|raster| found.maps.insert(&map.name, raster)),
                Err(LoadError::Invalid(violations)) => found.violations.extend(violations),
                Err(LoadError::Store(error)) => return Err(error),
            }
        }
        Ok(found)
    }
}

/// The terrains that a scenario's text names; what is no name of one is left out.
pub fn terrains_of(text: &str) -> Vec<TerrainHash> {
    let named = Scenario::maps_named(text).unwrap_or_default();
    let mut terrains: Vec<TerrainHash> = named
        .iter()
        .filter_map(|map| map.name.parse().ok())
        .collect();
    terrains.sort_unstable();
    terrains.dedup();
    terrains
}

/// Purpose of a map with this use.
pub fn purpose(of: MapUse) -> FilePurpose {
    match of {
        MapUse::Height => FilePurpose::HeightMap,
        MapUse::Surface => FilePurpose::Surface,
        MapUse::Thickness => FilePurpose::Thickness,
        MapUse::Friction => FilePurpose::Friction,
    }
}

/// The faults of a scenario, with the reasons why maps are not there.
fn with_reasons(error: ScenarioError, reasons: &[Violation]) -> ScenarioError {
    let ScenarioError::Invalid(mut violations) = error else {
        return error;
    };
    for violation in &mut violations {
        let reason = reasons
            .iter()
            .find(|reason| reason.pointer == violation.pointer);
        if let Some(reason) = reason {
            *violation = reason.clone();
        }
    }
    ScenarioError::Invalid(violations)
}
