//! Motion of a body as its contacts meet it.

use crate::math::Vec3;
use crate::rigid::{Body, Freedom, Load};

/// How a body moves, or begins to: at its centre, and turning.
pub(super) struct Motion {
    pub(super) linear: Vec3,
    pub(super) angular: Vec3,
}

impl Motion {
    const NONE: Self = Self {
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
    };

    /// A fixed body has none.
    pub(super) fn velocity(body: &Body) -> Self {
        match body.freedom {
            Freedom::Fixed => Self::NONE,
            Freedom::Free | Freedom::InPlane | Freedom::Prescribed(_) => Self {
                linear: body.velocity(),
                angular: body.angular_velocity(),
            },
        }
    }

    /// What a load gives a body that does not turn yet.
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
