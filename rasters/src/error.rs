//! Errors of files.

use crate::ascii::AsciiError;
use crate::geotiff::GeoTiffError;
use crate::limits::SizeError;
use crate::values::ValueError;
use thiserror::Error;

/// A file that is no raster for its purpose.
#[derive(Debug, Error)]
pub enum RasterError {
    /// No bytes at all.
    #[error("the file is empty")]
    Empty,
    /// Neither of the two formats.
    #[error(
        "the file begins with \"{start}\", which is neither a TIFF nor an ESRI ASCII grid \
         (whose first word is a key such as ncols)"
    )]
    UnknownFormat {
        /// Its first bytes, those beyond ASCII as escapes.
        start: String,
    },
    /// An ESRI ASCII grid that can't be read.
    #[error(transparent)]
    Ascii(#[from] AsciiError),
    /// A GeoTIFF that can't be read.
    #[error(transparent)]
    GeoTiff(#[from] GeoTiffError),
    /// A number, size or place of the cells.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// Values that the purpose doesn't allow.
    #[error(transparent)]
    Value(#[from] ValueError),
}
