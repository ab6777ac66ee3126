//! Content of a file, whatever its format.

use scree_solver::raster::Raster;

/// A raster as its file has it, holes still as the number that stands for them.
#[derive(Debug)]
pub(crate) struct RasterFile {
    /// Raster with the file's numbers.
    pub(crate) raster: Raster,
    /// Number that stands for a hole, besides NaN.
    pub(crate) nodata: Option<f64>,
}

impl RasterFile {
    /// True of a value that stands for a hole.
    pub(crate) fn is_hole(&self, value: f64) -> bool {
        value.is_nan() || self.nodata == Some(value)
    }
}
