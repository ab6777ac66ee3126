//! Writing GeoTIFF.

use super::geo_keys;
use scree_solver::raster::Raster;
use std::io::Cursor;
use thiserror::Error;
use tiff::TiffError;
use tiff::encoder::colortype::Gray32Float;
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder};
use tiff::tags::Tag;

/// Unit code of the metre.
const METRE: u16 = 9001;
/// Name of coordinates whose system is not known.
const CITATION: &str = "unknown, in metres|";

/// A raster that can't be written as GeoTIFF.
#[derive(Debug, Error)]
pub enum WriteError {
    /// A code for which the format has no room.
    #[error("EPSG:{epsg} can't be written into a GeoTIFF; possible are 1024 to 32766")]
    Epsg {
        /// EPSG code.
        epsg: u32,
    },
    /// Whatever the library for TIFF reports.
    #[error("the raster can't be written as TIFF: {0}")]
    Tiff(#[from] TiffError),
}

/// GeoTIFF of a raster: 32-bit floats packed by DEFLATE, NaN as nodata.
///
/// # Errors
/// The code of the coordinate system is beyond the format, or the library refuses.
pub fn write_geotiff(raster: &Raster) -> Result<Vec<u8>, WriteError> {
    let keys = keys(raster.epsg)?;
    let [columns, rows] = [raster.columns as u32, raster.rows as u32];
    let from_the_north = raster.values.chunks_exact(raster.columns).rev().flatten();
    let pixels: Vec<f32> = from_the_north.map(|value| *value as f32).collect();
    let mut file = Cursor::new(Vec::new());
    let packing = Compression::Deflate(DeflateLevel::Balanced);
    let mut encoder = TiffEncoder::new(&mut file)?.with_compression(packing);
    let mut image = encoder.new_image::<Gray32Float>(columns, rows)?;
    let tags = image.encoder();
    let scale = [raster.cell_size, raster.cell_size, 0.0];
    tags.write_tag(Tag::ModelPixelScaleTag, &scale[..])?;
    let tie = [0.0, 0.0, 0.0, raster.west, raster.north(), 0.0];
    tags.write_tag(Tag::ModelTiepointTag, &tie[..])?;
    tags.write_tag(Tag::GeoKeyDirectoryTag, &keys[..])?;
    if raster.epsg.is_none() {
        tags.write_tag(Tag::GeoAsciiParamsTag, CITATION)?;
    }
    tags.write_tag(Tag::GdalNodata, "nan")?;
    image.write_data(&pixels)?;
    Ok(file.into_inner())
}

/// Version 1.1.0 and the keys: kind of the coordinates, a pixel is an area, which coordinates,
/// metres.
fn keys(epsg: Option<u32>) -> Result<Vec<u16>, WriteError> {
    let raster_type = [1025, 0, 1, 1];
    let unit = [3076, 0, 1, METRE];
    let Some(epsg) = epsg else {
        let model_type = [1024, 0, 1, 32767];
        let citation = [1026, 34737, CITATION.len() as u16, 0];
        return Ok([[1, 1, 0, 4], model_type, raster_type, citation, unit].concat());
    };
    let code = u16::try_from(epsg).ok();
    let code = code.filter(|code| geo_keys::EPSG.contains(code));
    let code = code.ok_or(WriteError::Epsg { epsg })?;
    let model_type = [1024, 0, 1, 1];
    let projected = [3072, 0, 1, code];
    Ok([[1, 1, 0, 4], model_type, raster_type, projected, unit].concat())
}
