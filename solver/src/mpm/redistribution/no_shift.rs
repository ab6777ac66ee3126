//! Zones near the bed in which no point is shifted towards it (docs/method.md, equations 42b and
//! 42c).

use crate::bed::{HeightField, Lid, Plane};
use crate::grid::{BLOCK, BlockKey, POSITIONS_IN_STEP, first_node};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::mpm::lanes::{Real, Splat, load, load_each};
use fearless_simd::prelude::*;
use std::ops::Range;

/// Zone at a plane of the bed in which no point is shifted towards it, and none deep behind it is
/// moved farther behind it (equations 42b and 42c).
#[derive(Debug, Clone, Copy)]
pub struct NoShiftZone<R> {
    /// Unit normal.
    normal: [R; 3],
    /// Height of a place [m] over its position [cells].
    rise: [R; 3],
    /// Height of the origin of positions [m].
    origin: f64,
    /// Node distance across the plane [m].
    width: R,
}

impl<R: Real> NoShiftZone<R> {
    /// Zone at a plane, for positions from the lattice's origin.
    pub fn of(plane: &Plane, lattice: &Lattice) -> Self {
        let rise = plane.normal.component_mul(&lattice.spacing);
        Self {
            normal: [0, 1, 2].map(|axis| R::of(plane.normal[axis])),
            rise: [0, 1, 2].map(|axis| R::of(rise[axis])),
            origin: plane.height(&lattice.origin),
            width: R::of(rise.norm()),
        }
    }

    /// Zone for the points of a chunk in a block, at these positions [cells].
    #[inline(always)]
    pub fn of_chunk<S: Simd>(
        &self,
        simd: S,
        key: &BlockKey,
        position: &[R::Vector<S>; 3],
    ) -> ChunkZone<S, R> {
        let number = Splat::<S, R>::new(simd);
        let mut origin = self.origin;
        for axis in 0..3 {
            origin += self.rise[axis].to_f64() * f64::from(key[axis]) * BLOCK as f64;
        }
        let mut height = number.of(origin);
        for axis in 0..3 {
            height = number.all(self.rise[axis]).mul_add(position[axis], height);
        }
        ChunkZone {
            height,
            normal: [0, 1, 2].map(|axis| number.all(self.normal[axis])),
            width: number.all(self.width),
        }
    }
}

/// Zones of the points of a chunk, each at a plane of its own.
pub struct ChunkZone<S: Simd, R: Real> {
    /// Heights above the planes [m].
    height: R::Vector<S>,
    /// Unit normals.
    normal: [R::Vector<S>; 3],
    /// Node distances across the planes [m].
    width: R::Vector<S>,
}

impl<S: Simd, R: Real> ChunkZone<S, R> {
    /// Removes the part towards the plane from the shifts [cells] of points near it; of points
    /// deep behind it also cancels the part of their motion `moved` [cells] into it, and removes
    /// the part of their velocities [m/s] into it. `spacing` is that of the nodes [m].
    #[inline(always)]
    pub fn keep_off(
        &self,
        simd: S,
        spacing: &Vec3,
        moved: &[R::Vector<S>; 3],
        shift: &mut [R::Vector<S>; 3],
        velocity: &mut [R::Vector<S>; 3],
    ) {
        let number = Splat::<S, R>::new(simd);
        let none = number.of(0.0);
        let (mut along, mut went, mut goes) = (none, none, none);
        for axis in 0..3 {
            let normal = self.normal[axis];
            let rise = normal * number.of(spacing[axis]);
            along = rise.mul_add(shift[axis], along);
            went = rise.mul_add(moved[axis], went);
            goes = normal.mul_add(velocity[axis], goes);
        }
        let [near, deep] = [
            METHOD.redistribution.no_shift_height,
            -METHOD.redistribution.deepest_penetration,
        ]
        .map(|cells| self.height.simd_lt(number.of(cells) * self.width));
        let into = near.select((none - along).max(none), none);
        let into = into + deep.select((none - went).max(none), none);
        let stop = deep.select((none - goes).max(none), none);
        for axis in 0..3 {
            let normal = self.normal[axis];
            let out = normal * number.of(1.0 / spacing[axis]);
            shift[axis] = out.mul_add(into, shift[axis]);
            velocity[axis] = normal.mul_add(stop, velocity[axis]);
        }
    }
}

/// Zones on a terrain: that of each point at the plane that touches the terrain there.
#[derive(Debug, Clone, Copy)]
pub struct TerrainZone<'a> {
    ground: &'a HeightField,
    lattice: &'a Lattice,
}

impl<'a> TerrainZone<'a> {
    /// Zones on this ground.
    pub fn of(ground: &'a HeightField, lattice: &'a Lattice) -> Self {
        Self { ground, lattice }
    }

