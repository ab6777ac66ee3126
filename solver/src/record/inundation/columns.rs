//! Columns of the flow above the cells at one instant.

use super::frame::{Frame, TileIndex, Tiles, tile_of};
use crate::points::Point;

/// Fractions into which the mass of a point is divided: sums of whole numbers do not depend on
/// their order, in which points come as it happens.
const FRACTIONS: f64 = (1 << 20) as f64;

/// Mass and momentum of the flow above each cell. A point is spread evenly over a square with the
/// side of a cell of the computation, which is what the computation resolves: points of a flow that
/// has spread leave no gaps.
pub(super) struct Columns {
    frame: Frame,
    side: f64,
    /// Mass of a fraction [kg].
    fraction: f64,
    /// Flow height of a fraction above a cell [m].
    height: f64,
    sums: Tiles<Sums>,
}

/// Sums over a column, in fractions.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    mass: i64,
    /// Times [m/s].
    momentum: [i64; 3],
}

/// The column of a cell.
pub(super) struct Column<'a> {
    sums: &'a Sums,
    /// Flow height of a fraction [m].
    fraction: f64,
}

impl Columns {
    /// No points yet, which are spread over squares of this side [m]; distance of points [m] and
    /// density [kg/m³] at the start.
    pub(super) fn over(frame: Frame, side: f64, (spacing, density): (f64, f64)) -> Self {
        let fraction = density * spacing.powi(3) / FRACTIONS;
        Self {
            frame,
            side,
            fraction,
            height: fraction / density / frame.cell_size.powi(2),
            sums: Tiles::default(),
        }
    }

    /// Adds a point; what lies beyond the edges is left out.
    pub(super) fn add(&mut self, point: &Point) {
        let shares = [0, 1].map(|axis| self.shares(point.position[axis]));
        let fractions = point.mass / self.fraction;
        for (row, share_of_row) in shares[1].cells() {
            for (column, share_of_column) in shares[0].cells() {
                if !self.frame.has([column, row]) {
                    continue;
                }
                let (tile, place) = tile_of([column as usize, row as usize]);
                let sums = &mut self.sums.at(tile)[place];
                let mass = fractions * share_of_row * share_of_column;
                sums.mass += mass.round() as i64;
                for axis in 0..3 {
                    sums.momentum[axis] += (mass * point.velocity[axis]).round() as i64;
                }
            }
        }
    }

    fn shares(&self, middle: f64) -> Shares {
        let size = self.frame.cell_size;
        Shares {
            from: (middle - 0.5 * self.side) / size,
            length: self.side / size,
        }
    }

    /// All tiles in order, with the columns of their cells.
    pub(super) fn tiles(
        &self,
    ) -> impl Iterator<Item = (TileIndex, impl Iterator<Item = Column<'_>>)> {
        let fraction = self.height;
        let column = move |sums| Column { sums, fraction };
        self.sums
            .all()
            .map(move |(tile, sums)| (tile, sums.iter().map(column)))
    }

    /// Flow height above a cell [m].
    pub(super) fn height_m(&self, tile: TileIndex, place: usize) -> f64 {
        let sums = self.sums.get(tile, place);
        sums.map_or(0.0, |sums| sums.mass as f64 * self.height)
    }
}

impl Column<'_> {
    /// Flow height: volume at the density of the release, over the area of the cell [m].
    pub(super) fn height_m(&self) -> f64 {
        self.sums.mass as f64 * self.fraction
    }

    /// Magnitude of the mean velocity, by mass [m/s].
    pub(super) fn speed_m_s(&self) -> f64 {
        let squares = self.sums.momentum.map(|axis| (axis as f64).powi(2));
        squares.iter().sum::<f64>().sqrt() / (self.sums.mass as f64).max(1.0)
    }
}

/// A stretch along an axis, in cells.
#[derive(Clone, Copy)]
struct Shares {
    from: f64,
    length: f64,
}

impl Shares {
    /// The cells that it touches, and the share of it in each.
    fn cells(self) -> impl Iterator<Item = (i64, f64)> {
        let to = self.from + self.length;
        (self.from.floor() as i64..to.ceil() as i64).map(move |cell| {
            let (low, high) = (cell as f64, (cell + 1) as f64);
            (cell, (to.min(high) - self.from.max(low)) / self.length)
        })
    }
}
