//! Rasters as files: what is read, refused and written.

mod altered;
mod files;
mod image;
mod malformed_ascii;
mod malformed_geotiff;
mod malformed_values;
mod projection;
mod round_trips;

use scree_rasters::{Purpose, read};
use std::path::Path;

/// Bytes of a file made by GDAL.
fn file(name: &str) -> Vec<u8> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    std::fs::read(folder.join(name)).expect("the file is there")
}

/// Message with which a height map is refused.
fn refusal(bytes: &[u8]) -> String {
    match read(bytes, Purpose::HeightMap) {
        Ok(raster) => panic!("was read as {} × {} cells", raster.columns, raster.rows),
        Err(error) => error.to_string(),
    }
}
