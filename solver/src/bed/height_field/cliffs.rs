//! Surfaces that act on nodes at a cliff, where no column of nodes leads to the bed.

use super::columns::Column;
use super::{HeightField, upward};
use crate::bed::{MOST_SURFACES, Surface};
use crate::kernel::{Lattice, REACH};
use crate::math::Vec3;

/// Columns to each side in which the surfaces near a node are looked for.
const BESIDE: i32 = 2;
/// Cosine of the angle between two normals from which on the surfaces make a corner.
const CORNER: f64 = 0.7;

/// The terrain nearer to one column than to those beside it, as part of a plane.
#[derive(Debug, Clone, Copy)]
struct Patch {
    /// The terrain's place in the column [m].
    middle: Vec3,
    /// Its surface.
    surface: Surface,
}

impl Patch {
    fn of(column: &Column, across: [i32; 2], lattice: &Lattice) -> Self {
        let slope = column.facet.slope;
        let place = lattice.position([across[0], across[1], 0]);
        Self {
            middle: Vec3::new(place.x, place.y, column.facet.elevation),
            surface: Surface {
                normal: upward(slope),
                friction: column.surface.friction,
            },
        }
    }

    /// Height of a place above its plane [m].
    fn height(&self, place: &Vec3) -> f64 {
        self.surface.normal.dot(&(place - self.middle))
    }

    /// True if the other lies in front of it, at an angle.
    fn makes_corner_with(&self, other: &Self) -> bool {
        self.height(&other.middle) > 0.0 && self.surface.normal.dot(&other.surface.normal) < CORNER
    }

    /// Distance of a place from it [m].
    fn distance(&self, place: &Vec3, lattice: &Lattice) -> f64 {
        let normal = self.surface.normal;
        let arm = place - self.middle;
        let foot = arm - normal * normal.dot(&arm);
        let half = lattice.spacing * 0.5;
        let [x, y] = [0, 1].map(|axis| foot[axis].clamp(-half[axis], half[axis]));
        let z = -(normal.x * x + normal.y * y) / normal.z;
        (arm - Vec3::new(x, y, z)).norm()
    }
}

impl HeightField {
    /// Surfaces that act on a node behind the bed at a cliff: the nearest one, and those that make
    /// a corner with it, as the ground at its foot does.
    pub(super) fn surfaces_round(
        &self,
        index: [i32; 3],
        lattice: &Lattice,
    ) -> [Option<Surface>; MOST_SURFACES] {
        let node = lattice.position(index);
        let reach = REACH * lattice.spacing.norm();
        let around = -BESIDE..=BESIDE;
        let places = around
            .clone()
            .flat_map(|j| around.clone().map(move |i| [i, j]));
        let mut near: Vec<(f64, Patch)> = places
            .map(|[i, j]| {
                let across = [index[0] + i, index[1] + j];
                let patch = Patch::of(&self.column(across, lattice), across, lattice);
                (patch.distance(&node, lattice), patch)
            })
            .collect();
        near.sort_by(|one, other| one.0.total_cmp(&other.0));
        let mut chosen: Vec<Patch> = Vec::new();
        for (distance, patch) in near {
            let acts = chosen.is_empty()
                || distance <= reach
                    && patch.height(&node) <= 0.0
                    && chosen.iter().all(|other| other.makes_corner_with(&patch));
            if acts && chosen.len() < MOST_SURFACES {
                chosen.push(patch);
            }
        }
        std::array::from_fn(|place| chosen.get(place).map(|patch| patch.surface))
    }
}
