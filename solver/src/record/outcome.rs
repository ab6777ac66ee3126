//! How the outcome's quantities come about.

use super::recorder::REST_SPEED;
use super::{BodyOutcome, FlowOutcome, MassProperties};
use crate::math::Vec3;
use crate::rigid::Body;
use crate::shape::PrincipalInertia;
use crate::simulation::Simulation;
use serde::{Deserialize, Serialize};

/// A body has set off when its centre is this far from where it started [m].
const ONSET_DISTANCE: f64 = 1e-3;
/// The front leaves this share of the mass beyond it.
const FRONT_SHARE: f64 = 1e-3;

/// What one body did so far.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct BodyHistory {
    start: Vec3,
    last: Vec3,
    orientation: [f64; 4],
    onset_time: Option<f64>,
    peak_speed: f64,
    peak_speed_time: Option<f64>,
    /// Since when it has been at rest without a break.
    rest_since: Option<f64>,
    path_length: f64,
}

impl BodyHistory {
    pub(super) fn start(body: &Body) -> Self {
        let speed = body.velocity().norm();
        Self {
            start: body.state.position,
            last: body.state.position,
            orientation: orientation(body),
            onset_time: None,
            peak_speed: speed,
            peak_speed_time: (speed > 0.0).then_some(0.0),
            rest_since: (speed < REST_SPEED).then_some(0.0),
            path_length: 0.0,
        }
    }

    pub(super) fn take_in(&mut self, body: &Body, time_s: f64) {
        let position = body.state.position;
        let speed = body.velocity().norm();
        self.path_length += (position - self.last).norm();
        self.last = position;
        self.orientation = orientation(body);
        if self.onset_time.is_none() && (position - self.start).norm() >= ONSET_DISTANCE {
            self.onset_time = Some(time_s);
        }
        if speed > self.peak_speed {
            self.peak_speed = speed;
            self.peak_speed_time = Some(time_s);
        }
        if speed >= REST_SPEED {
            self.rest_since = None;
        } else {
            self.rest_since.get_or_insert(time_s);
        }
    }

    /// Whether it has been at rest for so long without a break [s].
    pub(super) fn rests_for(&self, duration: f64, time_s: f64) -> bool {
        self.rest_since
            .is_some_and(|since| time_s - since >= duration)
    }

    /// Beyond the trembling of a body at rest.
    fn moved(&self) -> bool {
        self.onset_time.is_some() || self.peak_speed >= REST_SPEED
    }

    /// The outcome of `body`, whose history this is.
    pub(super) fn outcome(&self, body: &Body) -> BodyOutcome {
        let way = self.last - self.start;
        BodyOutcome {
            onset_time_s: self.onset_time,
            peak_speed_m_s: self.peak_speed,
            peak_speed_time_s: self.peak_speed_time.filter(|_| self.moved()),
            // At rest since the start is not a stop.
            stop_time_s: self.rest_since.filter(|since| *since > 0.0),
            displacement_m: way.xy().norm(),
            path_length_m: self.path_length,
            final_position_m: self.last.into(),
            final_orientation: self.orientation,
            error_bars: None,
            mass_properties: mass_properties(body),
        }
    }
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

fn orientation(body: &Body) -> [f64; 4] {
    let q = body.state.orientation;
    [q.w, q.i, q.j, q.k]
}

pub(super) fn flow_outcome(
    simulation: &Simulation,
    initial_toe: Option<f64>,
    open_end: f64,
) -> FlowOutcome {
    let front = front(simulation, open_end);
    FlowOutcome {
        front_m: front,
        runout_m: front.zip(initial_toe).map(|(front, toe)| front - toe),
        mass_left_kg: simulation.audit().mass_left(),
        volume_left_out_m3: simulation.volume_left_out_m3(),
        error_bars: None,
    }
}

/// The x beyond which [`FRONT_SHARE`] of the released mass lies; the open end
/// once that much has left.
pub(super) fn front(simulation: &Simulation, open_end: f64) -> Option<f64> {
    let mut places = Vec::with_capacity(simulation.point_count());
    simulation.visit_points(None, |point| places.push((point.position.x, point.mass)));
    front_of(simulation, places, open_end)
}

/// The same if each point (mass in kg) were at another x [m].
pub(super) fn front_of(
    simulation: &Simulation,
    mut ahead: Vec<(f64, f64)>,
    open_end: f64,
) -> Option<f64> {
    let audit = simulation.audit();
    let mut beyond = audit.mass_left();
    let wanted = FRONT_SHARE * audit.released_mass;
    if audit.released_mass <= 0.0 {
        return None;
    }
    if beyond >= wanted {
        return Some(open_end);
    }
    ahead.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    for (x, mass) in ahead {
        beyond += mass;
        if beyond >= wanted {
            return Some(x);
        }
    }
    None
}

#[cfg(test)]
mod tests;
