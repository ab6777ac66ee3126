//! Terrains: rasters that clients upload once and scenarios name by their hash.

mod hash;

pub use hash::{NoTerrainHash, TerrainHash};
