//! Torque-free turning of a body, by exact rotations (docs/method.md, equation 16).

use crate::math::{Mat3, Vec3};
use crate::shape::PrincipalInertia;
use nalgebra::{Quaternion, Rotation3, UnitQuaternion};

/// Inertia of a body for free turning: the energy ½ Σ k_a L_a² of the angular momentum L about
/// the principal axes, split into ½ k_1 L² and the differences of the first and the last axis
/// from the middle one. The motion under each part is a rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FreeTurning {
    /// Principal frame to body frame.
    frame: UnitQuaternion<f64>,
    /// k_1, the middle one of the inverse moments [1/(kg m²)].
    middle: f64,
    /// The part that is split into two halves, and the one in between. A symmetric top has only one
    /// of them, and is turned exactly.
    parts: [AboutAxis; 2],
}

/// The part ½ δ L_a² of the energy.
#[derive(Debug, Clone, Copy, PartialEq)]
struct AboutAxis {
    /// Index of the principal axis a.
    axis: usize,
    /// δ = k_a − k_1 [1/(kg m²)].
    excess: f64,
}

/// Turn of the principal frame so far, and the angular momentum in it.
struct Turned {
    /// Current principal frame to that of the start.
    turn: Quaternion<f64>,
    /// Angular momentum [kg m²/s].
    angular_momentum: Vec3,
}

impl FreeTurning {
    /// Turning of a body with this inverse of its inertia tensor [1/(kg m²)].
    pub(super) fn of(inverse: &Mat3) -> Self {
        let PrincipalInertia { moments, axes } = PrincipalInertia::of(inverse);
        let frame = Rotation3::from_matrix_unchecked(Mat3::from_columns(&axes));
        let about = |axis: usize| AboutAxis {
            axis,
            excess: moments[axis] - moments[1],
        };
        let (low, high) = (about(0), about(2));
        // The error of the splitting goes with the square of the part in between, and
        // with half of that of the other.
        let parts = if high.excess > -low.excess {
            [high, low]
        } else {
            [low, high]
        };
        Self {
            frame: UnitQuaternion::from_rotation_matrix(&frame),
            middle: moments[1],
            parts,
        }
    }

    /// Orientation after turning for `dt` [s] with a constant angular momentum in world axes [kg
    /// m²/s].
    pub(super) fn after(
        &self,
        orientation: &UnitQuaternion<f64>,
        angular_momentum: &Vec3,
        dt: f64,
    ) -> UnitQuaternion<f64> {
        let start = orientation * self.frame;
        let [halved, between] = &self.parts;
        let mut turned = Turned {
            turn: Quaternion::identity(),
            angular_momentum: start.inverse_transform_vector(angular_momentum),
        };
        turned.about(halved, 0.5 * dt);
        turned.about(between, dt);
        turned.about(halved, 0.5 * dt);
        // ½ k_1 L² turns about the angular momentum itself, and commutes with the others.
        let whole = UnitQuaternion::from_scaled_axis(angular_momentum * (self.middle * dt));
        let end = whole.into_inner() * start.into_inner() * turned.turn;
        UnitQuaternion::new_normalize(end * self.frame.conjugate().into_inner())
    }
}

impl Turned {
    /// Turns under one part of the energy for `dt`: about its axis by δ L_a dt, in which
    /// the angular momentum turns the other way.
    fn about(&mut self, part: &AboutAxis, dt: f64) {
        // A body of equal moments needs no sine.
        if part.excess == 0.0 {
            return;
        }
        let (a, b, c) = (part.axis, (part.axis + 1) % 3, (part.axis + 2) % 3);
        let angular_momentum = &mut self.angular_momentum;
        let (sin, cos) = (0.5 * part.excess * angular_momentum[a] * dt).sin_cos();
        let mut axis = Vec3::zeros();
        axis[a] = sin;
        self.turn *= Quaternion::from_parts(cos, axis);
        let (along, across) = (1.0 - 2.0 * sin * sin, 2.0 * sin * cos);
        (angular_momentum[b], angular_momentum[c]) = (
            along * angular_momentum[b] + across * angular_momentum[c],
            along * angular_momentum[c] - across * angular_momentum[b],
        );
    }
}
