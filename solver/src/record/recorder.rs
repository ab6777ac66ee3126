//! Turns what a run shows into records and an outcome.

use super::outcome::{BodyHistory, flow_outcome, front, front_of};
use super::rest::{Base, EndedEarly, Remaining, body_bound, front_rests};
use super::submergence::submerged_fraction;
use super::{
    Audit, BodySample, Cost, FlowSnapshot, Mode, Outcome, Record, SNAPSHOT_POINTS, Sample,
};
use crate::contact::island::BodyReport;
use crate::math::Vec3;
use crate::plan::{self, Plan};
use crate::rigid::{Body, Freedom, Load};
use crate::scenario::{Ending, Scenario};
use crate::simulation::{Simulation, SubstepReport};
use serde::{Deserialize, Serialize};

/// Slower than this is at rest [m/s].
pub(super) const REST_SPEED: f64 = 1e-3;
/// A body at rest for so long without a break has come to rest [s].
const RESTS_FOR: f64 = 0.1;
/// A body on walls and other bodies for less of the time than this saltates.
const SUPPORTED_SHARE: f64 = 0.5;
/// A surface speed from turning above this share of the centre's speed is rolling.
const ROLLING_SHARE: f64 = 0.5;

/// Watches a run: call [`Recorder::start`] once, [`Recorder::observe`] from the
/// run's observer, and [`Recorder::outcome`] at the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recorder {
    histories: Vec<BodyHistory>,
    /// Per body, since the last sample.
    means: Vec<Means>,
    /// Snapshot times still to come, last first [s].
    snapshot_times: Vec<f64>,
    initial_toe: Option<f64>,
    open_end: f64,
    base: Base,
    /// Of the run, unless it ends early [s].
    duration: f64,
    ending: Ending,
    plan: Option<Plan>,
    ended_early: Option<EndedEarly>,
}

/// Impulses and counts of one body since the last sample.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct Means {
    duration: f64,
    flow: Load,
    wall: Load,
    bodies: Load,
    substeps: u64,
    substeps_supported: u64,
}

impl Means {
    fn take_in(&mut self, flow: &Load, report: &BodyReport, dt: f64) {
        self.duration += dt;
        self.flow.force += flow.force * dt;
        self.flow.torque += flow.torque * dt;
        self.wall.force += report.wall_load.force * dt;
        self.wall.torque += report.wall_load.torque * dt;
        self.bodies.force += report.body_load.force * dt;
        self.bodies.torque += report.body_load.torque * dt;
        self.substeps += u64::from(report.substeps);
        self.substeps_supported += u64::from(report.substeps_supported);
    }

    fn mean(&self, impulse: &Vec3) -> [f64; 3] {
        if self.duration > 0.0 {
            (impulse / self.duration).into()
        } else {
            [0.0; 3]
        }
    }

    fn supported(&self, body: &Body) -> bool {
        if self.substeps == 0 {
            return body.is_supported();
        }
        self.substeps_supported as f64 >= SUPPORTED_SHARE * self.substeps as f64
    }
}

impl Recorder {
    /// A recorder for this scenario.
    pub fn new(scenario: &Scenario) -> Self {
        Self {
            histories: Vec::new(),
            means: vec![Means::default(); scenario.bodies.len()],
            snapshot_times: snapshot_times(scenario),
            initial_toe: scenario.release().map(|release| release.front_m),
            open_end: scenario.channel.runout_length_m,
            base: Base::of(scenario),
            duration: scenario.duration_s,
            ending: scenario.numerics.ending,
            // What has no plan can't be set up either.
            plan: plan::of(scenario).ok(),
            ended_early: None,
        }
    }

    /// The records of time 0.
    pub fn start(&mut self, simulation: &Simulation) -> Vec<Record> {
        self.histories = simulation.bodies().iter().map(BodyHistory::start).collect();
        self.records_now(simulation)
    }

