//! Terrains: rasters that clients upload once and scenarios name by the hash of their files. They
//! are stored as uploaded ([`TerrainService`]) and read when they are used ([`Rasters`]).

mod description;
mod file;
mod hash;
mod rasters;
mod reading;
mod scenario;
mod service;

pub use description::{Description, FileFormat};
pub use file::TerrainFile;
pub use hash::{NoTerrainHash, TerrainHash};
pub use rasters::{LoadError, NamedRaster, Rasters};
pub use reading::{FilePurpose, violation};
pub use scenario::{ReadError, ScenarioReader, purpose, terrains_of};
pub use service::{PutError, Terrain, TerrainService};
