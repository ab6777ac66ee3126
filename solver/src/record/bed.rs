//! The bed under a body.

use crate::math::Vec3;
use crate::scenario::Channel;
use serde::{Deserialize, Serialize};

/// Incline and floor under a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Bed {
    /// Inclination of the incline [rad].
    inclination: f64,
}

impl Bed {
    pub(super) fn of(channel: &Channel) -> Self {
        Self {
            inclination: channel.inclination_rad(),
        }
    }

    /// Inclination at x [rad].
    fn inclination_at(&self, x: f64) -> f64 {
        if x < 0.0 { self.inclination } else { 0.0 }
    }

    /// Unit normal at x.
    pub(super) fn normal_at(&self, x: f64) -> Vec3 {
        let (sin, cos) = self.inclination_at(x).sin_cos();
        Vec3::new(sin, 0.0, cos)
    }

    /// Unit vector downstream along the bed at x.
    pub(super) fn downstream_at(&self, x: f64) -> Vec3 {
        let (sin, cos) = self.inclination_at(x).sin_cos();
        Vec3::new(cos, 0.0, -sin)
    }
}
