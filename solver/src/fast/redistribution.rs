//! Particle redistribution, sixteen points at a time: the formulas of `redistribution.rs`.

use super::chunk::{Chunk, LANES, Lanes};
use crate::grid::{BLOCK, BlockKey};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::redistribution::{
    DEEPEST_PENETRATION, LARGEST_RISE, LARGEST_SHIFT, NO_SHIFT_HEIGHT, RedistributionRates,
    Shifting,
};
use crate::walls::{Impulse, Plane};
use fearless_simd::{f32x16, prelude::*};

/// State of points, and of the nodes at the points; as in `redistribution.rs`, but the slope
/// per cell.
pub struct PointState<S: Simd> {
    /// V ρ_c/m − 1 now.
    pub volumetric_strain: f32x16<S>,
    /// Its compressive part, min(φ, 0), at the transfer.
    pub compression_at_transfer: f32x16<S>,
    /// Its mean over the nodes.
    pub mean_compression: f32x16<S>,
    /// Excess volume fraction of the nodes round the point.
    pub excess_volume_fraction: f32x16<S>,
    /// Its gradient [1/cell].
    pub slope: [f32x16<S>; 3],
}

/// Changes of points.
pub struct RedistributedPoint<S: Simd> {
    /// Shift from their positions [cells].
    pub shift: [f32x16<S>; 3],
    /// Their volumetric strain.
    pub volumetric_strain: f32x16<S>,
    /// Relative rise of their stress.
    pub rise: f32x16<S>,
}

