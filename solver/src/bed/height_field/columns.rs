//! Columns of nodes over a terrain: what the flow's grid sees of it, kept once found.

use super::{SplineSurface, TerrainFriction, upward};
use crate::bed::Surface;
use crate::kernel::{Lattice, REACH};
use std::sync::OnceLock;

/// Columns of a tile along each axis.
const TILE: usize = 16;
/// Columns beyond the edges of the terrain that are kept.
const BEYOND: i32 = 4;
/// Gauss points per node distance, and their weights: exact for the kernel.
const GAUSS: [(f64, f64); 3] = [
    (-0.387_298_334_620_741_7, 5.0 / 18.0),
    (0.0, 8.0 / 18.0),
    (0.387_298_334_620_741_7, 5.0 / 18.0),
];

/// The terrain along a column of nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column {
    /// Elevation at the nodes [m].
    pub(super) elevation: f64,
    /// Elevation, slope and friction averaged with the transfer's kernel.
    pub(super) mean_elevation: f64,
    pub(super) slope: [f64; 2],
    pub(super) friction: f64,
}

impl Column {
    /// The column with these indices.
    pub(super) fn over(
        surface: &SplineSurface,
        friction: &TerrainFriction,
        across: [i32; 2],
        lattice: &Lattice,
    ) -> Self {
        let node = lattice.position([across[0], across[1], 0]);
        let mut column = Self {
            elevation: surface.at(node.x, node.y).elevation,
            mean_elevation: 0.0,
            slope: [0.0; 2],
            friction: 0.0,
        };
        for (along, share_along) in points() {
            for (aside, share_aside) in points() {
                let share = share_along * share_aside;
                let x = node.x + along * lattice.spacing.x;
                let y = node.y + aside * lattice.spacing.y;
                let facet = surface.at(x, y);
                column.mean_elevation += share * facet.elevation;
                column.slope[0] += share * facet.slope[0];
                column.slope[1] += share * facet.slope[1];
                column.friction += share * friction.at(x, y);
            }
        }
        column
    }

    /// The bed at its intersection.
    pub(super) fn surface(&self) -> Surface {
        Surface {
            normal: upward(self.slope),
            friction: self.friction,
        }
    }
}

/// Places of the integration across the kernel [node distances], with their weights: the kernel's
/// and those of Gauss.
fn points() -> impl Iterator<Item = (f64, f64)> {
    let pieces = [-1.0, 0.0, 1.0].into_iter();
    pieces.flat_map(|piece| {
        GAUSS.into_iter().map(move |(at, weight)| {
            let place: f64 = piece + at;
            let kernel = if place.abs() < 0.5 {
                0.75 - place * place
            } else {
                0.5 * (REACH - place.abs()).powi(2)
            };
            (place, weight * kernel)
        })
    })
}

type Tile = Box<[Column]>;

/// The columns of a lattice, tile by tile: only those that the flow comes to are found.
#[derive(Debug)]
pub(super) struct Columns {
    /// Lattice of the nodes.
    pub(super) lattice: Lattice,
    /// First column along x and y.
    first: [i32; 2],
    /// Tiles along x and y.
    tiles: [usize; 2],
    found: Vec<OnceLock<Tile>>,
}

impl Columns {
    /// Columns over a rectangle from (0, 0) on [m].
    pub(super) fn of(lattice: &Lattice, extent: [f64; 2]) -> Self {
        let place = |at: f64, axis: usize| (at - lattice.origin[axis]) / lattice.spacing[axis];
        let first = [0, 1].map(|axis| place(0.0, axis).floor() as i32 - BEYOND);
        let tiles = [0, 1].map(|axis| {
            let last = place(extent[axis], axis).ceil() as i32 + BEYOND;
            (last - first[axis]).unsigned_abs() as usize / TILE + 1
        });
        let mut found = Vec::new();
        found.resize_with(tiles[0] * tiles[1], OnceLock::new);
        Self {
            lattice: *lattice,
            first,
            tiles,
            found,
        }
    }

    /// The column with these indices, by `compute` if it is not known yet.
    pub(super) fn at(&self, across: [i32; 2], compute: impl Fn([i32; 2]) -> Column) -> Column {
        let place = [0, 1].map(|axis| i64::from(across[axis]) - i64::from(self.first[axis]));
        let tile = place.map(|place| place.div_euclid(TILE as i64));
        let outside = |axis: usize| tile[axis] < 0 || tile[axis] >= self.tiles[axis] as i64;
        if outside(0) || outside(1) {
            return compute(across);
        }
        let [i, j] = tile.map(|tile| tile as usize);
        let found = self.found[j * self.tiles[0] + i].get_or_init(|| {
            let start = [i, j].map(|tile| (tile * TILE) as i32);
            let columns = (0..TILE * TILE).map(|n| {
                let [u, v] = [n % TILE, n / TILE].map(|n| n as i32);
                compute([self.first[0] + start[0] + u, self.first[1] + start[1] + v])
            });
            columns.collect()
        });
        let [u, v] = [0, 1].map(|axis| place[axis].rem_euclid(TILE as i64) as usize);
        found[v * TILE + u]
    }
}
