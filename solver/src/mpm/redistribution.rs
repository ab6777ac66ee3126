//! Particle redistribution: points kept evenly spread, and their volumes true to the volume
//! available to them (docs/method.md, equations 39–42c).
//!
//! The volume of a point follows the velocity gradient along its path, which does not show
//! where points gather. In long shear they gather, the volumes scatter,
//! and the flow settles into less volume than the sum of its points'. So once per step the
//! volumetric strains are smoothed over the grid, points are shifted away from crowds, and the
//! pressure of points in a crowd is raised, so that it drives them apart.

use super::chunk::Chunk;
use super::lanes::{Real, Splat, load};
use crate::bed::{Bed, HeightField};
use crate::grid::{BLOCK, BlockKey};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::walls::{Impulse, Plane, in_plane};
use fearless_simd::prelude::*;

/// Rates of a step, by its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RedistributionRates {
    /// Shift over −h² ∇excess volume fraction.
    pub shift: f64,
    /// Share of its own compressive strain that a point exchanges for the mean.
    pub volumetric_smoothing: f64,
    /// Relative rise of pressure per excess volume fraction.
    pub pressure_correction: f64,
    /// Travel from which on a point is fully redistributed [cells].
    pub full_travel: f64,
}

impl RedistributionRates {
    /// None at all: an elastic body keeps its points.
    pub const NONE: Self = Self {
        shift: 0.0,
        volumetric_smoothing: 0.0,
        pressure_correction: 0.0,
        full_travel: 0.0,
    };

    /// Rates after a step in which the fastest point could travel so many cells.
    pub fn after(travel: f64) -> Self {
        Self {
            shift: METHOD.redistribution.shift * travel,
            volumetric_smoothing: (METHOD.redistribution.volumetric_smoothing * travel).min(1.0),
            pressure_correction: METHOD.redistribution.pressure_correction * travel,
            full_travel: METHOD.redistribution.slow * travel,
        }
    }
}

/// Changes of the points' sums by redistribution; a shift leaves the velocity unchanged.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Shifting {
    /// Σ m δx [kg m].
    pub first_moment: Vec3,
    /// Σ m δx × v [N m s].
    pub angular: Vec3,
    /// Impulse of the bed on points deep behind it.
    pub stopped: Impulse,
}

impl Shifting {
    /// Sum of both.
    pub fn plus(self, other: &Self) -> Self {
        Self {
            first_moment: self.first_moment + other.first_moment,
            angular: self.angular + other.angular,
            stopped: self.stopped.plus(&other.stopped),
        }
    }

    /// Sum of so many images, which lie symmetrically about the plane y = 0; a single one
    /// is unchanged.
    pub fn of_images(&self, count: f64) -> Self {
        if count == 1.0 {
            return *self;
        }
        Self {
            first_moment: in_plane(&self.first_moment) * count,
            angular: Vec3::new(0.0, self.angular.y * count, 0.0),
            stopped: self.stopped.of_images(count),
        }
    }
}

/// State of the points of a chunk, and of the nodes around them.
pub struct PointState<S: Simd, R: Real> {
    /// Volumetric strain φ after the last sub-step.
    pub volumetric_strain: R::Vector<S>,
    /// Compressive part min(φ, 0) at the transfer.
    pub compression_at_transfer: R::Vector<S>,
    /// Mean of that over the nodes.
    pub mean_compression: R::Vector<S>,
    /// Excess volume fraction of the nodes round the point.
    pub excess_volume_fraction: R::Vector<S>,
    /// Gradient of that [1/cell].
    pub slope: [R::Vector<S>; 3],
}

/// Changes of the points of a chunk.
pub struct RedistributedPoint<S: Simd, R: Real> {
    /// Shift [cells].
    pub shift: [R::Vector<S>; 3],
    /// Volumetric strain φ after it.
    pub volumetric_strain: R::Vector<S>,
    /// Rise of the stress, as a share of itself.
    pub rise: R::Vector<S>,
}

