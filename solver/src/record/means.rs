//! Loads on a body since the last sample.

use crate::contact::island::BodyReport;
use crate::math::Vec3;
use crate::rigid::Load;
use serde::{Deserialize, Serialize};

/// Impulses on one body since the last sample.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Means {
    /// Time since then [s].
    pub(super) duration: f64,
    /// Part of it on walls or other bodies [s].
    pub(super) supported: f64,
    /// Impulse of the flow.
    pub(super) flow: Load,
    /// Impulse of the walls.
    pub(super) wall: Load,
    /// Impulse of other bodies.
    pub(super) bodies: Load,
}

impl Means {
    /// Adds the loads of a sub-step of `dt` [s].
    pub(super) fn take_in(&mut self, flow: &Load, report: &BodyReport, dt: f64) {
        self.duration += dt;
        self.supported += dt * report.supported_share;
        for (sum, load) in [
            (&mut self.flow, flow),
            (&mut self.wall, &report.wall_load),
            (&mut self.bodies, &report.body_load),
        ] {
            sum.force += load.force * dt;
            sum.torque += load.torque * dt;
        }
    }

    /// The mean load of an impulse.
    pub(super) fn mean(&self, impulse: &Vec3) -> Vec3 {
        if self.duration > 0.0 {
            impulse / self.duration
        } else {
            Vec3::zeros()
        }
    }
}
