//! A body with a prescribed motion among the free bodies of an island.

use super::report::BodyReport;
use crate::rigid::{Body, Load};
use nalgebra::UnitQuaternion;

/// A copy of such a body that moves in the island's sub-steps: several islands may touch it,
/// each in sub-steps of its own.
pub(super) struct Mover {
    /// Its place in the list of bodies.
    pub(super) place: usize,
    /// Its state within the sub-step of the flow.
    pub(super) body: Body,
    /// Orientation at the start of the flow's sub-step.
    start: UnitQuaternion<f64>,
    /// Impulse of the island's bodies on it, and that of their torque about its centre.
    impulse: Load,
    /// Work that it did on them [J].
    work: f64,
}

impl Mover {
    pub(super) fn new(place: usize, body: &Body) -> Self {
        Self {
            place,
            start: body.state.orientation,
            body: body.clone(),
            impulse: Load::default(),
            work: 0.0,
        }
    }

    /// True if it never moves.
    pub(super) fn stands(&self) -> bool {
        self.body.speed_ahead() == 0.0
    }

    /// Moves it to its place so long after the start, which was at `time` [s].
    pub(super) fn follow(&mut self, time: f64, after: f64) {
        self.body.state.orientation = self.start;
        self.body.follow(time, time + after);
    }

    /// Adds the loads of the island's bodies on it for `dt`.
    pub(super) fn take_in(&mut self, dt: f64) {
        let load = &self.body.state.body_load;
        self.impulse.force += load.force * dt;
        self.impulse.torque += load.torque * dt;
        self.work += self.body.work_against(load, dt);
    }

    /// Adds its impulses and work to the body it stands for, at the end of `dt`.
    pub(super) fn hand_over(self, body: &mut Body, report: &mut BodyReport, dt: f64) {
        body.state.touching_bodies += self.body.state.touching_bodies;
        report.body_load.force += self.impulse.force / dt;
        report.body_load.torque += self.impulse.torque / dt;
        report.work += self.work;
    }
}
