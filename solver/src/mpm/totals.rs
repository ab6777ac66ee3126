//! Sums over the points of a block, in double precision.

use super::blocks::{Block, End, is_settled};
use super::chunk::Chunk;
use super::lanes::{Real, Splat, load, load_each};
use super::packing::Packing;
use crate::diagnostics::Totals;
use crate::grid::BLOCK;
use crate::math::Vec3;
use crate::walls::Impulse;
use fearless_simd::prelude::*;

/// Sums over chunks, lane by lane, so that all points of a chunk are added at once.
struct Sums<R: Real> {
    mass: R::Sums,
    first_moment: [R::Sums; 3],
    momentum: [R::Sums; 3],
    angular: [R::Sums; 3],
    momentum_scale: R::Sums,
    kinetic: R::Sums,
    elastic: R::Sums,
}

impl<R: Real> Sums<R> {
    const NONE: Self = Self {
        mass: R::NO_SUMS,
        first_moment: [R::NO_SUMS; 3],
        momentum: [R::NO_SUMS; 3],
        angular: [R::NO_SUMS; 3],
        momentum_scale: R::NO_SUMS,
        kinetic: R::NO_SUMS,
        elastic: R::NO_SUMS,
    };
}

/// Sums over the points of a block, between two steps.
#[inline(always)]
pub fn of_block<R: Real>(block: &Block<R>, packing: &Packing, gravity: &Vec3) -> Totals {
    let mut sums = Sums::NONE;
    let first = packing.position(&block.key, &[R::ZERO; 3]);
    for (chunk, _) in block.chunks() {
        add_motion(&mut sums, chunk, packing, &first);
        add_elastic(&mut sums, chunk, packing);
    }
    let total = |sum: &R::Sums| sum.as_ref().iter().sum::<f64>();
    let vector = |sums: &[R::Sums; 3]| Vec3::new(total(&sums[0]), total(&sums[1]), total(&sums[2]));
    let first_moment = vector(&sums.first_moment);
    let kinetic_energy = total(&sums.kinetic);
    Totals {
        mass: total(&sums.mass),
        first_moment,
        momentum: Impulse {
            linear: vector(&sums.momentum),
            angular: vector(&sums.angular),
        },
        momentum_scale: total(&sums.momentum_scale),
        kinetic_energy,
        energy: kinetic_energy - gravity.dot(&first_moment) + total(&sums.elastic),
    }
}

#[inline(always)]
fn add_motion<R: Real>(sums: &mut Sums<R>, chunk: &Chunk<R>, packing: &Packing, first: &Vec3) {
    let spacing = packing.lattice.spacing;
    let moment = packing.lattice.kernel_moment();
    for lane in 0..R::LANES {
        let m = chunk.mass[lane].to_f64();
        let at = |axis: usize| first[axis] + spacing[axis] * chunk.position[axis][lane].to_f64();
        let c = |row: usize, column: usize| chunk.gradient[column][row][lane].to_f64();
        let (x, y, z) = (at(0), at(1), at(2));
        let [vx, vy, vz] = [0, 1, 2].map(|axis| chunk.velocity[axis][lane].to_f64());
        sums.mass[lane] += m;
        sums.first_moment[0][lane] += m * x;
        sums.first_moment[1][lane] += m * y;
        sums.first_moment[2][lane] += m * z;
        sums.momentum[0][lane] += m * vx;
        sums.momentum[1][lane] += m * vy;
        sums.momentum[2][lane] += m * vz;
        // x × v and the spin of the affine motion, Σ_a (h_a²/4) e_a × C e_a.
        let spin = [
            moment.y * c(2, 1) - moment.z * c(1, 2),
            moment.z * c(0, 2) - moment.x * c(2, 0),
            moment.x * c(1, 0) - moment.y * c(0, 1),
        ];
        sums.angular[0][lane] += m * (y * vz - z * vy + spin[0]);
        sums.angular[1][lane] += m * (z * vx - x * vz + spin[1]);
        sums.angular[2][lane] += m * (x * vy - y * vx + spin[2]);
        let squared = vx * vx + vy * vy + vz * vz;
        let mut affine = 0.0;
        for column in 0..3 {
            let [a, b, d] = [c(0, column), c(1, column), c(2, column)];
            affine += moment[column] * (a * a + b * b + d * d);
        }
        sums.momentum_scale[lane] += m * squared.sqrt();
        sums.kinetic[lane] += 0.5 * m * (squared + affine);
    }
}