    /// Zones in a block; `None` if none of its points may lie in one.
    pub fn in_block<R: Real>(&self, key: &BlockKey) -> Option<BlockZone<'a, R>> {
        let lattice = Lattice {
            origin: self.lattice.position(first_node(*key)),
            ..*self.lattice
        };
        let lid = self.ground.lid_over([key[0], key[1]], self.lattice);
        let zone = BlockZone::under(&lid, self.ground, lattice);
        zone.may_hold_a_point().then_some(zone)
    }
}

/// Rounding of positions [cells].
const ROUNDING: f64 = 1e-3;

/// Zones of the points of a block on a terrain.
#[derive(Debug, Clone, Copy)]
pub struct BlockZone<'a, R> {
    ground: &'a HeightField,
    /// Lattice from the block's corner.
    lattice: Lattice,
    /// Height of a position [cells] above a plane over all zones [m].
    rise: [R; 3],
    /// The same of the block's corner [m].
    origin: R,
    /// True if there may be a cliff.
    is_at_cliff: bool,
}

impl<'a, R: Real> BlockZone<'a, R> {
    /// Zones in a block under a lid on the surface; the block's corner is the lattice's origin.
    fn under(lid: &Lid, ground: &'a HeightField, lattice: Lattice) -> Self {
        let Lattice { origin, spacing } = lattice;
        // Along the vertical a zone is higher than along the normal.
        let near = METHOD.redistribution.no_shift_height * 1f64.hypot(lid.steepest);
        let height = (near + ROUNDING) * spacing.max();
        let over = lid.elevation(origin.x, origin.y) + height;
        let [along, across] = lid.slope;
        let rise = Vec3::new(-along, -across, 1.0).component_mul(&spacing);
        Self {
            ground,
            lattice,
            rise: [0, 1, 2].map(|axis| R::of(rise[axis])),
            origin: R::of(origin.z - over),
            is_at_cliff: lid.steepest > METHOD.boundary.steep,
        }
    }

    /// True if a point of the block may lie in its zone.
    fn may_hold_a_point(&self) -> bool {
        let lowest = self.rise.map(|rise| {
            let rise = rise.to_f64();
            let Range { start, end } = POSITIONS_IN_STEP;
            rise * if rise > 0.0 { start } else { end }
        });
        self.origin.to_f64() + lowest.iter().sum::<f64>() <= 0.0
    }

    /// Zones of the points of a chunk, at these positions [cells]; `None` if none of them lies in
    /// its zone.
    #[inline(always)]
    pub fn of_chunk<S: Simd>(
        &self,
        simd: S,
        position: &[R::Vector<S>; 3],
    ) -> Option<ChunkZone<S, R>> {
        let number = Splat::<S, R>::new(simd);
        let mut above = number.all(self.origin);
        for axis in 0..3 {
            above = number.all(self.rise[axis]).mul_add(position[axis], above);
        }
        let above = above.to_array();
        let may_be_in = |lane: usize| above.as_ref()[lane] <= R::ZERO;
        if !(0..R::LANES).any(may_be_in) {
            return None;
        }
        let at = position.map(|along| along.to_array());
        let (mut height, mut normal) = (R::ZEROS, [R::ZEROS; 3]);
        for lane in (0..R::LANES).filter(|lane| may_be_in(*lane)) {
            let (above, up) = self.over_ground(at.each_ref().map(|along| along[lane]));
            height[lane] = R::of(above);
            for axis in 0..3 {
                normal[axis][lane] = R::of(up[axis]);
            }
        }
        // Of the others height and width are zero: they are not in their zones.
        let normal = load_each::<S, R, 3>(simd, &normal);
        let mut square = number.of(0.0);
        for axis in 0..3 {
            let rise = normal[axis] * number.of(self.lattice.spacing[axis]);
            square = rise.mul_add(rise, square);
        }
        Some(ChunkZone {
            height: load::<S, R>(simd, &height),
            normal,
            width: square.sqrt(),
        })
    }

    /// Height of a point at this position [cells] in the block above the plane of its zone [m], and
    /// that plane's normal.
    fn over_ground(&self, position: [R; 3]) -> (f64, Vec3) {
        let cells = Vec3::from(position.map(Real::to_f64));
        let place = self.lattice.origin + cells.component_mul(&self.lattice.spacing);
        let (height, normal) = self.ground.over_touching(&place);
        let deep = METHOD.redistribution.deepest_penetration * self.lattice.spacing.max();
        if self.is_at_cliff && height < -deep * normal.z {
            // At its foot the ground is nearer than the face, which rises overhead.
            let nearest = self.ground.nearest_plane(&place);
            return (nearest.height(&place), nearest.normal);
        }
        (height, normal)
    }
}

#[cfg(test)]
mod tests;
