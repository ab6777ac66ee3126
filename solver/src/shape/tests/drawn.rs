//! Solids drawn at random of the kinds that people type: cones, prisms, lattices, bent cubes,
//! boulders, each typed with two to six decimals.

use nalgebra::{Rotation3, Vector3};
use std::f64::consts::TAU;

/// A sequence of numbers that look random (splitmix64).
pub(super) struct Draw(pub(super) u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number between two.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A whole number from one to another, both included.
    pub(super) fn whole(&mut self, low: usize, high: usize) -> usize {
        low + (self.bits() % (high - low + 1) as u64) as usize
    }

    fn place(&mut self, reach: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-reach, reach))
    }

    fn turn(&mut self) -> Rotation3<f64> {
        match self.whole(0, 2) {
            0 => Rotation3::identity(),
            _ => Rotation3::new(self.place(3.0)),
        }
    }

    /// A share of the inradius, often near 0 or 1.
    pub(super) fn share(&mut self) -> f64 {
        match self.whole(0, 3) {
            0 => 10_f64.powf(self.between(-3.0, -0.5)),
            1 => 1.0 - 10_f64.powf(self.between(-3.0, -0.5)),
            _ => self.between(0.001, 0.999),
        }
    }

    /// The points of a solid, and the name of its kind.
    pub(super) fn solid(&mut self) -> (&'static str, Vec<Vector3<f64>>) {
        let ring = |sides: usize, radius: f64, z: f64, twist: f64| {
            (0..sides).map(move |k| {
                let angle = TAU * (k as f64 + twist) / sides as f64;
                Vector3::new(radius * angle.cos(), radius * angle.sin(), z)
            })
        };
        let height = self.between(0.2, 5.0);
        let (kind, points): (_, Vec<_>) = match self.whole(0, 7) {
            0 => {
                let base = ring(self.whole(3, 31), 1.0, 0.0, 0.0);
                ("cone", base.chain([Vector3::z() * height]).collect())
            }
            1 => {
                let base = ring(self.whole(3, 30), 1.0, 0.0, 0.0);
                let tips = [
                    Vector3::z() * height,
                    Vector3::z() * -self.between(0.2, 5.0),
                ];
                ("bipyramid", base.chain(tips).collect())
            }
            2 => {
                let sides = self.whole(3, 16);
                let (top, twist) = (self.between(0.2, 1.0), [0.0, 0.5][self.whole(0, 1)]);
                let top = if self.whole(0, 1) == 0 { 1.0 } else { top };
                let below = ring(sides, 1.0, 0.0, 0.0);
                (
                    "prism",
                    below.chain(ring(sides, top, height, twist)).collect(),
                )
            }
            3 => {
                let (count, reach) = (self.whole(5, 32), self.whole(1, 4));
                let node = |d: &mut Self| {
                    Vector3::from_fn(|_, _| d.whole(0, 2 * reach) as f64 / reach as f64)
                };
                ("lattice", (0..count).map(|_| node(self)).collect())
            }
            4 => {
                let (side, off) = (
                    self.between(1.0, 3.0),
                    10_f64.powf(self.between(-7.0, -2.5)),
                );
                let corner = |k: usize| Vector3::from_fn(|axis, _| side * (k >> axis & 1) as f64);
                (
                    "cube",
                    (0..8).map(|k| corner(k) + self.place(off)).collect(),
                )
            }
            5 => {
                let squeeze = Vector3::new(1.0, self.between(0.3, 1.0), self.between(0.1, 1.0));
                let count = self.whole(5, 32);
                let place = |d: &mut Self| d.place(1.0).normalize().component_mul(&squeeze);
                ("boulder", (0..count).map(|_| place(self)).collect())
            }
            6 => {
                let all = crate::shape::RegularSolid::ALL;
                let (solid, off) = (all[self.whole(0, 4)], 10_f64.powf(self.between(-8.0, -2.0)));
                let vertices = solid.vertices(1.0);
                (
                    "regular",
                    vertices.iter().map(|v| v + self.place(off)).collect(),
                )
            }
            _ => (
                "cloud",
                (0..self.whole(4, 32)).map(|_| self.place(1.0)).collect(),
            ),
        };
        let turn = self.turn();
        let (size, decimals) = (10_f64.powf(self.between(-1.0, 1.0)), self.whole(2, 6));
        let unit = 10_f64.powi(decimals as i32);
        let typed = |v: &Vector3<f64>| (turn * v * size).map(|c| (c * unit).round() / unit);
        (kind, points.iter().map(typed).collect())
    }
}
