//! Columns of nodes over a terrain.

use super::{Facet, SplineSurface, TerrainFriction, upward};
use crate::bed::{Intersection, Surface, rounding};
use crate::kernel::{Lattice, REACH, share_above};
use crate::math::Vec3;
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
    /// Intersection with it; `None` at a cliff, where the bed does not act on nodes by columns.
    pub(super) intersection: Option<Intersection>,
    /// The bed at the intersection: slope and friction averaged with the transfer's kernel, without
    /// cliffs.
    pub(super) surface: Surface,
    /// Elevation averaged in the same way, cliffs included [m].
    mean_elevation: f64,
    /// Widths of the kernel, across the mean slope, in a metre of height.
    widths_per_height: f64,
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
        let at_cliff = is_cliff(&facet);
        let over = if at_cliff || gentle.share == 0.0 {
            &all
        } else {
            &gentle
        };
        let surface = Surface {
            normal: upward(over.slope.map(|slope| slope / over.share)),
            friction: over.friction / over.share,
        };
        let cells = (facet.elevation - lattice.origin.z) / lattice.spacing.z;
        let mean_normal = upward(all.slope);
        // The kernel is as wide along a slant as along its axes.
        let width = mean_normal.component_mul(&lattice.spacing).norm();
        Self {
            facet,
            intersection: (!at_cliff).then(|| Intersection::at(cells).up_to(deepest(&surface))),
            surface,
            mean_elevation: all.elevation,
            widths_per_height: mean_normal.z / width,
        }
    }

    /// True if the terrain is on or above a node of the column, at this place [m].
    pub(super) fn covers(&self, node: &Vec3) -> bool {
        node.z - self.facet.elevation <= rounding(node)
    }

    /// Share of the kernel of a node at this elevation [m] above the terrain.
    pub(super) fn share_above(&self, elevation: f64) -> f64 {
        share_above((elevation - self.mean_elevation) * self.widths_per_height)
    }
}

/// Nodes behind the first that kernels of points above a plane like this surface can reach.
fn deepest(surface: &Surface) -> i32 {
    let normal = surface.normal;
    (REACH * (1.0 + (normal.x.abs() + normal.y.abs()) / normal.z)).ceil() as i32
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