/// Redistributes points that travelled so far [cells] (equations 40 to 42).
#[inline(always)]
pub fn redistribute<S: Simd, R: Real>(
    simd: S,
    redistribution: &RedistributionRates,
    seen: &PointState<S, R>,
    travel: &[R::Vector<S>; 3],
) -> RedistributedPoint<S, R> {
    let number = Splat::<S, R>::new(simd);
    let (none, one) = (number.of(0.0), number.of(1.0));
    let least = number.of(R::SMALLEST);
    let full = number.of(redistribution.full_travel).max(least);
    let share = (length::<S, R>(travel) / full).min(one);
    let degree = share * share;
    let pull = number.of(-redistribution.shift) * degree;
    let mut shift = seen.slope;
    for along in &mut shift {
        *along *= pull;
    }
    let largest = number.of(METHOD.redistribution.largest_shift);
    let shorter = (largest / length::<S, R>(&shift).max(least)).min(one);
    for along in &mut shift {
        *along *= shorter;
    }
    let pressed = (number.of(redistribution.pressure_correction) * seen.excess_volume_fraction)
        .min(number.of(METHOD.redistribution.largest_rise));
    let rise = degree * pressed;
    let exchanged = number.of(redistribution.volumetric_smoothing)
        * (seen.mean_compression - seen.compression_at_transfer);
    let averaged = degree.mul_add(exchanged, seen.volumetric_strain);
    let compression = (none - averaged).max(none);
    RedistributedPoint {
        shift,
        volumetric_strain: averaged - rise * compression,
        rise,
    }
}

#[inline(always)]
fn length<S: Simd, R: Real>(v: &[R::Vector<S>; 3]) -> R::Vector<S> {
    v[0].mul_add(v[0], v[1].mul_add(v[1], v[2] * v[2])).sqrt()
}

/// Zone at a plane of the bed in which no point is shifted towards it, and none deep behind it is
/// moved farther behind it (equations 42b and 42c).
#[derive(Debug, Clone, Copy)]
pub struct NoShiftZone<R> {
    /// Height of a place [m] over its position [cells].
    rise: [R; 3],
    /// Height of the origin of positions [m].
    origin: f64,
    /// Normal over node distance [1/m].
    out: [R; 3],
    /// Unit normal.
    normal: [R; 3],
    /// Height below which no point is shifted towards the plane [m].
    near: R,
    /// Height below which no point is moved deeper [m].
    deep: R,
}

impl<R: Real> NoShiftZone<R> {
    /// Zone at a plane, for positions from the lattice's origin.
    pub fn of(plane: &Plane, lattice: &Lattice) -> Self {
        let spacing = &lattice.spacing;
        let rise = plane.normal.component_mul(spacing);
        Self {
            rise: [0, 1, 2].map(|axis| R::of(rise[axis])),
            origin: plane.height(&lattice.origin),
            out: [0, 1, 2].map(|axis| R::of(plane.normal[axis] / spacing[axis])),
            normal: [0, 1, 2].map(|axis| R::of(plane.normal[axis])),
            near: R::of(METHOD.redistribution.no_shift_height * rise.norm()),
            deep: R::of(-METHOD.redistribution.deepest_penetration * rise.norm()),
        }
    }

