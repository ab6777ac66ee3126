//! A free body of an island: its loads, and its report.

use super::report::BodyReport;
use crate::contact::dissipation::Taken;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::motion::Velocities;
use crate::rigid::{Body, Load};

/// A free body of an island.
pub(super) struct Member<'a> {
    pub(super) body: &'a mut Body,
    pub(super) report: &'a mut BodyReport,
    pub(super) flow: Load,
    /// Position of its centre at the start of the flow's sub-step [m].
    pub(super) start: Vec3,
    /// Mean velocities in the last half kick in which flow or bodies acted on it.
    pub(super) mean: Velocities,
    /// Damping and losses of its contacts with walls in the last sub-step.
    pub(super) taken: Taken,
    /// Shortest sub-steps over which it was in contact.
    pub(super) supported: u32,
}

impl<'a> Member<'a> {
    pub(super) fn new(body: &'a mut Body, report: &'a mut BodyReport, flow: Load) -> Self {
        Self {
            start: body.state.position,
            mean: Velocities::NONE,
            taken: Taken::default(),
            supported: 0,
            flow,
            body,
            report,
        }
    }

    pub(super) fn half_kick(&mut self, gravity: &Vec3, dt: f64) {
        let weight = gravity * self.body.mass;
        let state = &self.body.state;
        let position = state.position;
        let (wall, barrier, others) = (state.wall_load, state.barrier_load, state.body_load);
        // The flow's force keeps its line of action, so that points and body
        // exchange equal and opposite angular momentum.
        let shifted = self.flow.torque - (position - self.start).cross(&self.flow.force);
        let flow = Load {
            force: self.flow.force,
            torque: shifted,
        };
        let mut total = Load {
            force: wall.force + flow.force + weight,
            torque: wall.torque + flow.torque,
        };
        let mut bodies = others;
        bodies.add(&barrier);
        total.add(&bodies);
        let [linear, angular] = self.body.kick(&total, dt);
        let report = &mut *self.report;
        // Loads of walls and weight need no mean velocities to account for their work.
        if flow != Load::default() || self.body.state.touching_bodies > 0 {
            self.mean = self.body.velocities_with(&linear, &angular);
            report.energy.flow += dt * flow.power(&self.mean);
        }
        report.wall.add_at(&position, &(wall.force * dt));
        report.wall.angular += wall.torque * dt;
        report.barrier.add_at(&position, &(barrier.force * dt));
        report.barrier.angular += barrier.torque * dt;
        report.gravity.add_at(&position, &(weight * dt));
        for (sum, load) in [
            (&mut report.wall_load, &wall),
            (&mut report.body_load, &bodies),
        ] {
            sum.force += load.force * dt;
            sum.torque += load.torque * dt;
        }
    }

    /// Moves it freely for `dt`.
    pub(super) fn drift(&mut self, dt: f64) {
        let fastest = self.body.velocity().norm() + self.body.turning_bound();
        self.report.travelled += fastest * dt;
        self.body.drift(dt);
        self.body.turn_core_anew();
    }

    /// Counts a sub-step as long as so many of the shortest.
    pub(super) fn count_substep(&mut self, stride: u32) {
        self.report.substeps += 1;
        if self.body.is_supported() {
            self.supported += stride;
        }
        let radius = self.body.shape.sphero_radius();
        self.report.overlap(self.body.state.wall_overlap / radius);
    }

    /// True if it has been in static equilibrium on the walls since the start, and nothing else
    /// touches it: steps would change only its rounding.
    pub(super) fn is_in_equilibrium(&self) -> bool {
        self.body.is_held() && self.flow == Load::default()
    }

    /// Report of a body asleep: the loads that hold it.
    pub(super) fn sleep(&mut self) {
        let state = &self.body.state;
        self.report.wall_load = state.wall_load;
        self.report.body_load = state.body_load;
        self.report.body_load.add(&state.barrier_load);
        self.report.substeps = 1;
        self.report.supported_share = f64::from(u8::from(self.body.is_supported()));
        let overlap = state.wall_overlap / self.body.shape.sphero_radius();
        self.report.overlap(overlap);
    }

    pub(super) fn watch_rest(&mut self, dt: f64) {
        if self.body.largest_speed() < METHOD.sleep.still && self.flow == Load::default() {
            self.body.state.still_for += dt;
        } else {
            self.body.state.still_for = 0.0;
        }
    }
}
