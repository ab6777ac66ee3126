//! Terrain under the flow's grid, tile by tile: found where the flow comes, and then kept.

use super::columns::Column;
use super::{Lid, SplineSurface, TerrainFriction};
use crate::grid::{BLOCK, POSITIONS_IN_STEP, first_node};
use crate::kernel::Lattice;
use std::sync::OnceLock;

/// Blocks of a tile along each axis, and columns.
const BLOCKS: usize = 4;
const COLUMNS: usize = BLOCKS * BLOCK;
/// Blocks beyond the edges of the terrain that are kept.
const BEYOND: i32 = 2;

/// Terrain under a square of blocks.
#[derive(Debug)]
struct Tile {
    columns: Vec<Column>,
    lids: Vec<Lid>,
}

/// A square of tiles, those in it that were found.
type Square = Vec<OnceLock<Tile>>;

/// A terrain on a lattice, in squares of tiles: memory grows with the root of the number of tiles
/// where no flow comes.
#[derive(Debug)]
pub(super) struct Tiles {
    lattice: Lattice,
    /// First block along x and y.
    first: [i32; 2],
    /// Tiles along x and y.
    count: [usize; 2],
    /// Logarithm to base 2 of the number of tiles along the side of a square.
    log2_side: u32,
    /// Squares along x.
    columns: usize,
    squares: Vec<OnceLock<Square>>,
}

/// The terrain itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terrain<'a> {
    pub(super) surface: &'a SplineSurface,
    pub(super) friction: &'a TerrainFriction,
}

impl Terrain<'_> {
    /// The column of nodes with these indices.
    pub(super) fn column(&self, across: [i32; 2], lattice: &Lattice) -> Column {
        Column::over(self.surface, self.friction, across, lattice)
    }

    /// Lid over a block's points and nodes.
    pub(super) fn lid(&self, block: [i32; 2], lattice: &Lattice) -> Lid {
        let corner = lattice.position(first_node([block[0], block[1], 0]));
        let place = |cells: f64| [0, 1].map(|axis| corner[axis] + cells * lattice.spacing[axis]);
        self.surface
            .lid(place(POSITIONS_IN_STEP.start), place(POSITIONS_IN_STEP.end))
    }
}

impl Tiles {
    /// Tiles over a rectangle from (0, 0) on [m].
    pub(super) fn of(lattice: &Lattice, extent: [f64; 2]) -> Self {
        let block = |at: f64, axis: usize| {
            let cells = (at - lattice.origin[axis]) / lattice.spacing[axis];
            (cells / BLOCK as f64).floor() as i32
        };
        let first = [0, 1].map(|axis| block(0.0, axis) - BEYOND);
        let count = [0, 1].map(|axis| {
            let last = block(extent[axis], axis) + BEYOND;
            (last - first[axis]).unsigned_abs() as usize / BLOCKS + 1
        });
        let log2_side = count[0].max(count[1]).isqrt().ilog2();
        let [columns, rows] = count.map(|tiles| tiles.div_ceil(1 << log2_side));
        Self {
            lattice: *lattice,
            first,
            count,
            log2_side,
            columns,
            squares: unknown(columns * rows),
        }
    }

    /// The column of nodes with these indices; `None` far beyond the edges.
    pub(super) fn column(&self, across: [i32; 2], terrain: &Terrain) -> Option<&Column> {
        let place = [0, 1].map(|axis| across[axis] - self.first[axis] * BLOCK as i32);
        let tile = self.tile(place.map(|along| along.div_euclid(COLUMNS as i32)), terrain)?;
        let [u, v] = place.map(|along| along.rem_euclid(COLUMNS as i32) as usize);
        Some(&tile.columns[v * COLUMNS + u])
    }

    /// Lid over a block; `None` far beyond the edges.
    pub(super) fn lid(&self, block: [i32; 2], terrain: &Terrain) -> Option<Lid> {
        let place = [0, 1].map(|axis| block[axis] - self.first[axis]);
        let tile = self.tile(place.map(|along| along.div_euclid(BLOCKS as i32)), terrain)?;
        let [u, v] = place.map(|along| along.rem_euclid(BLOCKS as i32) as usize);
        Some(tile.lids[v * BLOCKS + u])
    }

    fn tile(&self, index: [i32; 2], terrain: &Terrain) -> Option<&Tile> {
        let within = |axis: usize| {
            let along = usize::try_from(index[axis]).ok()?;
            (along < self.count[axis]).then_some(along)
        };
        let (i, j) = (within(0)?, within(1)?);
        let start = [i, j].map(|along| (along * BLOCKS) as i32);
        let first = [0, 1].map(|axis| self.first[axis] + start[axis]);
        let square = &self.squares[(j >> self.log2_side) * self.columns + (i >> self.log2_side)];
        let tiles = square.get_or_init(|| unknown(1 << (2 * self.log2_side)));
        let [u, v] = [i, j].map(|along| along & ((1 << self.log2_side) - 1));
        let tile = &tiles[(v << self.log2_side) + u];
        Some(tile.get_or_init(|| self.find(first, terrain)))
    }

    /// The tile that starts with this block.
    fn find(&self, first: [i32; 2], terrain: &Terrain) -> Tile {
        let square = |side: usize| (0..side * side).map(move |n| [n % side, n / side]);
        let lids = square(BLOCKS).map(|place| {
            let block = [0, 1].map(|axis| first[axis] + place[axis] as i32);
            terrain.lid(block, &self.lattice)
        });
        let columns = square(COLUMNS).map(|place| {
            let across = [0, 1].map(|axis| first[axis] * BLOCK as i32 + place[axis] as i32);
            terrain.column(across, &self.lattice)
        });
        Tile {
            columns: columns.collect(),
            lids: lids.collect(),
        }
    }
}

/// So many places of which nothing is known.
fn unknown<T>(count: usize) -> Vec<OnceLock<T>> {
    std::iter::repeat_with(OnceLock::new).take(count).collect()
}
