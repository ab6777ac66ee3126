//! Columns of nodes over a terrain.

use super::{Facet, SplineSurface, TerrainFriction, upward};
use crate::bed::{Intersection, Surface};
use crate::kernel::{Lattice, REACH, share_above};
use crate::method::METHOD;

/// Gauss points per node distance, and their weights: exact for the kernel.
const GAUSS: [(f64, f64); 3] = [
    (-0.387_298_334_620_741_7, 5.0 / 18.0),
    (0.0, 8.0 / 18.0),
    (0.387_298_334_620_741_7, 5.0 / 18.0),
];

/// The terrain along a column of nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Column {
    /// The terrain at the nodes.
    pub(super) facet: Facet,
    /// The terrain averaged with the transfer's kernel.
    pub(super) mean: Facet,
    /// The bed at the intersection: slope and friction averaged in the same way, but without
    /// cliffs.
    pub(super) surface: Surface,
}

/// Sums over the kernel.
#[derive(Default)]
struct Sums {
    share: f64,
    elevation: f64,
    slope: [f64; 2],
    friction: f64,
}

impl Sums {
    fn add(&mut self, share: f64, facet: &Facet, friction: f64) {
        self.share += share;
        self.elevation += share * facet.elevation;
        self.slope[0] += share * facet.slope[0];
        self.slope[1] += share * facet.slope[1];
        self.friction += share * friction;
    }
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
        let [mut all, mut gentle] = [Sums::default(), Sums::default()];
        for (along, share_along) in points() {
            for (aside, share_aside) in points() {
                let share = share_along * share_aside;
                let x = node.x + along * lattice.spacing.x;
                let y = node.y + aside * lattice.spacing.y;
                let facet = surface.at(x, y);
                let friction = friction.at(x, y);
                all.add(share, &facet, friction);
                if !is_cliff(&facet) {
                    gentle.add(share, &facet, friction);
                }
            }
        }
        let facet = surface.at(node.x, node.y);
        let over = if is_cliff(&facet) || gentle.share == 0.0 {
            &all
        } else {
            &gentle
        };
        Self {
            facet,
            mean: Facet {
                elevation: all.elevation,
                slope: all.slope,
            },
            surface: Surface {
                normal: upward(over.slope.map(|slope| slope / over.share)),
                friction: over.friction / over.share,
            },
        }
    }

    /// Intersection with the terrain; `None` at a cliff, where the bed does not act on nodes by
    /// columns.
    pub(super) fn intersection(&self, lattice: &Lattice) -> Option<Intersection> {
        let cells = (self.facet.elevation - lattice.origin.z) / lattice.spacing.z;
        (!is_cliff(&self.facet)).then(|| Intersection::at(cells).up_to(self.deepest()))
    }

    /// Nodes behind the first that kernels of points above a plane of this slope can reach.
    fn deepest(&self) -> i32 {
        let normal = self.surface.normal;
        (REACH * (1.0 + (normal.x.abs() + normal.y.abs()) / normal.z)).ceil() as i32
    }

    /// Share of the kernel of a node at this elevation [m] above the terrain.
    pub(super) fn share_above(&self, elevation: f64, lattice: &Lattice) -> f64 {
        let normal = upward(self.mean.slope);
        // The kernel is as wide along a slant as along its axes.
        let width = normal.component_mul(&lattice.spacing).norm();
        share_above((elevation - self.mean.elevation) * normal.z / width)
    }
}

/// True if the terrain is too steep here for vertical columns.
fn is_cliff(facet: &Facet) -> bool {
    facet.slope[0].hypot(facet.slope[1]) > METHOD.boundary.steep
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