/// Changes of points that travelled this far [cells].
#[inline(always)]
pub fn redistribute<S: Simd>(
    simd: S,
    redistribution: &RedistributionRates,
    seen: &PointState<S>,
    travel: &[f32x16<S>; 3],
) -> RedistributedPoint<S> {
    let (none, one) = (splat(simd, 0.0), splat(simd, 1.0));
    let least = splat(simd, f64::from(f32::MIN_POSITIVE));
    let full = splat(simd, redistribution.full_travel).max(least);
    let share = (length(travel) / full).min(one);
    let degree = share * share;
    let pull = splat(simd, -redistribution.shift) * degree;
    let mut shift = seen.slope;
    for along in &mut shift {
        *along *= pull;
    }
    let largest = splat(simd, LARGEST_SHIFT);
    let shorter = (largest / length(&shift).max(least)).min(one);
    for along in &mut shift {
        *along *= shorter;
    }
    let pressed = (splat(simd, redistribution.pressure_correction) * seen.excess_volume_fraction)
        .min(splat(simd, LARGEST_RISE));
    let rise = degree * pressed;
    let exchanged = splat(simd, redistribution.volumetric_smoothing)
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
fn length<S: Simd>(v: &[f32x16<S>; 3]) -> f32x16<S> {
    v[0].mul_add(v[0], v[1].mul_add(v[1], v[2] * v[2])).sqrt()
}

#[inline(always)]
fn splat<S: Simd>(simd: S, value: f64) -> f32x16<S> {
    f32x16::splat(simd, value as f32)
}

/// A plane of the bed: no point near it is shifted towards it, and none deep behind it
/// penetrates further (`redistribution::limit_shift_at_bed`).
#[derive(Debug, Clone, Copy)]
pub struct NoShiftZone {
    /// Height of a place [m] over its position [cells].
    rise: [f32; 3],
    /// Height of the origin of positions [m].
    origin: f64,
    /// Normal over node distance [1/m].
    out: [f32; 3],
    /// Unit normal.
    normal: [f32; 3],
    /// Height of the no-shift zone [m].
    near: f32,
    /// Height below which points do not penetrate further [m].
    deep: f32,
}

impl NoShiftZone {
    /// Zone of a plane, for positions from the lattice's origin.
    pub fn of(plane: &Plane, lattice: &Lattice) -> Self {
        let spacing = &lattice.spacing;
        let rise = plane.normal.component_mul(spacing);
        Self {
            rise: [rise.x as f32, rise.y as f32, rise.z as f32],
            origin: plane.height(&lattice.origin),
            out: [0, 1, 2].map(|axis| (plane.normal[axis] / spacing[axis]) as f32),
            normal: [0, 1, 2].map(|axis| plane.normal[axis] as f32),
            near: (NO_SHIFT_HEIGHT * rise.norm()) as f32,
            deep: (-DEEPEST_PENETRATION * rise.norm()) as f32,
        }
    }

    /// Zone for positions in a block.
    pub fn in_block(&self, key: &BlockKey) -> Self {
        let mut here = *self;
        for axis in 0..3 {
            here.origin += f64::from(self.rise[axis]) * f64::from(key[axis]) * BLOCK as f64;
        }
        here
    }

    /// Removes the component into the plane from shifts [cells] of points near it; for points deep
    /// behind it also from their displacement `moved`, and from their velocities [m/s].
    #[inline(always)]
    pub fn keep_off<S: Simd>(
        &self,
        simd: S,
        position: &[f32x16<S>; 3],
        moved: &[f32x16<S>; 3],
        shift: &mut [f32x16<S>; 3],
        velocity: &mut [f32x16<S>; 3],
    ) {
        let none = f32x16::splat(simd, 0.0);
        let mut height = f32x16::splat(simd, self.origin as f32);
        let (mut along, mut went, mut goes) = (none, none, none);
        for axis in 0..3 {
            let rise = f32x16::splat(simd, self.rise[axis]);
            height = rise.mul_add(position[axis], height);
            along = rise.mul_add(shift[axis], along);
            went = rise.mul_add(moved[axis], went);
            let normal = f32x16::splat(simd, self.normal[axis]);
            goes = normal.mul_add(velocity[axis], goes);
        }
        let near = height.simd_lt(f32x16::splat(simd, self.near));
        let deep = height.simd_lt(f32x16::splat(simd, self.deep));
        let into = near.select((none - along).max(none), none);
        let into = into + deep.select((none - went).max(none), none);
        for axis in 0..3 {
            shift[axis] = f32x16::splat(simd, self.out[axis]).mul_add(into, shift[axis]);
        }
        let stop = deep.select((none - goes).max(none), none);
        for axis in 0..3 {
            let normal = f32x16::splat(simd, self.normal[axis]);
            velocity[axis] = normal.mul_add(stop, velocity[axis]);
        }
    }
}

/// Changes of a block's sums by redistribution of its points, chunk by chunk.
pub struct ShiftingSums {
    first_moment: [Lanes; 3],
    angular: [Lanes; 3],
    /// Impulse of the walls on points deep behind them, and its moment about the
    /// block's origin.
    stopped: [[Lanes; 3]; 2],
}

impl ShiftingSums {
    /// Sums of no points.
    pub const NONE: Self = Self {
        first_moment: [[0.0; LANES]; 3],
        angular: [[0.0; LANES]; 3],
        stopped: [[[0.0; LANES]; 3]; 2],
    };

    /// Adds a chunk whose velocities [m/s] were changed by the walls at these positions [cells].
    #[inline(always)]
    pub fn stop<S: Simd>(
        &mut self,
        simd: S,
        chunk: &Chunk,
        position: &[f32x16<S>; 3],
        change: &[f32x16<S>; 3],
        spacing: &Vec3,
    ) {
        let mass = f32x16::simd_from(simd, chunk.mass);
        let (mut given, mut arm) = (*change, *position);
        for axis in 0..3 {
            given[axis] *= mass;
            arm[axis] *= splat(simd, spacing[axis]);
        }
        for (sums, added) in self.stopped.iter_mut().zip([given, cross(&arm, &given)]) {
            add(simd, sums, &added);
        }
    }

    /// Adds a chunk, shifted by so many cells.
    #[inline(always)]
    pub fn add<S: Simd>(
        &mut self,
        simd: S,
        chunk: &Chunk,
        shift: &[f32x16<S>; 3],
        velocity: &[f32x16<S>; 3],
        spacing: &Vec3,
    ) {
        let mass = f32x16::simd_from(simd, chunk.mass);
        let mut moved = *shift;
        for axis in 0..3 {
            moved[axis] *= splat(simd, spacing[axis]) * mass;
        }
        add(simd, &mut self.first_moment, &moved);
        add(simd, &mut self.angular, &cross(&moved, velocity));
    }

    /// The sums of a block with this origin [m].
    pub fn total(&self, origin: &Vec3) -> Shifting {
        let [linear, about_block] = self.stopped.each_ref().map(total);
        Shifting {
            first_moment: total(&self.first_moment),
            angular: total(&self.angular),
            stopped: Impulse {
                linear,
                angular: about_block + origin.cross(&linear),
            },
        }
    }
}

#[inline(always)]
fn cross<S: Simd>(a: &[f32x16<S>; 3], b: &[f32x16<S>; 3]) -> [f32x16<S>; 3] {
    let ([ax, ay, az], [bx, by, bz]) = (*a, *b);
    [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx]
}

#[inline(always)]
fn add<S: Simd>(simd: S, sums: &mut [Lanes; 3], added: &[f32x16<S>; 3]) {
    for axis in 0..3 {
        sums[axis] = (f32x16::simd_from(simd, sums[axis]) + added[axis]).into();
    }
}

fn total(sums: &[Lanes; 3]) -> Vec3 {
    let sum = |of: &Lanes| of.iter().map(|part| f64::from(*part)).sum();
    Vec3::new(sum(&sums[0]), sum(&sums[1]), sum(&sums[2]))
}
