//! Rasters of terrain as files: GeoTIFF (OGC 19-008r4) and ESRI ASCII grid. They are read for a
//! [`Purpose`], which says what values are possible; whatever can't be meant so is refused with
//! the cell, the value and the range. Files come from anywhere: a size is checked before memory
//! is taken for it.
//!
//! ```
//! use scree_rasters::{Purpose, read};
//!
//! let file = "ncols 3\nnrows 3\nxllcorner 600000\nyllcorner 200000\ncellsize 10\n\
//!             9 9 9\n5 5 5\n1 1 2\n";
//! let heights = read(file.as_bytes(), Purpose::HeightMap)?;
//! // Rows count from the south here, from the north in the file.
//! assert_eq!(heights.value_at(2, 0), 2.0);
//!
//! let holey = file.replace("2\n", "-9999\n").replace("10\n", "10\nnodata_value -9999\n");
//! let error = read(holey.as_bytes(), Purpose::HeightMap).unwrap_err();
//! assert!(error.to_string().starts_with("the cell in row 2 and column 2"));
//! # Ok::<(), scree_rasters::RasterError>(())
//! ```

mod ascii;
mod error;
mod file;
mod geotiff;
mod limits;
mod projection;
mod purpose;
mod values;

pub use ascii::{AsciiError, write_ascii};
pub use error::RasterError;
pub use geotiff::{GeoTiffError, WriteError, write_geotiff};
pub use limits::{MOST_CELLS, SizeError};
pub use projection::{Projection, ProjectionError};
pub use purpose::Purpose;
pub use values::{Cell, ValueError};

use file::RasterFile;
use scree_solver::raster::Raster;
use sha2::{Digest, Sha256};

/// Raster of a file, GeoTIFF or ESRI ASCII grid, whose values suit their purpose.
///
/// # Errors
/// It is neither, can't be read as a raster of square cells in metres, or has values that its
/// purpose doesn't allow.
pub fn read(bytes: &[u8], purpose: Purpose) -> Result<Raster, RasterError> {
    read_at_most(MOST_CELLS, bytes, purpose)
}

/// Raster of a file as [`read`] reads it, if it has so many cells at most: files are compressed, and
/// memory is taken by the cell.
///
/// # Errors
/// It has more, or those of [`read`].
pub fn read_at_most(cells: u64, bytes: &[u8], purpose: Purpose) -> Result<Raster, RasterError> {
    let file = parse(bytes, cells)?;
    Ok(values::checked(file, purpose)?)
}

/// Content of a file whose format is told by its first bytes.
fn parse(bytes: &[u8], most_cells: u64) -> Result<RasterFile, RasterError> {
    match bytes {
        [] => Err(RasterError::Empty),
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => {
            geotiff::read(bytes, most_cells)
        }
        _ if ascii::begins(bytes) => ascii::read(bytes, most_cells),
        _ => Err(RasterError::UnknownFormat {
            start: bytes[..bytes.len().min(8)].escape_ascii().to_string(),
        }),
    }
}

/// SHA-256 of a file's bytes as 64 lower-case hexadecimal digits: the name of its content.
pub fn hash(bytes: &[u8]) -> String {
    let digest = Sha256::digest(bytes);
    digest.iter().map(|byte| format!("{byte:02x}")).collect()
}