    /// Zone for the points of a chunk in a block.
    #[inline(always)]
    pub fn in_block<S: Simd>(&self, simd: S, key: &BlockKey) -> ChunkZone<S, R> {
        let number = Splat::<S, R>::new(simd);
        let mut origin = self.origin;
        for axis in 0..3 {
            origin += self.rise[axis].to_f64() * f64::from(key[axis]) * BLOCK as f64;
        }
        ChunkZone {
            rise: [0, 1, 2].map(|axis| number.all(self.rise[axis])),
            origin: number.of(origin),
            out: [0, 1, 2].map(|axis| number.all(self.out[axis])),
            normal: [0, 1, 2].map(|axis| number.all(self.normal[axis])),
            near: number.all(self.near),
            deep: number.all(self.deep),
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

    /// Height above the ground up to which points of a block may be in them [m]; `None` if none of
    /// them comes so near.
    pub fn height_in(&self, key: &BlockKey) -> Option<f64> {
        let spacing = self.lattice.spacing;
        // A point that has left its block in the step is still among its points.
        let low = self.lattice.position(key.map(|along| along * BLOCK as i32)) - spacing * 0.5;
        let high = low + spacing * (BLOCK as f64 + 2.0);
        let (highest, steepest) = (self.ground.surface()).bounds([low.x, low.y], [high.x, high.y]);
        // Along the vertical a zone is higher than along the normal.
        let near = METHOD.redistribution.no_shift_height * spacing.max();
        let height = near * 1f64.hypot(steepest);
        (low.z - highest <= height).then_some(height)
    }

    /// Zones of the points of a chunk, at these positions [cells], up to a height [m]; `None` if none
    /// of them lies in its zone.
    #[inline(always)]
    pub fn in_block<S: Simd, R: Real>(
        &self,
        simd: S,
        (key, height): (&BlockKey, f64),
        position: &[R::Vector<S>; 3],
    ) -> Option<ChunkZone<S, R>> {
        let at = position.map(|along| along.to_array());
        let corner = self.lattice.position(key.map(|along| along * BLOCK as i32));
        let mut near_by = false;
        for lane in 0..R::LANES {
            let place = self.place(&corner, at.each_ref().map(|along| along.as_ref()[lane]));
            near_by |= place.z - self.ground.elevation(place.x, place.y) <= height;
        }
        if !near_by {
            return None;
        }
        let (mut rise, mut out, mut normal) = ([R::ZEROS; 3], [R::ZEROS; 3], [R::ZEROS; 3]);
        let [mut origin, mut near, mut deep] = [R::ZEROS; 3];
        for lane in 0..R::LANES {
            let position = at.each_ref().map(|along| along.as_ref()[lane]);
            let zone = self.at(&corner, position);
            for axis in 0..3 {
                rise[axis].as_mut()[lane] = zone.rise[axis];
                out[axis].as_mut()[lane] = zone.out[axis];
                normal[axis].as_mut()[lane] = zone.normal[axis];
            }
            origin.as_mut()[lane] = R::of(zone.origin);
            near.as_mut()[lane] = zone.near;
            deep.as_mut()[lane] = zone.deep;
        }
        let all = |lanes: &[R::Lanes; 3]| [0, 1, 2].map(|axis| load::<S, R>(simd, &lanes[axis]));
        Some(ChunkZone {
            rise: all(&rise),
            origin: load::<S, R>(simd, &origin),
            out: all(&out),
            normal: all(&normal),
            near: load::<S, R>(simd, &near),
            deep: load::<S, R>(simd, &deep),
        })
    }

    /// Place of a position in the block with this origin [m].
    fn place<R: Real>(&self, origin: &Vec3, position: [R; 3]) -> Vec3 {
        let cells = Vec3::from(position.map(Real::to_f64));
        origin + cells.component_mul(&self.lattice.spacing)
    }

    /// Zone of a point at this position in the block with this origin [m], for positions in it.
    fn at<R: Real>(&self, origin: &Vec3, position: [R; 3]) -> NoShiftZone<R> {
        let place = self.place(origin, position);
        let plane = self.ground.tangent(place.x, place.y);
        let here = Lattice {
            origin: *origin,
            ..*self.lattice
        };
        NoShiftZone::of(&plane, &here)
    }
}

/// Zones of the points of a chunk.
pub struct ChunkZone<S: Simd, R: Real> {
    rise: [R::Vector<S>; 3],
    origin: R::Vector<S>,
    out: [R::Vector<S>; 3],
    normal: [R::Vector<S>; 3],
    near: R::Vector<S>,
    deep: R::Vector<S>,
}

impl<S: Simd, R: Real> ChunkZone<S, R> {
    /// Removes the part towards the plane from the shifts [cells] of points near it; of points
    /// deep behind it also cancels the part of their motion `moved` [cells] into it, and removes
    /// the part of their velocities [m/s] into it.
    #[inline(always)]
    pub fn keep_off(
        &self,
        simd: S,
        position: &[R::Vector<S>; 3],
        moved: &[R::Vector<S>; 3],
        shift: &mut [R::Vector<S>; 3],
        velocity: &mut [R::Vector<S>; 3],
    ) {
        let number = Splat::<S, R>::new(simd);
        let none = number.of(0.0);
        let mut height = self.origin;
        let (mut along, mut went, mut goes) = (none, none, none);
        for axis in 0..3 {
            let rise = self.rise[axis];
            height = rise.mul_add(position[axis], height);
            along = rise.mul_add(shift[axis], along);
            went = rise.mul_add(moved[axis], went);
            let normal = self.normal[axis];
            goes = normal.mul_add(velocity[axis], goes);
        }
        let near = height.simd_lt(self.near);
        let deep = height.simd_lt(self.deep);
        let into = near.select((none - along).max(none), none);
        let into = into + deep.select((none - went).max(none), none);
        for axis in 0..3 {
            shift[axis] = self.out[axis].mul_add(into, shift[axis]);
        }
        let stop = deep.select((none - goes).max(none), none);
        for axis in 0..3 {
            let normal = self.normal[axis];
            velocity[axis] = normal.mul_add(stop, velocity[axis]);
        }
    }
}

/// Changes of a block's sums by the redistribution of its points, chunk by chunk.
pub struct ShiftingSums<R: Real> {
    first_moment: [R::Lanes; 3],
    angular: [R::Lanes; 3],
    /// Impulse of the walls on points deep behind them, and its moment about the
    /// block's origin.
    stopped: [[R::Lanes; 3]; 2],
}

impl<R: Real> ShiftingSums<R> {
    /// Sums without points.
    pub const NONE: Self = Self {
        first_moment: [R::ZEROS; 3],
        angular: [R::ZEROS; 3],
        stopped: [[R::ZEROS; 3]; 2],
    };

    /// Adds a chunk whose points the bed changed in velocity [m/s] at these positions [cells].
    #[inline(always)]
    pub fn stop<S: Simd>(
        &mut self,
        simd: S,
        chunk: &Chunk<R>,
        position: &[R::Vector<S>; 3],
        change: &[R::Vector<S>; 3],
        spacing: &Vec3,
    ) {
        let number = Splat::<S, R>::new(simd);
        let mass = load::<S, R>(simd, &chunk.mass);
        let (mut given, mut arm) = (*change, *position);
        for axis in 0..3 {
            given[axis] *= mass;
            arm[axis] *= number.of(spacing[axis]);
        }
        for (sums, added) in self
            .stopped
            .iter_mut()
            .zip([given, cross::<S, R>(&arm, &given)])
        {
            add::<S, R>(simd, sums, &added);
        }
    }

    /// Adds a chunk shifted by so many cells.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        chunk: &Chunk<R>,
        shift: &[R::Vector<S>; 3],
        velocity: &[R::Vector<S>; 3],
        spacing: &Vec3,
    ) {
        let number = Splat::<S, R>::new(simd);
        let mass = load::<S, R>(simd, &chunk.mass);
        let mut moved = *shift;
        for axis in 0..3 {
            moved[axis] *= number.of(spacing[axis]) * mass;
        }
        add::<S, R>(simd, &mut self.first_moment, &moved);
        add::<S, R>(simd, &mut self.angular, &cross::<S, R>(&moved, velocity));
    }

    /// Sums of a block with this origin [m].
    pub fn total(&self, origin: &Vec3) -> Shifting {
        let [linear, about_block] = self.stopped.each_ref().map(total::<R>);
        Shifting {
            first_moment: total::<R>(&self.first_moment),
            angular: total::<R>(&self.angular),
            stopped: Impulse {
                linear,
                angular: about_block + origin.cross(&linear),
            },
        }
    }
}

#[inline(always)]
fn cross<S: Simd, R: Real>(a: &[R::Vector<S>; 3], b: &[R::Vector<S>; 3]) -> [R::Vector<S>; 3] {
    let ([ax, ay, az], [bx, by, bz]) = (*a, *b);
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[inline(always)]
fn add<S: Simd, R: Real>(simd: S, sums: &mut [R::Lanes; 3], added: &[R::Vector<S>; 3]) {
    for axis in 0..3 {
        sums[axis] = (load::<S, R>(simd, &sums[axis]) + added[axis]).to_array();
    }
}

fn total<R: Real>(sums: &[R::Lanes; 3]) -> Vec3 {
    let sum = |of: &R::Lanes| of.as_ref().iter().map(|part| part.to_f64()).sum();
    Vec3::new(sum(&sums[0]), sum(&sums[1]), sum(&sums[2]))
}

#[cfg(test)]
mod tests;
