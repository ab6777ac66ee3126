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
use crate::math::Vec3;
use crate::method::METHOD;
use crate::walls::{Impulse, in_plane};
use fearless_simd::prelude::*;

mod no_shift;

pub use no_shift::{NoShiftZone, TerrainZone};

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
