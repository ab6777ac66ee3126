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
    /// The inertia tensor [kg m²].
    inertia: Mat3,
    /// Determinant of the inverse.
    determinant: f64,
    /// Largest of its eigenvalues.
    largest: f64,
    /// Frobenius norm of the inverse.
    norm: f64,
    turning: FreeTurning,
}

impl InverseInertia {
    /// Inverse of an inertia tensor [kg m²]; `None` for a singular one.
    pub fn of(inertia: &Mat3) -> Option<Self> {
        inertia.try_inverse().map(|tensor| Self {
            tensor,
            inertia: *inertia,
            determinant: tensor.determinant(),
            largest: tensor.symmetric_eigenvalues().max(),
            norm: tensor.norm(),
            turning: FreeTurning::of(&tensor),
        })
    }

    /// Largest angular acceleration that a unit torque can give [1/(kg m²)]: the inverse
    /// of the least principal moment of inertia.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// Largest compliance at a place [1/kg], its arm in body axes [m]: the acceleration there by a
    /// unit force on it, which only turns the body, in the direction where it is largest. It is
    /// the largest eigenvalue of [a]ᵀ I⁻¹ [a], one of whose three is zero.
    pub fn compliance_at(&self, arm: &Vec3) -> f64 {
        let squared = arm.norm_squared();
        let sum = squared * self.tensor.trace() - arm.dot(&(self.tensor * arm));
        let product = squared * self.determinant * arm.dot(&(self.inertia * arm));
        // Rounding can make the discriminant of two equal ones negative.
        0.5 * (sum + (sum * sum - 4.0 * product).max(0.0).sqrt())
    }

    /// Frobenius norm, a bound of the largest eigenvalue [1/(kg m²)].
    pub fn norm(&self) -> f64 {
        self.norm
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

impl Mul<Vec3> for &InverseInertia {
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
        assert!((&inverse * about - about * inverse.largest()).norm() < 1e-12);
        assert_eq!(InverseInertia::of(&Mat3::zeros()), None);
    }

    // A slender rod about z: at its end it gives way across only, a place beside its axis turns it
    // about the axis.
    #[test]
    fn a_place_gives_way_as_the_matrix_of_its_arm_says() {
        let inverse = InverseInertia::of(&Mat3::from_diagonal(&Vec3::new(2.0, 3.0, 0.01)))
            .expect("it is regular");
        let at = |arm: [f64; 3]| inverse.compliance_at(&Vec3::from(arm));
        assert!((at([0.0, 0.0, 2.0]) - 4.0 / 2.0).abs() < 1e-12);
        assert!((at([0.1, 0.0, 0.0]) - 0.01 / 0.01).abs() < 1e-12);
        for arm in [[0.3, -0.2, 1.4], [0.0, 0.0, 0.0], [-1.0, 2.0, 0.1]] {
            let cross = Vec3::from(arm).cross_matrix();
            let matrix = cross.transpose() * inverse.tensor * cross;
            let largest = matrix.symmetric_eigenvalues().max();
            assert!(
                (at(arm) - largest).abs() <= 1e-12 * largest.max(1.0),
                "{arm:?}"
            );
        }
    }
}
