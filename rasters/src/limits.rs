//! Numbers, sizes and places of cells that are possible; checked before their values are read.

use std::ops::RangeInclusive;
use thiserror::Error;

/// Fewest columns and rows: a slope needs a neighbour on both sides.
const FEWEST: u64 = 3;
/// Most cells that are ever read: 10 km × 10 km at 1 m, 0.8 GB of values.
pub const MOST_CELLS: u64 = 100_000_000;
/// Sides of cells [m].
const CELL_SIZES: RangeInclusive<f64> = 0.01..=1000.0;
/// Greatest relative difference between width and height of a cell: what reprojection leaves.
const SQUARE: f64 = 1e-6;
/// Greatest distance from the origin of coordinates [m]; any map on Earth lies within.
const FARTHEST: f64 = 1e8;

/// A number, size or place of cells that is not possible.
#[derive(Debug, Error, PartialEq)]
pub enum SizeError {
    /// Too few for a slope.
    #[error("the raster has {columns} × {rows} cells; at least 3 × 3 are needed")]
    TooFewCells {
        /// Columns.
        columns: u64,
        /// Rows.
        rows: u64,
    },
    /// Too many for memory.
    #[error("the raster has {columns} × {rows} cells; at most {most} in all are read here")]
    TooManyCells {
        /// Columns.
        columns: u64,
        /// Rows.
        rows: u64,
        /// Most cells that are read.
        most: u64,
    },
    /// Oblong cells.
    #[error(
        "the cells are {width} m wide and {height} m high; they must be square, so resample the \
         raster"
    )]
    NotSquare {
        /// Width of a cell.
        width: f64,
        /// Height of a cell.
        height: f64,
    },
    /// Cells so small that their sides must be angles.
    #[error(
        "the cells have a side of {cell_size}, less than 0.01 m: that looks like degrees, which \
         are no metres; reproject the raster to a projected coordinate system in metres"
    )]
    Degrees {
        /// Side of a cell.
        cell_size: f64,
    },
    /// Cells of a size that no simulation can use.
    #[error("the cells have a side of {cell_size} m; possible are 0.01 m to 1000 m")]
    CellSize {
        /// Side of a cell [m].
        cell_size: f64,
    },
    /// Edges that are no place on Earth.
    #[error(
        "the western edge is at {west} m and the southern one at {south} m; possible are \
         -100000000 m to 100000000 m"
    )]
    Place {
        /// Easting of the western edge [m].
        west: f64,
        /// Northing of the southern edge [m].
        south: f64,
    },
}

/// Columns and rows of a raster that has so many cells at most.
pub(crate) fn shape([columns, rows]: [u64; 2], most: u64) -> Result<[usize; 2], SizeError> {
    let most = most.min(MOST_CELLS);
    if columns.saturating_mul(rows) > most {
        return Err(SizeError::TooManyCells {
            columns,
            rows,
            most,
        });
    }
    if columns < FEWEST || rows < FEWEST {
        return Err(SizeError::TooFewCells { columns, rows });
    }
    Ok([columns as usize, rows as usize])
}

/// Side of square cells of a possible size [m].
pub(crate) fn cell_size(width: f64, height: f64) -> Result<f64, SizeError> {
    // Not "greater": NaN shall be refused too.
    let is_square = (width - height).abs() <= SQUARE * width.abs();
    if width.is_finite() && height.is_finite() && !is_square {
        return Err(SizeError::NotSquare { width, height });
    }
    match width {
        side if is_square && CELL_SIZES.contains(&side) => Ok(side),
        side if side > 0.0 && side < *CELL_SIZES.start() => {
            Err(SizeError::Degrees { cell_size: side })
        }
        side => Err(SizeError::CellSize { cell_size: side }),
    }
}

/// Western and southern edge within the plane of a map [m].
pub(crate) fn place(west: f64, south: f64) -> Result<[f64; 2], SizeError> {
    let is_near = west.abs() <= FARTHEST && south.abs() <= FARTHEST;
    is_near
        .then_some([west, south])
        .ok_or(SizeError::Place { west, south })
}
