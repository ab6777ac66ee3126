//! Values that suit their purpose.

use crate::file::RasterFile;
use crate::purpose::{Holes, Purpose};
use scree_solver::raster::Raster;
use std::fmt;
use thiserror::Error;

/// Steepest step between neighbouring cells of the ground, in sides of a cell: 89.4°.
const STEEPEST: f64 = 100.0;

/// A cell as the file and GDAL count: from 0 in the north-western corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Cell {
    /// Row, southwards.
    pub row: usize,
    /// Column, eastwards.
    pub column: usize,
}

impl fmt::Display for Cell {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "row {} and column {}", self.row, self.column)
    }
}

/// A value that its purpose doesn't allow. Cells count from 0 in the north-western corner.
#[derive(Debug, Error, PartialEq)]
pub enum ValueError {
    /// Holes where there may be none.
    #[error(
        "the cell in {cell}, counted from 0 in the north-western corner, has no {quantity} (its \
         number is {value}); {holes} of {cells} cells have none, and none may be without"
    )]
    Hole {
        /// The first hole.
        cell: Cell,
        /// Quantity that is missing.
        quantity: &'static str,
        /// Number that stands for the hole.
        value: f64,
        /// Number of holes.
        holes: usize,
        /// Number of cells.
        cells: usize,
    },
    /// No finite number.
    #[error(
        "the {quantity} in {cell}, counted from 0 in the north-western corner, is {value}; it \
         must be finite"
    )]
    Infinite {
        /// The first such cell.
        cell: Cell,
        /// Quantity that is infinite.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that can't be meant.
    #[error(
        "the {quantity} in {cell}, counted from 0 in the north-western corner, is {value}{unit}; \
         possible are {least}{unit} to {greatest}{unit}; is this an undeclared nodata value?"
    )]
    OutOfRange {
        /// The first such cell.
        cell: Cell,
        /// Quantity that is out of range.
        quantity: &'static str,
        /// Its value.
        value: f64,
        /// Least possible value.
        least: f64,
        /// Greatest possible value.
        greatest: f64,
        /// Unit, with the space before it.
        unit: &'static str,
    },
    /// A step that no ground has.
    #[error(
        "the height rises or falls from {value} m in {cell} to {neighbour_value} m in \
         {neighbour}, counted from 0 in the north-western corner; between cells of {cell_size} m \
         at most {most} m are possible; is this an undeclared nodata value?"
    )]
    Step {
        /// A cell.
        cell: Cell,
        /// Its height [m].
        value: f64,
        /// Its eastern or southern neighbour.
        neighbour: Cell,
        /// The neighbour's height [m].
        neighbour_value: f64,
        /// Side of a cell [m].
        cell_size: f64,
        /// Greatest possible step [m].
        most: f64,
    },
}

/// Raster whose values suit a purpose.
pub(crate) fn checked(file: RasterFile, purpose: Purpose) -> Result<Raster, ValueError> {
    if purpose.holes() == Holes::Refused {
        whole(&file, purpose)?;
    }
    let RasterFile { mut raster, nodata } = file;
    let filling = match purpose.holes() {
        Holes::Zero => 0.0,
        Holes::Refused | Holes::Kept => f64::NAN,
    };
    for value in &mut raster.values {
        if value.is_nan() || nodata == Some(*value) {
            *value = filling;
        }
    }
    in_range(&raster, purpose)?;
    if purpose == Purpose::HeightMap {
        without_spikes(&raster)?;
    }
    Ok(raster)
}

/// Cells in the order of the file, from the north-western corner, with their values.
fn from_the_north(raster: &Raster) -> impl Iterator<Item = (Cell, f64)> {
    let rows = raster.values.chunks_exact(raster.columns).rev().enumerate();
    rows.flat_map(|(row, values)| {
        let values = values.iter().enumerate();
        values.map(move |(column, value)| (Cell { row, column }, *value))
    })
}

fn whole(file: &RasterFile, purpose: Purpose) -> Result<(), ValueError> {
    let mut holes = from_the_north(&file.raster).filter(|(_, value)| file.is_hole(*value));
    let Some((cell, value)) = holes.next() else {
        return Ok(());
    };
    Err(ValueError::Hole {
        cell,
        quantity: purpose.quantity(),
        value,
        holes: 1 + holes.count(),
        cells: file.raster.values.len(),
    })
}

fn in_range(raster: &Raster, purpose: Purpose) -> Result<(), ValueError> {
    let range = purpose.range();
    let outside = |(_, value): &(Cell, f64)| !value.is_nan() && !range.contains(value);
    let Some((cell, value)) = from_the_north(raster).find(outside) else {
        return Ok(());
    };
    let quantity = purpose.quantity();
    Err(if value.is_infinite() {
        ValueError::Infinite {
            cell,
            quantity,
            value,
        }
    } else {
        ValueError::OutOfRange {
            cell,
            quantity,
            value,
            least: *range.start(),
            greatest: *range.end(),
            unit: purpose.unit(),
        }
    })
}

fn without_spikes(raster: &Raster) -> Result<(), ValueError> {
    let most = STEEPEST * raster.cell_size;
    let at = |cell: Cell| raster.value_at(cell.column, raster.rows - 1 - cell.row);
    for (cell, value) in from_the_north(raster) {
        let Cell { row, column } = cell;
        let east = (column + 1 < raster.columns).then_some(Cell {
            row,
            column: column + 1,
        });
        let south = (row + 1 < raster.rows).then_some(Cell {
            row: row + 1,
            column,
        });
        let mut neighbours = east.into_iter().chain(south);
        if let Some(neighbour) = neighbours.find(|other| (at(*other) - value).abs() > most) {
            return Err(ValueError::Step {
                cell,
                value,
                neighbour,
                neighbour_value: at(neighbour),
                cell_size: raster.cell_size,
                most,
            });
        }
    }
    Ok(())
}
