//! State of a body at one instant, also between two sub-steps.

use crate::math::Vec3;
use crate::rigid::Body;
use nalgebra::UnitQuaternion;
use serde::{Deserialize, Serialize};

/// State and motion of a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Motion {
    /// Centre [m].
    pub(super) position: Vec3,
    /// Body frame to world.
    pub(super) orientation: UnitQuaternion<f64>,
    /// Velocity of the centre [m/s].
    pub(super) velocity: Vec3,
    /// World axes [rad/s].
    pub(super) angular_velocity: Vec3,
}

impl Motion {
    /// Current motion of a body.
    pub(super) fn of(body: &Body) -> Self {
        Self {
            position: body.state.position,
            orientation: body.state.orientation,
            velocity: body.velocity(),
            angular_velocity: body.angular_velocity(),
        }
    }

    /// The motion at a share of the time `dt` [s] to a later one: the position by the cubic of both
    /// positions and velocities, the orientation by the shortest turn, velocities in proportion.
    pub(super) fn towards(&self, later: &Self, share: f64, dt: f64) -> Self {
        if share >= 1.0 {
            return *later;
        }
        let rest = 1.0 - share;
        let place = self.position * (1.0 + 2.0 * share) * rest * rest
            + later.position * (1.0 + 2.0 * rest) * share * share;
        let way = self.velocity * rest - later.velocity * share;
        let turned = self
            .orientation
            .try_slerp(&later.orientation, share, f64::EPSILON);
        Self {
            position: place + way * (share * rest * dt),
            orientation: turned.unwrap_or(later.orientation),
            velocity: self.velocity.lerp(&later.velocity, share),
            angular_velocity: self.angular_velocity.lerp(&later.angular_velocity, share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // A throw under gravity is a parabola, which a cubic reproduces; the turn is steady.
    #[test]
    fn a_throw_is_met_between_its_ends() {
        let at = |time: f64| Motion {
            position: Vec3::new(2.0 * time, 0.0, 3.0 * time - 4.9 * time * time),
            orientation: UnitQuaternion::from_scaled_axis(Vec3::y() * (5.0 * time)),
            velocity: Vec3::new(2.0, 0.0, 3.0 - 9.8 * time),
            angular_velocity: Vec3::y() * 5.0,
        };
        let (start, end) = (at(0.1), at(0.2));
        for share in [0.0, 0.3, 0.5, 1.0] {
            let (met, wanted) = (start.towards(&end, share, 0.1), at(0.1 + 0.1 * share));
            assert!((met.position - wanted.position).norm() < 1e-15);
            assert!((met.velocity - wanted.velocity).norm() < 1e-14);
            assert!(met.orientation.angle_to(&wanted.orientation) < 1e-7);
            assert_eq!(met.angular_velocity, wanted.angular_velocity);
        }
        assert_eq!(start.towards(&end, 1.0, 0.1), end);
    }
}
