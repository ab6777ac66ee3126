//! Density of resting places as GeoTIFF (OGC 19-008r4), in local coordinates.

use scree_studies::answers::DensityGrid;
use std::io::Cursor;
use tiff::TiffResult;
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::Gray32Float;
use tiff::tags::Tag;

/// Size of a pixel.
const MODEL_PIXEL_SCALE: u16 = 33550;
/// A pixel, and the place of its upper left corner.
const MODEL_TIEPOINT: u16 = 33922;
/// Keys of the meaning of the coordinates.
const GEO_KEY_DIRECTORY: u16 = 34735;
/// Texts of the keys.
const GEO_ASCII_PARAMS: u16 = 34737;
/// Name of the coordinates.
const CITATION: &str = "channel: x downstream, y across [m]|";

/// A band of 32-bit floats: the density [1/m²], a pixel round each node, the first row farthest
/// across.
///
/// # Errors
/// The library's own.
pub fn density_as_geotiff(density: &DensityGrid) -> TiffResult<Vec<u8>> {
    let [columns, rows] = density.nodes;
    let [dx, dy] = density.spacing_m;
    let left = density.origin_m[0] - 0.5 * dx;
    let top = density.origin_m[1] + (rows as f64 - 0.5) * dy;
    let from_top = density.density_per_m2.chunks(columns).rev();
    let pixels: Vec<f32> = from_top.flatten().map(|value| *value as f32).collect();
    let mut file = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut file)?;
    let mut image = encoder.new_image::<Gray32Float>(columns as u32, rows as u32)?;
    let tags = image.encoder();
    tags.write_tag(Tag::Unknown(MODEL_PIXEL_SCALE), &[dx, dy, 0.0][..])?;
    let tie = [0.0, 0.0, 0.0, left, top, 0.0];
    tags.write_tag(Tag::Unknown(MODEL_TIEPOINT), &tie[..])?;
    tags.write_tag(Tag::Unknown(GEO_KEY_DIRECTORY), &keys()[..])?;
    tags.write_tag(Tag::Unknown(GEO_ASCII_PARAMS), CITATION)?;
    image.write_data(&pixels)?;
    Ok(file.into_inner())
}

/// Version 1.1.0 and three keys: coordinates of our own, a pixel is an area, and what they are
/// called.
fn keys() -> Vec<u16> {
    let head = [1, 1, 0, 3];
    let model_type = [1024, 0, 1, 32767];
    let raster_type = [1025, 0, 1, 1];
    let citation = [1026, GEO_ASCII_PARAMS, CITATION.len() as u16, 0];
    [head, model_type, raster_type, citation].concat()
}
