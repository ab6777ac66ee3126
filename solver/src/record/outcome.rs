//! Quantities of the outcome.

use super::front::FrontMeasure;
use super::motion::Motion;
use super::scale::Scale;
use super::settling::{Measure, Settling};
use super::turning::Turning;
use super::{BodyOutcome, FlowOutcome, MassProperties};
use crate::math::Vec3;
use crate::rigid::Body;
use crate::shape::PrincipalInertia;
use crate::simulation::Simulation;
use serde::{Deserialize, Serialize};

/// History of one body so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct BodyHistory {
    scale: Scale,
    start: Vec3,
    /// Motion at the end of the last sub-step, and the time of that [s].
    last: Motion,
    time: f64,
    /// End of the first sub-step in which the flow touched it [s].
    first_contact: Option<f64>,
    onset_time: Option<f64>,
    peak_speed: f64,
    peak_speed_time: Option<f64>,
    settling: Settling,
    turning: Turning,
    path_length: f64,
}

impl BodyHistory {
    /// History at the start, under gravity [m/s²].
    pub(super) fn start(body: &Body, gravity: f64) -> Self {
        let (scale, motion) = (Scale::of_body(body, gravity), Motion::of(body));
        let speed = motion.velocity.norm();
        Self {
            scale,
            start: motion.position,
            time: 0.0,
            first_contact: None,
            onset_time: None,
            peak_speed: speed,
            peak_speed_time: (speed > 0.0).then_some(0.0),
            settling: Settling::start(&motion, &measure(scale, body)),
            turning: Turning::default(),
            path_length: 0.0,
            last: motion,
        }
    }

    /// Adds a sub-step of a body in a run.
    pub(super) fn observe(&mut self, simulation: &Simulation, place: usize, motion: &Motion) {
        let (body, time_s) = (&simulation.bodies()[place], simulation.time_s());
        let report = simulation.body_report(place);
        let walls = simulation.rigid_walls().planes_at(&motion.position);
        let dt = time_s - self.time;
        if simulation.flow_load(place).touching_points > 0 {
            self.first_contact.get_or_insert(time_s);
        }
        self.turning.take_in((body, motion), &report, &walls, dt);
        self.take_in(body, motion, time_s);
    }

    /// Adds the motion of the body at the end of a sub-step.
    fn take_in(&mut self, body: &Body, motion: &Motion, time_s: f64) {
        let speed = motion.velocity.norm();
        self.path_length += (motion.position - self.last.position).norm();
        self.onset_time = self.onset_time.or(self.crossing(motion, time_s));
        if speed > self.peak_speed {
            self.peak_speed = speed;
            self.peak_speed_time = Some(time_s);
        }
        self.settling
            .take_in(motion, &measure(self.scale, body), time_s);
        (self.last, self.time) = (*motion, time_s);
    }

    /// Time within this sub-step at which its motion began [s], if it did.
    fn crossing(&self, motion: &Motion, time_s: f64) -> Option<f64> {
        let way = |motion: &Motion| (motion.position - self.start).norm();
        let (before, now) = (way(&self.last), way(motion));
        let onset = self.scale.onset_distance();
        let share = (onset - before) / (now - before);
        (now >= onset).then_some(self.time + share * (time_s - self.time))
    }

    /// Motion of the body at the end of the last sub-step.
    pub(super) fn last(&self) -> &Motion {
        &self.last
    }

    /// True if it rolls, provided that it is on a wall or body.
    pub(super) fn rolls(&self) -> bool {
        self.turning.rolls()
    }

    /// Distance of `body`, to which this history belongs, between two of its motions, turning
    /// included [m].
    pub(super) fn distance(&self, body: &Body, before: &Motion, now: &Motion) -> f64 {
        measure(self.scale, body).distance(before, now)
    }

    /// True if it has been at rest for the rest time until now [s].
    pub(super) fn rests_long(&self, body: &Body, time_s: f64) -> bool {
        self.settling.rests_long(&measure(self.scale, body), time_s)
    }

    /// True if it is at rest with this motion.
    pub(super) fn is_at_rest(&self, body: &Body, motion: &Motion) -> bool {
        self.settling.rests() || measure(self.scale, body).is_slow(motion)
    }

    /// The outcome of `body`, to which this history belongs; its energy and burial are not included.
    pub(super) fn outcome(&self, body: &Body) -> BodyOutcome {
        let way = self.last.position - self.start;
        let moved = self.onset_time.is_some() || self.settling.moved();
        let q = self.last.orientation;
        BodyOutcome {
            first_contact_time_s: self.first_contact,
            onset_time_s: self.onset_time,
            peak_speed_m_s: self.peak_speed,
            peak_speed_time_s: self.peak_speed_time.filter(|_| moved),
            stop_time_s: self.settling.stop_time(),
            displacement_m: way.xy().norm(),
            path_length_m: self.path_length,
            final_position_m: self.last.position.into(),
            burial_depth_m: 0.0,
            final_orientation: [q.w, q.i, q.j, q.k],
            error_bars: None,
            mass_properties: mass_properties(body),
            energy: None,
        }
    }
}

fn measure(scale: Scale, body: &Body) -> Measure {
    let radius = body.shape.bounding_radius();
    Measure { scale, radius }
}

fn mass_properties(body: &Body) -> MassProperties {
    let principal = PrincipalInertia::of(&body.inertia);
    MassProperties {
        mass_kg: body.mass,
        volume_m3: body.shape.volume(),
        principal_moments_kg_m2: principal.moments,
        principal_axes: principal.axes.map(Into::into),
    }
}

pub(super) fn flow_outcome(simulation: &Simulation, measure: &FrontMeasure) -> FlowOutcome {
    let front = measure.front(simulation);
    FlowOutcome {
        front_m: front,
        runout_m: front.zip(measure.toe()).map(|(front, toe)| front - toe),
        outflow_mass_kg: simulation.audit().outflow_mass(),
        excluded_volume_m3: simulation.excluded_volume_m3(),
        error_bars: None,
    }
}

#[cfg(test)]
mod tests;
