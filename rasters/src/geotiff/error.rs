//! Errors of GeoTIFF files.

use std::io::ErrorKind;
use thiserror::Error;
use tiff::TiffError;

/// A GeoTIFF that can't be read.
#[derive(Debug, Error)]
pub enum GeoTiffError {
    /// A file that was cut off.
    #[error("the TIFF of {bytes} bytes ends before its raster does; was it cut off?")]
    Truncated {
        /// Length of the file.
        bytes: usize,
    },
    /// Whatever the library for TIFF reports.
    #[error("the TIFF can't be decoded: {0}")]
    Tiff(#[from] TiffError),
    /// Several bands, such as the colours of a picture.
    #[error("the TIFF has {bands} bands; a raster of numbers has 1")]
    Bands {
        /// Number of bands.
        bands: u16,
    },
    /// Colours instead of numbers.
    #[error(
        "the TIFF has photometric interpretation {code}, that of a picture; a raster of numbers \
         has 1"
    )]
    Picture {
        /// Code of the interpretation.
        code: u16,
    },
    /// Numbers of a type that is not read.
    #[error(
        "the cells have {kind} of {bits} bits; integers of 8, 16 and 32 bits and floating-point \
         numbers of 32 and 64 bits are read"
    )]
    CellType {
        /// Bits of a number.
        bits: u16,
        /// Kind of the numbers.
        kind: &'static str,
    },
    /// A compression that is not read.
    #[error(
        "the TIFF has compression {code}{name}; LZW, DEFLATE, ZSTD, PackBits and none are read"
    )]
    Compression {
        /// Code of the compression.
        code: u16,
        /// Name of it with the space before it, or nothing.
        name: &'static str,
    },
    /// Strips or tiles left out.
    #[error("block {block} of the TIFF is left out; write the file with SPARSE_OK=FALSE")]
    Sparse {
        /// Number of the first such block, counted from 0.
        block: usize,
    },
    /// Far more values than a file of its size should have.
    #[error(
        "the TIFF of {bytes} bytes unpacks to {values} bytes; at most 10000 for each of its bytes \
         (or 64 MiB) are read, so write the file with less compression"
    )]
    Bomb {
        /// Bytes of the values.
        values: u64,
        /// Length of the file.
        bytes: usize,
    },
    /// Differences instead of values, in a file without compression.
    #[error(
        "the TIFF has the predictor {code} but no compression; write it with compression, or with \
         the predictor 1"
    )]
    Predictor {
        /// Code of the predictor.
        code: u16,
    },
    /// Holes marked by another image.
    #[error("the TIFF marks holes by a mask; write them as a nodata value")]
    Mask,
    /// A chain of images without sense.
    #[error("the TIFF has more than {most} images")]
    TooManyImages {
        /// Greatest number.
        most: usize,
    },
    /// A nodata value that is no number.
    #[error("GDAL_NODATA is \"{text}\", which is no number")]
    Nodata {
        /// Its text.
        text: String,
    },
    /// Metadata that are no XML.
    #[error("GDAL_METADATA is no XML: {0}")]
    Metadata(#[source] roxmltree::Error),
    /// A scale or offset that gives no values.
    #[error("the {role} in GDAL_METADATA is \"{text}\"; it must be a finite number, a scale not 0")]
    Scaling {
        /// Scale or offset.
        role: &'static str,
        /// Its text.
        text: String,
    },
    /// Values in another unit.
    #[error("the values are in \"{unit}\"; they must be in metres")]
    BandUnit {
        /// Unit in GDAL's metadata.
        unit: String,
    },
    /// No place on a map.
    #[error(
        "the TIFF has no georeference: neither ModelPixelScale with ModelTiepoint nor \
         ModelTransformation"
    )]
    NoGeoreference,
    /// A place by points whose map is not given.
    #[error("the TIFF is placed by {points} control points; warp it to a regular grid")]
    ControlPoints {
        /// Number of points.
        points: usize,
    },
    /// A tag with too few or too many numbers.
    #[error("the tag {tag} has {numbers} numbers, which is not its length")]
    TagLength {
        /// Name of the tag.
        tag: &'static str,
        /// Count of its numbers.
        numbers: usize,
    },
    /// Rows that don't run due east or whose first is not in the north.
    #[error(
        "the raster is rotated, sheared or mirrored: a column leads by ({}, {}) m and a row by \
         ({}, {}) m; a column must lead due east and a row due south", column[0], column[1],
        row[0], row[1]
    )]
    Rotated {
        /// Step from a cell to the next of its row [m].
        column: [f64; 2],
        /// Step from a cell to the next of its column [m].
        row: [f64; 2],
    },
    /// Heights in a scale of the georeference.
    #[error("the georeference scales heights by {scale} with offset {offset}; write plain metres")]
    HeightScale {
        /// Scale.
        scale: f64,
        /// Offset.
        offset: f64,
    },
    /// Degrees.
    #[error(
        "the coordinates are geographic, and degrees are no metres; reproject the raster to a \
         projected coordinate system in metres, such as UTM"
    )]
    Geographic,
    /// Coordinates from the centre of the Earth.
    #[error(
        "the coordinates are geocentric; reproject the raster to a projected coordinate system \
         in metres, such as UTM"
    )]
    Geocentric,
    /// Coordinates in another unit.
    #[error("the coordinates are in {name} (unit {code}); they must be in metres (9001)")]
    LinearUnit {
        /// EPSG code of the unit.
        code: u16,
        /// Name of the unit.
        name: &'static str,
    },
    /// Coordinates in a unit of this size.
    #[error("the unit of the coordinates is {metres} m long; they must be in metres")]
    LinearUnitSize {
        /// Length of the unit [m].
        metres: f64,
    },
    /// Coordinates in the unit of their coordinate system.
    #[error("a unit of EPSG:{epsg} is {metres} m long; coordinates must be in metres")]
    CrsUnit {
        /// EPSG code of the coordinate system.
        epsg: u32,
        /// Length of its unit [m].
        metres: f64,
    },
    /// Heights in another unit.
    #[error("the heights are in {name} (unit {code}); they must be in metres (9001)")]
    VerticalUnit {
        /// EPSG code of the unit.
        code: u16,
        /// Name of the unit.
        name: &'static str,
    },
    /// Heights in feet, the unit of their coordinate system.
    #[error("the heights are those of EPSG:{epsg}, in feet; they must be in metres")]
    VerticalCrs {
        /// EPSG code of the vertical coordinate system.
        epsg: u32,
    },
}

impl GeoTiffError {
    /// An end of the file where there should be more, said as such.
    pub(super) fn of_file(self, bytes: usize) -> Self {
        match self {
            Self::Tiff(TiffError::IoError(error)) if error.kind() == ErrorKind::UnexpectedEof => {
                Self::Truncated { bytes }
            }
            other => other,
        }
    }
}
