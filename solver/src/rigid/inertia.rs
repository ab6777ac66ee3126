//! Inverse of a body's inertia tensor, and free turning with it.

use super::free_turning::FreeTurning;
use crate::math::{Mat3, Vec3};
use nalgebra::UnitQuaternion;
use std::ops::Mul;

/// Inverse of an inertia tensor in the body frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InverseInertia {
    /// The inverse tensor [1/(kg m²)].
    tensor: Mat3,
    /// Largest of its eigenvalues.
    largest: f64,
    turning: FreeTurning,
}

impl InverseInertia {
    /// Inverse of an inertia tensor [kg m²]; `None` for a singular one.
    pub fn of(inertia: &Mat3) -> Option<Self> {
        inertia.try_inverse().map(Self::from)
    }

    /// Largest angular acceleration that a unit torque can give [1/(kg m²)]: the inverse
    /// of the least principal moment of inertia.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Frobenius norm, a bound of the largest eigenvalue [1/(kg m²)].
    pub fn norm(&self) -> f64 {
        self.tensor.norm()
    }

    /// Orientation after `dt` [s] of free turning with an angular momentum in world axes
    /// [kg m²/s].
    pub fn turned_freely(
        &self,
        orientation: &UnitQuaternion<f64>,
        angular_momentum: &Vec3,
        dt: f64,
    ) -> UnitQuaternion<f64> {
        self.turning.after(orientation, angular_momentum, dt)
    }
}

impl From<Mat3> for InverseInertia {
    fn from(tensor: Mat3) -> Self {
        Self {
            tensor,
            largest: tensor.symmetric_eigenvalues().max(),
            turning: FreeTurning::of(&tensor),
        }
    }
}

impl Mul<Vec3> for InverseInertia {
    type Output = Vec3;

    fn mul(self, torque: Vec3) -> Vec3 {
        self.tensor * torque
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_about_the_axis_of_least_inertia() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.7, 1.1);
        let moments = Mat3::from_diagonal(&Vec3::new(4.0, 0.5, 2.0));
        let inertia = turn.matrix() * moments * turn.matrix().transpose();
        let inverse = InverseInertia::of(&inertia).expect("it is regular");
        assert!((inverse.largest() - 2.0).abs() < 1e-12);
        let about = turn * Vec3::y();
        assert!((inverse * about - about * inverse.largest()).norm() < 1e-12);
        assert_eq!(InverseInertia::of(&Mat3::zeros()), None);
    }
}