/// p²V/2K + τ²V/2G.
#[inline(always)]
fn add_elastic<R: Real>(sums: &mut Sums<R>, chunk: &Chunk<R>, packing: &Packing) {
    let material = &packing.material;
    let least = if material.is_granular() {
        0.0
    } else {
        f64::NEG_INFINITY
    };
    for lane in 0..R::LANES {
        let s = |part: usize| chunk.deviator[part][lane].to_f64();
        let volumetric_strain = chunk.volumetric_strain[lane].to_f64();
        let volume = chunk.mass[lane].to_f64() / material.bulk_density * (1.0 + volumetric_strain);
        let pressure =
            (-material.bulk_modulus * volumetric_strain / (1.0 + volumetric_strain)).max(least);
        let diagonal = s(0) * s(0) + s(1) * s(1) + s(2) * s(2);
        let off_diagonal = s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
        let shear = 0.5 * diagonal + off_diagonal;
        sums.elastic[lane] += 0.5
            * volume
            * (pressure * pressure / material.bulk_modulus + shear / material.shear_modulus);
    }
}

/// Knowledge of a block's points between two steps, found chunk by chunk.
pub struct EndSums<S: Simd, R: Real> {
    simd: S,
    squared: R::Vector<S>,
    flaw: R::Vector<S>,
    volumetric_strain: R::Vector<S>,
    /// Lowest and highest coordinates in the block [cells].
    lowest: R::Vector<S>,
    highest: R::Vector<S>,
}

impl<S: Simd, R: Real> EndSums<S, R> {
    /// Of no points.
    #[inline(always)]
    pub fn none(simd: S) -> Self {
        let number = Splat::<S, R>::new(simd);
        let (none, middle) = (number.of(0.0), number.of(0.5 + 0.5 * BLOCK as f64));
        Self {
            simd,
            squared: none,
            flaw: none,
            volumetric_strain: none,
            lowest: middle,
            highest: middle,
        }
    }

    /// Adds a chunk.
    #[inline(always)]
    pub fn add(&mut self, chunk: &Chunk<R>) {
        let simd = self.simd;
        let [x, y, z] = load_each::<S, R, 3>(simd, &chunk.velocity);
        let squared = x * x + y * y + z * z;
        self.squared = self.squared.max_precise(squared);
        let volumetric_strain = load::<S, R>(simd, &chunk.volumetric_strain);
        self.volumetric_strain = self.volumetric_strain.min_precise(volumetric_strain);
        // Zero times a number is zero, unless the number is non-finite.
        let none = Splat::<S, R>::new(simd).of(0.0);
        let mut flaw = (squared + volumetric_strain).mul_add(none, self.flaw);
        for of in &chunk.position {
            let coordinate = load::<S, R>(simd, of);
            self.lowest = self.lowest.min_precise(coordinate);
            self.highest = self.highest.max_precise(coordinate);
            flaw = coordinate.mul_add(none, flaw);
        }
        for of in chunk.velocity.iter().chain(&chunk.deviator) {
            flaw = load::<S, R>(simd, of).mul_add(none, flaw);
        }
        for of in chunk.gradient.iter().flatten() {
            flaw = load::<S, R>(simd, of).mul_add(none, flaw);
        }
        self.flaw = flaw;
    }

    /// Summary of the points.
    #[inline(always)]
    pub fn end(self) -> End<R> {
        let flaw = self.flaw.to_array();
        let finite = flaw.as_ref().iter().all(|sum| *sum == R::ZERO);
        let lowest = over::<R>(&self.lowest.to_array(), R::min);
        let highest = over::<R>(&self.highest.to_array(), R::max);
        End {
            fastest: over::<R>(&self.squared.to_array(), R::max).sqrt(),
            finite,
            lowest_dilation: over::<R>(&self.volumetric_strain.to_array(), R::min),
            left: !(finite && is_settled(lowest) && is_settled(highest)),
        }
    }
}

/// The extreme of the lanes.
fn over<R: Real>(lanes: &R::Lanes, extreme: fn(R, R) -> R) -> R {
    let lanes = lanes.as_ref();
    lanes.iter().copied().fold(lanes[0], extreme)
}

/// Knowledge of a block's points between two steps.
#[inline(always)]
pub fn end_of<S: Simd, R: Real>(simd: S, block: &Block<R>) -> End<R> {
    let mut sums = EndSums::none(simd);
    for (chunk, _) in block.chunks() {
        sums.add(chunk);
    }
    sums.end()
}
