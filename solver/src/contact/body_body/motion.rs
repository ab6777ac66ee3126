//! Motion of a body, as its contacts need it.

use crate::math::Vec3;
use crate::motion::Velocities;
use crate::rigid::{Body, Freedom, Load};

/// Velocity or acceleration of a body: of its centre, and angular.
pub(super) struct Motion {
    pub(super) linear: Vec3,
    pub(super) angular: Vec3,
}

impl Motion {
    const NONE: Self = Self {
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
    };

    /// Current velocities.
    pub(super) fn velocity(body: &Body) -> Self {
        let Velocities { linear, angular } = body.velocities();
        Self { linear, angular }
    }

    /// Accelerations that a load gives to a body whose angular velocity is zero.
    pub(super) fn acceleration(body: &Body, load: &Load) -> Self {
        match body.freedom {
            Freedom::Fixed | Freedom::Prescribed(_) => Self::NONE,
            Freedom::Free | Freedom::InPlane => Self {
                linear: load.force / body.mass,
                angular: body.angular_acceleration(&load.torque),
            },
        }
    }

    pub(super) fn at(&self, arm: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(arm)
    }
}
