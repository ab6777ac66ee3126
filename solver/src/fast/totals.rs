//! Sums over the points of a block, in double precision: the formulas of
//! `points.rs` and `diagnostics.rs`.

use super::blocks::{Block, End};
use super::chunk::{Chunk, LANES, Lanes};
use super::packing::Packing;
use crate::diagnostics::Totals;
use crate::math::Vec3;
use crate::walls::Impulse;

/// One sum, lane by lane.
type Sum = [f64; LANES];

/// Sums over chunks, lane by lane, so that sixteen points are added at once.
struct Sums {
    mass: Sum,
    first_moment: [Sum; 3],
    momentum: [Sum; 3],
    angular: [Sum; 3],
    momentum_scale: Sum,
    kinetic: Sum,
    elastic: Sum,
}

impl Sums {
    const NONE: Self = Self {
        mass: [0.0; LANES],
        first_moment: [[0.0; LANES]; 3],
        momentum: [[0.0; LANES]; 3],
        angular: [[0.0; LANES]; 3],
        momentum_scale: [0.0; LANES],
        kinetic: [0.0; LANES],
        elastic: [0.0; LANES],
    };
}

/// Sums over the points of a block, between two steps.
#[inline(always)]
pub fn of_block(block: &Block, packing: &Packing, gravity: &Vec3) -> Totals {
    let mut sums = Sums::NONE;
    let first = packing.position(&block.key, &[0.0; 3]);
    for (chunk, _) in block.chunks() {
        add_motion(&mut sums, chunk, packing, &first);
        add_elastic(&mut sums, chunk, packing);
    }
    let total = |sum: &Sum| sum.iter().sum::<f64>();
    let vector = |sums: &[Sum; 3]| Vec3::new(total(&sums[0]), total(&sums[1]), total(&sums[2]));
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
fn add_motion(sums: &mut Sums, chunk: &Chunk, packing: &Packing, first: &Vec3) {
    let spacing = packing.lattice.spacing;
    let moment = packing.lattice.kernel_moment();
    for lane in 0..LANES {
        let m = f64::from(chunk.mass[lane]);
        let at = |axis: usize| first[axis] + spacing[axis] * f64::from(chunk.position[axis][lane]);
        let c = |row: usize, column: usize| f64::from(chunk.gradient[column][row][lane]);
        let (x, y, z) = (at(0), at(1), at(2));
        let [vx, vy, vz] = [0, 1, 2].map(|axis| f64::from(chunk.velocity[axis][lane]));
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
fn add_elastic(sums: &mut Sums, chunk: &Chunk, packing: &Packing) {
    let material = &packing.material;
    for lane in 0..LANES {
        let s = |part: usize| f64::from(chunk.deviator[part][lane]);
        let volumetric_strain = f64::from(chunk.volumetric_strain[lane]);
        let volume =
            f64::from(chunk.mass[lane]) / material.bulk_density * (1.0 + volumetric_strain);
        let pressure =
            (-material.bulk_modulus * volumetric_strain / (1.0 + volumetric_strain)).max(0.0);
        let diagonal = s(0) * s(0) + s(1) * s(1) + s(2) * s(2);
        let off_diagonal = s(3) * s(3) + s(4) * s(4) + s(5) * s(5);
        let shear = 0.5 * diagonal + off_diagonal;
        sums.elastic[lane] += 0.5
            * volume
            * (pressure * pressure / material.bulk_modulus + shear / material.shear_modulus);
    }
}

/// Summary of a block's points between two steps, accumulated chunk by chunk.
pub struct EndSums {
    squared: Lanes,
    flaw: Lanes,
    volumetric_strain: Lanes,
}

impl EndSums {
    /// Summary of no points.
    pub const NONE: Self = Self {
        squared: [0.0; LANES],
        flaw: [0.0; LANES],
        volumetric_strain: [0.0; LANES],
    };

    /// Adds a chunk.
    #[inline(always)]
    pub fn add(&mut self, chunk: &Chunk) {
        let [vx, vy, vz] = &chunk.velocity;
        for lane in 0..LANES {
            let here = vx[lane] * vx[lane] + vy[lane] * vy[lane] + vz[lane] * vz[lane];
            self.squared[lane] = self.squared[lane].max(here);
            self.volumetric_strain[lane] =
                self.volumetric_strain[lane].min(chunk.volumetric_strain[lane]);
        }
        // Zero times a number is zero, unless the number is non-finite.
        let motion = chunk.position.iter().chain(&chunk.velocity);
        let inner = chunk.gradient.iter().flatten().chain(&chunk.deviator);
        for of in motion.chain(inner).chain([&chunk.volumetric_strain]) {
            for lane in 0..LANES {
                self.flaw[lane] += of[lane] * 0.0;
            }
        }
    }

    /// Summary of the points.
    #[inline(always)]
    pub fn end(self) -> End {
        End {
            fastest: self.squared.into_iter().fold(0.0, f32::max).sqrt(),
            finite: self.flaw.into_iter().all(|sum| sum == 0.0),
            lowest_dilation: self.volumetric_strain.into_iter().fold(0.0, f32::min),
        }
    }
}

/// Summary of a block's points between two steps.
pub fn end_of(block: &Block) -> End {
    let mut sums = EndSums::NONE;
    for (chunk, _) in block.chunks() {
        sums.add(chunk);
    }
    sums.end()
}
