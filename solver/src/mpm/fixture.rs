//! Fixtures shared by the tests of the kernels.

use super::instructions::Instructions;
use crate::kernel::Lattice;
use crate::material::{Material, Yielding};
use crate::math::{Mat3, Sym3, Vec3};
use crate::points::Point;
use fearless_simd::Level;

/// Every instruction set of this machine, the last one possibly twice.
pub(super) fn levels() -> [Level; 3] {
    [
        Instructions::Baseline,
        Instructions::Avx2,
        Instructions::Avx512,
    ]
    .map(Instructions::level)
}

/// Nodes with three unequal spacings.
pub(super) fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::new(-0.1, -0.05, 0.0),
        spacing: Vec3::new(0.01, 0.012, 0.011),
    }
}

/// Glass beads.
pub(super) fn beads() -> Material {
    Material {
        bulk_density: 1500.0,
        bulk_modulus: 8.0e5,
        shear_modulus: 3.8e5,
        yielding: Yielding::Granular {
            static_friction: 0.382,
            limiting_friction: 0.644,
            reference_inertial_number: 0.279,
            grain_diameter: 1e-3,
            grain_density: 2500.0,
        },
    }
}

/// Random numbers over −1..1, the same in every run (SplitMix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^= bits >> 31;
        (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A number of both precisions.
    pub(super) fn single(&mut self, size: f64) -> f64 {
        f64::from((size * self.number()) as f32)
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + 0.5 * (self.number() + 1.0) * (high - low)
    }

    pub(super) fn vector(&mut self, size: f64) -> Vec3 {
        Vec3::from_fn(|_, _| size * self.number())
    }

    pub(super) fn matrix(&mut self, size: f64) -> Mat3 {
        Mat3::from_fn(|_, _| size * self.number())
    }
}

/// A cloud of points with random values, about four to a cell over several blocks; most of them
/// under pressure, some separated.
pub(super) fn cloud(count: u32) -> Vec<Point> {
    let mut random = Random(1);
    let half = 0.5 * (f64::from(count) / 4.0 * lattice().cell_volume()).cbrt();
    let material = beads();
    let point = |id| {
        let mass = 5e-4 * (1.5 + random.number());
        let density = material.bulk_density * (1.002 + 0.003 * random.number());
        let pressure = material.pressure(density);
        let deviator = Sym3::of(&random.matrix(0.2 * pressure)).deviator();
        Point {
            id,
            mass,
            volume: mass / density,
            position: random.vector(half),
            velocity: random.vector(1.0),
            affine: random.matrix(20.0),
            stress: deviator.plus(&Sym3::isotropic(-pressure)),
        }
    };
    (0..count).map(point).collect()
}
