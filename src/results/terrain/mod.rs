//! Results of a run on a terrain as geographic programs read them: maps as GeoTIFF and ESRI ASCII
//! grid, tracks and outlines as GeoJSON.

mod coordinates;
mod features;
mod outline;
mod stored_map;

pub use coordinates::{Coordinates, NoCoordinates};
pub(crate) use features::released_areas;
pub use features::{FlowOutlines, TerrainRun};
pub use outline::polygons;
pub use scree_solver::record::MapQuantity;
pub use stored_map::{MapError, StoredMap};
