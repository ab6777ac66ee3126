//! The material points: the state of the flow.

use crate::material::Material;
use crate::math::{Mat3, Sym3, Vec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A material point between two steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Identity, constant over the run.
    pub id: u32,
    /// Mass [kg].
    pub mass: f64,
    /// Volume [m³].
    pub volume: f64,
    /// Position [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Affine velocity about the position, C [1/s].
    pub affine: Mat3,
    /// Cauchy stress, tension positive [Pa].
    pub stress: Sym3,
}

impl Point {
    /// ρ = m/V [kg/m³].
    pub fn density(&self) -> f64 {
        self.mass / self.volume
    }

    /// Angular momentum about the origin, the affine motion included [kg m²/s];
    /// `kernel_moment` is h²/4 per axis [m²].
    pub fn angular_momentum(&self, kernel_moment: &Vec3) -> Vec3 {
        self.mass * (self.position.cross(&self.velocity) + self.spin(kernel_moment))
    }

    /// Angular momentum of the affine motion per mass, Σ_a (h_a²/4) e_a × C e_a.
    fn spin(&self, kernel_moment: &Vec3) -> Vec3 {
        let b = self.affine * Mat3::from_diagonal(kernel_moment);
        Vec3::new(b.m32 - b.m23, b.m13 - b.m31, b.m21 - b.m12)
    }

    /// Kinetic energy, the affine motion included [J].
    pub fn kinetic_energy(&self, kernel_moment: &Vec3) -> f64 {
        let affine: f64 = (0..3)
            .map(|axis| kernel_moment[axis] * self.affine.column(axis).norm_squared())
            .sum();
        0.5 * self.mass * (self.velocity.norm_squared() + affine)
    }

    /// Elastic energy p²V/2K + s:s V/4G [J].
    pub fn elastic_energy(&self, material: &Material) -> f64 {
        let pressure = -self.stress.trace() / 3.0;
        let shear = self.stress.deviator().equivalent_shear();
        0.5 * self.volume
            * (pressure * pressure / material.bulk_modulus + shear * shear / material.shear_modulus)
    }

    /// Name of the first non-finite quantity, if any.
    pub fn non_finite(&self) -> Option<&'static str> {
        let finite = [
            ("position", self.position.sum().is_finite()),
            ("velocity", self.velocity.sum().is_finite()),
            ("affine velocity", self.affine.sum().is_finite()),
            ("volume", self.volume.is_finite() && self.volume > 0.0),
            ("stress", self.stress.is_finite()),
        ];
        finite
            .into_iter()
            .find_map(|(name, finite)| (!finite).then_some(name))
    }
}

/// Mass of a point and its motion, without its stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMotion {
    /// Mass [kg].
    pub mass: f64,
    /// Position [m].
    pub position: Vec3,
    /// Velocity [m/s].
    pub velocity: Vec3,
}

impl PointMotion {
    /// Motion of a point.
    pub fn of(point: &Point) -> Self {
        let Point {
            mass,
            position,
            velocity,
            ..
        } = *point;
        Self {
            mass,
            position,
            velocity,
        }
    }
}

/// One of some equal parts of the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    index: usize,
    of: usize,
}

impl Part {
    /// All of so many parts.
    pub fn all(of: usize) -> impl IndexedParallelIterator<Item = Self> {
        (0..of).into_par_iter().map(move |index| Self { index, of })
    }

    /// True of the first one.
    pub fn is_first(&self) -> bool {
        self.index == 0
    }

    /// Its range of a list with so many entries.
    pub fn range(&self, count: usize) -> Range<usize> {
        let start = |index: usize| index * count / self.of;
        start(self.index)..start(self.index + 1)
    }
}

/// Points after which an unloaded list returns memory.
const RETURNED: usize = 1 << 14;

/// Points of a list one after the other; the list returns its memory on the way, so that it and
/// what is made of the points are never there as a whole at the same time.
#[derive(Debug)]
pub struct Unloading {
    /// The last one first.
    left: Vec<Point>,
}

impl Unloading {
    /// Points of this list.
    pub fn of(mut points: Vec<Point>) -> Self {
        points.reverse();
        Self { left: points }
    }
}

impl Iterator for Unloading {
    type Item = Point;

    fn next(&mut self) -> Option<Point> {
        let next = self.left.pop();
        if self.left.len().is_multiple_of(RETURNED) {
            self.left.shrink_to_fit();
        }
        next
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unloaded_list_gives_its_points_in_order_and_its_memory_back() {
        let point = |id| Point {
            id,
            mass: 1.0,
            volume: 1.0,
            position: Vec3::zeros(),
            velocity: Vec3::zeros(),
            affine: Mat3::zeros(),
            stress: Sym3::default(),
        };
        let count = 3 * RETURNED as u32 + 5;
        let mut unloading = Unloading::of((0..count).map(point).collect());
        for id in 0..count {
            assert_eq!(unloading.next().map(|point| point.id), Some(id));
            assert!(unloading.left.capacity() < unloading.left.len() + RETURNED + 1);
        }
        assert!(unloading.next().is_none());
        assert_eq!(unloading.left.capacity(), 0);
    }
}
