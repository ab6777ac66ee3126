//! Columns of nodes over a terrain.

use super::{SplineSurface, TerrainFriction, upward};
use crate::bed::Surface;
use crate::kernel::{Lattice, REACH};

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
    /// Elevation averaged with the transfer's kernel [m].
    pub(super) mean_elevation: f64,
    /// The bed at the intersection: slope and friction averaged in the same way.
    pub(super) surface: Surface,
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
        let (mut mean_elevation, mut slope, mut mean_friction) = (0.0, [0.0; 2], 0.0);
        for (along, share_along) in points() {
            for (aside, share_aside) in points() {
                let share = share_along * share_aside;
                let x = node.x + along * lattice.spacing.x;
                let y = node.y + aside * lattice.spacing.y;
                let facet = surface.at(x, y);
                mean_elevation += share * facet.elevation;
                slope[0] += share * facet.slope[0];
                slope[1] += share * facet.slope[1];
                mean_friction += share * friction.at(x, y);
            }
        }
        Self {
            elevation: surface.elevation(node.x, node.y),
            mean_elevation,
            surface: Surface {
                normal: upward(slope),
                friction: mean_friction,
            },
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