    /// Takes one sub-step in; returns what is to be recorded then (mostly nothing).
    pub fn observe(&mut self, simulation: &Simulation, report: &SubstepReport) -> Vec<Record> {
        for (place, body) in simulation.bodies().iter().enumerate() {
            let flow = simulation.flow_load(place).load;
            let walls = simulation.body_report(place);
            self.means[place].take_in(&flow, &walls, report.substep_s);
            self.histories[place].take_in(body, report.time_s);
        }
        if report.sample.is_some() {
            self.records_now(simulation)
        } else {
            Vec::new()
        }
    }

    /// Ends the run at this sample time if nothing can move a body or the front any
    /// more and the scenario does not forbid it: then returns the last records, and
    /// the outcome says so.
    pub fn end_early(&mut self, simulation: &Simulation) -> Option<Vec<Record>> {
        let ended = self.nothing_moves(simulation)?;
        self.ended_early = Some(ended);
        let due = !self.snapshot_times.is_empty();
        self.snapshot_times.clear();
        Some(
            due.then(|| Record::Snapshot(snapshot(simulation)))
                .into_iter()
                .collect(),
        )
    }

    fn nothing_moves(&self, simulation: &Simulation) -> Option<EndedEarly> {
        let time_s = simulation.time_s();
        let rests = |(body, history): (&Body, &BodyHistory)| {
            let turning = body.angular_velocity().norm() * body.shape.bounding_radius();
            match body.prescribed() {
                Some(prescribed) => prescribed.motion.rests_from(time_s),
                None if !body.is_free() => true,
                None => turning < REST_SPEED && history.rests_for(RESTS_FOR, time_s),
            }
        };
        let mut bodies = simulation.bodies().iter().zip(&self.histories);
        if self.ending == Ending::Full || time_s < RESTS_FOR || !bodies.all(rests) {
            return None;
        }
        let left = (self.duration - time_s).max(0.0);
        let remaining = Remaining::of(simulation, &self.base, left);
        let body_bound_m = body_bound(simulation, &remaining, left)?;
        let front = front(simulation, self.open_end);
        let farthest = front_of(simulation, remaining.reaches, self.open_end);
        let front_bound_m = front
            .zip(farthest)
            .map(|(front, farthest)| farthest - front);
        if front_bound_m.is_some_and(|bound| !front_rests(simulation, bound)) {
            return None;
        }
        Some(EndedEarly {
            time_s,
            reason: "nothing can move a body or the front any more".to_owned(),
            body_bound_m,
            front_bound_m,
        })
    }

    /// The outcome so far, with the wall time the caller measured [s].
    pub fn outcome(&self, simulation: &Simulation, wall_s: f64) -> Outcome {
        let audit = simulation.audit();
        let (steps, substeps, point_steps) = simulation.counts();
        let bodies = self.histories.iter().zip(simulation.bodies());
        Outcome {
            bodies: bodies
                .map(|(history, body)| history.outcome(body))
                .collect(),
            flow: flow_outcome(simulation, self.initial_toe, self.open_end),
            audit: Audit {
                mass_error: audit.mass_error,
                momentum_residual: audit.momentum_residual,
                angular_momentum_residual: audit.angular_momentum_residual,
                angular_momentum_spread: audit.angular_momentum_spread,
                energy_residual: audit.energy_residual(),
                max_overlap_ratio: audit.deepest_overlap_ratio,
                max_body_overlap_ratio: audit.deepest_body_overlap_ratio,
                points_put_back: audit.points_put_back,
                points_left: audit.points_left,
                points_lost: simulation.released_points()
                    - audit.points_left
                    - simulation.point_count() as u64,
            },
            cost: Cost {
                points: simulation.released_points(),
                steps,
                substeps,
                point_steps,
                wall_s,
                point_steps_per_s: if wall_s > 0.0 {
                    point_steps as f64 / wall_s
                } else {
                    0.0
                },
                threads: simulation.threads(),
                cell_size_m: simulation.cell_size_m(),
                sound_speed_m_s: simulation.sound_speed_m_s(),
            },
            ended_early: self.ended_early.clone(),
            plan: self.plan.clone(),
            accuracy: None,
        }
    }

