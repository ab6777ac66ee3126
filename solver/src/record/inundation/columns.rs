//! Columns of the flow above the cells at one instant.

use super::Inundation;
use super::frame::{CELLS, Frame, TileIndex, Tiles, row_of};
use crate::math::Vec3;
use crate::points::PointMotion;
use crate::simulation::Simulation;
use std::collections::BTreeMap;

/// Fractions into which the mass of a point is divided: sums of whole numbers do not depend on
/// their order, in which points come as it happens.
const FRACTIONS: f64 = (1 << 30) as f64;

/// Mass and momentum of the flow above each cell.
pub(super) struct Columns {
    sums: Tiles<Sums>,
    /// Flow height of a fraction above a cell [m].
    height: f64,
}

/// Sums over a column: mass, in fractions, and momentum along each axis, in fractions times [m/s].
#[derive(Debug, Clone, Copy, Default)]
struct Sums([i64; 4]);

impl Sums {
    fn mass(&self) -> f64 {
        self.0[0] as f64
    }

    /// Adds a share of a point's mass and momentum.
    #[inline]
    fn add(&mut self, share: f64, of_point: &[f64; 4]) {
        for (sum, all) in self.0.iter_mut().zip(of_point) {
            *sum += whole(share * all);
        }
    }
}

/// The nearest whole number of one below 2^51. The sum with 3/2 × 2^52 has no room for binary places,
/// and is converted without the tests for larger numbers: a look takes 36 conversions for a point.
#[inline]
fn whole(number: f64) -> i64 {
    const ROUNDER: f64 = 1.5 * (1_u64 << 52) as f64;
    (number + ROUNDER).to_bits().cast_signed() - ROUNDER.to_bits().cast_signed()
}

/// The column of a cell.
pub(super) struct Column<'a> {
    sums: &'a Sums,
    /// Flow height of a fraction [m].
    fraction: f64,
}

impl Columns {
    /// The columns of a flow.
    pub(super) fn of(simulation: &Simulation, inundation: &Inundation) -> Self {
        let spread = Spread::of(inundation);
        let sums = simulation.fold_motions(
            TileSums::default,
            |sums, point| spread.add(point, sums),
            TileSums::joined,
        );
        Self {
            sums: sums.into_tiles(),
            height: spread.height_of_fraction(inundation.density),
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
        sums.map_or(0.0, |sums| sums.mass() * self.height)
    }
}

impl Column<'_> {
    /// Flow height: volume at the density of the release, over the area of the cell [m].
    pub(super) fn height_m(&self) -> f64 {
        self.sums.mass() * self.fraction
    }

    /// Magnitude of the mean velocity, by mass [m/s].
    pub(super) fn speed_m_s(&self) -> f64 {
        let [_, along @ ..] = self.sums.0.map(|sum| sum as f64);
        Vec3::from(along).norm() / self.sums.mass().max(1.0)
    }
}

/// Spreading of points over cells: each evenly over a square with the side of a cell of the
/// computation, which is what the computation resolves, so that points of a flow that has spread
/// leave no gaps.
#[derive(Clone, Copy)]
struct Spread {
    frame: Frame,
    /// Cells in a metre.
    per_metre: f64,
    /// Side of the square [cells].
    side: f64,
    /// One over it.
    per_side: f64,
    /// Fractions of mass in a kilogram.
    per_mass: f64,
}

impl Spread {
    fn of(inundation: &Inundation) -> Self {
        let Inundation { frame, side, .. } = *inundation;
        let side = side / frame.cell_size;
        Self {
            frame,
            per_metre: 1.0 / frame.cell_size,
            side,
            per_side: 1.0 / side,
            per_mass: FRACTIONS / (inundation.density * inundation.spacing.powi(3)),
        }
    }

    /// Flow height of a fraction above a cell [m], at a density [kg/m³].
    fn height_of_fraction(&self, density: f64) -> f64 {
        1.0 / (self.per_mass * density * self.frame.cell_size.powi(2))
    }

