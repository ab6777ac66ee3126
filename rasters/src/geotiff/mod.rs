//! GeoTIFF with one band of numbers, as GDAL writes it.

mod blocks;
mod cells;
mod error;
mod geo_keys;
mod metadata;
mod placement;
mod write;

pub use error::GeoTiffError;
pub use write::{WriteError, write_geotiff};

use crate::error::RasterError;
use crate::file::RasterFile;
use crate::limits;
use cells::CellType;
use geo_keys::GeoKeys;
use metadata::Metadata;
use placement::Placement;
use scree_solver::raster::Raster;
use std::io::Cursor;
use tiff::decoder::ifd::Value;
use tiff::decoder::{Decoder, Limits};
use tiff::tags::Tag;

type Tiff<'a> = Decoder<Cursor<&'a [u8]>>;

/// The first image; it has the full resolution, and overviews follow it.
pub(crate) fn read(bytes: &[u8], most_cells: u64) -> Result<RasterFile, RasterError> {
    let file = decode(bytes, most_cells);
    file.map_err(|error| match error {
        RasterError::GeoTiff(error) => error.of_file(bytes.len()).into(),
        other => other,
    })
}

fn decode(bytes: &[u8], most_cells: u64) -> Result<RasterFile, RasterError> {
    let mut tiff = Decoder::new(Cursor::new(bytes)).map_err(GeoTiffError::from)?;
    let (columns, rows) = tiff.dimensions().map_err(GeoTiffError::from)?;
    let [columns, rows] = limits::shape([columns.into(), rows.into()], most_cells)?;
    let cell_type = CellType::of(&mut tiff)?;
    cells::require_known_compression(&mut tiff)?;
    blocks::check(&mut tiff, [columns, rows], bytes.len())?;
    let keys = GeoKeys::of(&mut tiff)?;
    let placement = Placement::of(&mut tiff, keys.is_point())?;
    let epsg = keys.epsg()?;
    let [width, height] = placement.cell();
    let cell_size = limits::cell_size(width, height)?;
    let [west, north] = placement.north_west();
    let [west, south] = limits::place(west, north - rows as f64 * height)?;
    let metadata = Metadata::of(&mut tiff)?;
    let nodata = cell_type.nodata(&mut tiff)?;
    let mut tiff = tiff.with_limits(room_for(columns * rows));
    let values = cells::values(&mut tiff, columns)?;
    blocks::refuse_mask(&mut tiff)?;
    let values = values.into_iter().map(|raw| metadata.value(raw));
    let raster = Raster {
        columns,
        rows,
        cell_size,
        west,
        south,
        epsg,
        values: values.collect(),
    };
    let nodata = nodata.map(|raw| metadata.value(raw));
    Ok(RasterFile { raster, nodata })
}

/// Limits with room for an image whose size has been checked. Until then the library's own hold,
/// since the tags of a file may claim any length.
fn room_for(cells: usize) -> Limits {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = cells * size_of::<f64>();
    limits.intermediate_buffer_size = usize::MAX;
    limits
}

/// Numbers of a tag.
fn doubles(tiff: &mut Tiff<'_>, tag: Tag) -> Result<Option<Vec<f64>>, GeoTiffError> {
    let value = tiff.find_tag(tag)?;
    Ok(value.map(Value::into_f64_vec).transpose()?)
}

/// Text of a tag, without what fills it up.
fn text(tiff: &mut Tiff<'_>, tag: Tag) -> Result<Option<String>, GeoTiffError> {
    let value = tiff.find_tag(tag)?;
    let text = value.map(Value::into_string).transpose()?;
    Ok(text.map(|text| text.trim_matches(['\0', ' ']).to_owned()))
}
