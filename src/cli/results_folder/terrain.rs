//! Files of a run on a terrain for geographic programs: maps of the flow, and tracks and outlines.

use super::Delivery;
use crate::cli::failure::Failure;
use scree::results::terrain::{
    Coordinates, FlowOutlines, MapError, MapQuantity, NoCoordinates, StoredMap, TerrainRun,
};
use scree_solver::record::{FlowMaps, Outcome, Sample};
use scree_solver::scenario::Scenario;

/// Tracks and outlines in longitude and latitude.
const TRACKS: &str = "tracks.geojson";

/// The same in the coordinates of the height map.
const TRACKS_ON_MAP: &str = "tracks-map.geojson";

/// True if it is the name of a file of a run on a terrain.
pub(super) fn is_of_terrain(name: &str) -> bool {
    files().iter().any(|(file, _)| file == name)
}

/// Names of the files, and paths below a job under which a service has the same.
pub(in crate::cli) fn files() -> Vec<(String, String)> {
    let maps = MapQuantity::ALL.into_iter().flat_map(|quantity| {
        ["asc", "tif"].map(|ending| {
            let name = format!("{}.{ending}", quantity.name());
            let path = format!("maps/{name}");
            (name, path)
        })
    });
    let tracks = [(TRACKS_ON_MAP, "map"), (TRACKS, "wgs84")].map(|(name, coordinates)| {
        let path = format!("tracks.geojson?coordinates={coordinates}");
        (name.to_owned(), path)
    });
    maps.chain(tracks).collect()
}

impl Delivery<'_> {
    /// Writes the maps of the flow, and tracks and outlines; nothing in a channel. Places without
    /// longitude and latitude are only in the file of the map's own coordinates.
    ///
    /// # Errors
    /// A file can't be written.
    pub(in crate::cli) fn terrain(
        &mut self,
        scenario: &Scenario,
        samples: &[Sample],
        outcome: &Outcome,
        maps: Option<&FlowMaps>,
    ) -> Result<(), Failure> {
        let Some(terrain) = scenario.terrain() else {
            return Ok(());
        };
        for stored in maps.map(StoredMap::all).transpose()?.unwrap_or_default() {
            let name = stored.quantity.name();
            self.write(&format!("{name}.asc"), stored.clone().ascii()?.as_bytes())?;
            self.write(&format!("{name}.tif"), &stored.geotiff()?)?;
        }
        let outlines = maps.map(FlowOutlines::of);
        let run = TerrainRun {
            scenario,
            samples,
            outcome,
            flow: outlines.as_ref(),
        };
        let epsg = terrain.height().epsg;
        let on_map = run.features(&Coordinates::Map(epsg))?;
        let on_globe = Coordinates::wgs_84(epsg).and_then(|globe| run.features(&globe));
        let files = [(TRACKS_ON_MAP, on_map), (TRACKS, on_globe.ok().flatten())];
        for (name, features) in files {
            if let Some(features) = features {
                self.write(name, features.to_string().as_bytes())?;
            }
        }
        Ok(())
    }
}

impl From<MapError> for Failure {
    fn from(error: MapError) -> Self {
        Self::Other(error.to_string())
    }
}

impl From<NoCoordinates> for Failure {
    fn from(error: NoCoordinates) -> Self {
        Self::Other(error.to_string())
    }
}