    /// Adds a point; of a square that reaches beyond the edges the part within carries all.
    fn add(&self, point: &PointMotion, sums: &mut TileSums) {
        let mass = point.mass * self.per_mass;
        let [x, y, z] = (point.velocity * mass).into();
        let of_point = [mass, x, y, z];
        let columns = self.shares(point.position.x, 0);
        let rows = self.shares(point.position.y, 1);
        for (row, of_row) in rows.cells() {
            let mut column = columns.first;
            let mut shares = &columns.of_cells[..columns.count];
            while !shares.is_empty() {
                let cells = sums.row_from([column, row]);
                let (here, beyond) = shares.split_at(shares.len().min(cells.len()));
                for (cell, of_column) in cells.iter_mut().zip(here) {
                    cell.add(of_row * of_column, &of_point);
                }
                column += here.len();
                shares = beyond;
            }
        }
    }

    /// Shares of the square round a place [m] along an axis.
    #[inline]
    fn shares(&self, middle: f64, axis: usize) -> Shares {
        let west = middle * self.per_metre - 0.5 * self.side;
        let east = west + self.side;
        let (from, to) = (west.max(0.0), east.min(self.frame.count[axis] as f64));
        let is_within = (from, to) == (west, east);
        let of_cell = if is_within {
            self.per_side
        } else {
            1.0 / (to - from)
        };
        let first = from as u32;
        // The square's end, from the end of its first cell on.
        let past = to - f64::from(first) - 1.0;
        let of_cells = [to - from - past.max(0.0), past.clamp(0.0, 1.0), past - 1.0];
        Shares {
            first: first as usize,
            count: usize::from(to > from) + usize::from(past > 0.0) + usize::from(past > 1.0),
            of_cells: of_cells.map(|cells| cells * of_cell),
        }
    }
}

/// Most cells along an axis that a square touches: it is less than two cells wide.
const MOST_CELLS: usize = 3;

/// Shares of a square in the cells that it touches along an axis, the first `count` of these.
#[derive(Debug, Clone, Copy)]
struct Shares {
    first: usize,
    count: usize,
    of_cells: [f64; MOST_CELLS],
}

impl Shares {
    /// The cells and the share of each.
    #[inline]
    fn cells(&self) -> impl Iterator<Item = (usize, f64)> {
        let shares = self.of_cells.iter().take(self.count);
        (self.first..).zip(shares.copied())
    }
}

/// Sums of the cells of some tiles; neighbouring cells are found at once.
#[derive(Debug, Default)]
struct TileSums {
    places: BTreeMap<TileIndex, usize>,
    tiles: Vec<Vec<Sums>>,
    /// The tile asked for last, and its place.
    last: Option<(TileIndex, usize)>,
}

impl TileSums {
    /// The sums of a cell and those east of it in its tile, nothing at first.
    fn row_from(&mut self, cell: [usize; 2]) -> &mut [Sums] {
        let (tile, places) = row_of(cell);
        &mut self.tile(tile)[places]
    }

    fn tile(&mut self, tile: TileIndex) -> &mut [Sums] {
        let place = match self.last {
            Some((known, place)) if known == tile => place,
            _ => self.look_up(tile),
        };
        self.last = Some((tile, place));
        &mut self.tiles[place]
    }

    fn look_up(&mut self, tile: TileIndex) -> usize {
        *self.places.entry(tile).or_insert_with(|| {
            self.tiles.push(vec![Sums::default(); CELLS]);
            self.tiles.len() - 1
        })
    }

    /// Sums of both.
    fn joined(mut self, other: Self) -> Self {
        for (tile, place) in other.places {
            for (sum, more) in self.tile(tile).iter_mut().zip(&other.tiles[place]) {
                for (sum, more) in sum.0.iter_mut().zip(more.0) {
                    *sum += more;
                }
            }
        }
        self
    }

    fn into_tiles(mut self) -> Tiles<Sums> {
        let taken = |(tile, place)| (tile, std::mem::take(&mut self.tiles[place]));
        Tiles::of(self.places.into_iter().map(taken))
    }
}