    fn records_now(&mut self, simulation: &Simulation) -> Vec<Record> {
        let time_s = simulation.time_s();
        let mut records = vec![Record::Sample(self.sample(simulation))];
        let mut snapshot_due = false;
        while self.snapshot_times.last().is_some_and(|due| *due <= time_s) {
            self.snapshot_times.pop();
            snapshot_due = true;
        }
        if snapshot_due {
            records.push(Record::Snapshot(snapshot(simulation)));
        }
        records
    }

    fn sample(&mut self, simulation: &Simulation) -> Sample {
        let bodies = simulation.bodies().iter().zip(&mut self.means);
        let sampled = bodies.enumerate().map(|(place, (body, means))| {
            let sample = body_sample(simulation, place, body, means);
            *means = Means::default();
            sample
        });
        Sample {
            time_s: simulation.time_s(),
            bodies: sampled.collect(),
        }
    }
}

fn body_sample(simulation: &Simulation, place: usize, body: &Body, means: &Means) -> BodySample {
    let state = &body.state;
    let q = state.orientation;
    BodySample {
        position_m: state.position.into(),
        orientation: [q.w, q.i, q.j, q.k],
        velocity_m_s: body.velocity().into(),
        angular_velocity_rad_s: body.angular_velocity().into(),
        flow_force_n: means.mean(&means.flow.force),
        flow_torque_nm: means.mean(&means.flow.torque),
        wall_force_n: means.mean(&means.wall.force),
        wall_torque_nm: means.mean(&means.wall.torque),
        body_force_n: means.mean(&means.bodies.force),
        body_torque_nm: means.mean(&means.bodies.torque),
        touching_points: simulation.flow_load(place).touching_points,
        submerged_fraction: submerged_fraction(simulation, body),
        mode: mode(body, means),
    }
}

fn mode(body: &Body, means: &Means) -> Mode {
    let speed = body.velocity().norm();
    let turning = body.angular_velocity().norm() * body.shape.bounding_radius();
    if body.freedom == Freedom::Fixed || speed.max(turning) < REST_SPEED {
        Mode::Resting
    } else if !means.supported(body) {
        Mode::Saltating
    } else if turning > ROLLING_SHARE * speed {
        Mode::Rolling
    } else {
        Mode::Sliding
    }
}

/// Snapshot times, spread evenly over the run, last first; each snapshot is
/// taken at the first sample time at or after its own.
fn snapshot_times(scenario: &Scenario) -> Vec<f64> {
    let count = scenario.flow_snapshots;
    let last = f64::from(count.saturating_sub(1).max(1));
    (0..count)
        .rev()
        // A hair early, so that rounding does not shift one by an interval.
        .map(|n| scenario.duration_s * (f64::from(n) / last) * (1.0 - 1e-12))
        .collect()
}

/// The flow now, thinned evenly by identity.
fn snapshot(simulation: &Simulation) -> FlowSnapshot {
    let points = simulation.point_count();
    let thinning = points.div_ceil(SNAPSHOT_POINTS).max(1) as u32;
    let mut kept = Vec::new();
    simulation.visit_points(None, |point| {
        if point.id.is_multiple_of(thinning) {
            kept.push(*point);
        }
    });
    kept.sort_unstable_by_key(|point| point.id);
    kept.truncate(SNAPSHOT_POINTS);
    FlowSnapshot {
        time_s: simulation.time_s(),
        points: points as u64,
        thinning,
        position_m: kept
            .iter()
            .map(|point| point.position.map(|x| x as f32).into())
            .collect(),
        speed_m_s: kept
            .iter()
            .map(|point| point.velocity.norm() as f32)
            .collect(),
    }
}

#[cfg(test)]
mod tests;
