//! Recorder: turns the states of a run into records and an outcome.

use super::creep::{Creep, Places};
use super::energy::body_energy;
use super::front::FrontMeasure;
use super::inundation::{FlowMaps, Inundation};
use super::motion::Motion;
use super::outcome::{BodyHistory, flow_outcome};
use super::remarks::Seen;
use super::rest::{
    EndedEarly, Remaining, body_bound, front_resolution, front_rests, outflow_rests,
    reaches_open_end,
};
use super::sampling::Sampling;
use super::scale::Scale;
use super::snapshots::Snapshots;
use super::submergence::burial_depth;
use super::{BodyOutcome, Conservation, Cost, FlowSnapshot, Outcome, Record, Sample};
use crate::method::METHOD;
use crate::plan::Plan;
use crate::rigid::Body;
use crate::scenario::{Ending, Scenario};
use crate::simulation::{PreparedScene, Simulation, SubstepReport};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Size of a scene without flow or bodies [m].
const SIZE_OF_NOTHING: f64 = 1.0;
/// Time between two checks for an early end, over the scene's rest time.
const LOOK_INTERVAL: f64 = 0.1;

/// Records a run: call [`Recorder::start`] once, [`Recorder::observe`] from the run's observer,
/// and [`Recorder::outcome`] at the end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Recorder {
    histories: Vec<BodyHistory>,
    sampling: Sampling,
    snapshots: Snapshots,
    front: FrontMeasure,
    /// Reach of the flow on a terrain.
    inundation: Option<Inundation>,
    /// Speed below which points creep [m/s].
    creep_speed: f64,
    creep: Creep,
    /// Duration of the run, unless it ends early [s].
    duration: f64,
    ending: Ending,
    /// Scale of the flow, or of the smallest body without one.
    scale: Scale,
    /// Time of the next check for an early end [s].
    next_look: f64,
    plan: Plan,
    ended_early: Option<EndedEarly>,
}

impl Recorder {
    /// A recorder for the run of a prepared scene.
    pub fn of(prepared: &PreparedScene) -> Self {
        let scenario = &prepared.scenario;
        let scale = Scale::of(size(scenario), scenario.gravity_m_s2);
        Self {
            histories: Vec::new(),
            sampling: Sampling::of(scenario),
            snapshots: Snapshots::of(scenario),
            front: FrontMeasure::of(prepared),
            inundation: Inundation::of(prepared),
            creep_speed: METHOD.early_stop.creep * scale.speed(),
            creep: Creep::default(),
            duration: scenario.duration_s,
            ending: scenario.numerics.ending,
            scale,
            next_look: 0.0,
            plan: Plan::of(prepared),
            ended_early: None,
        }
    }

    /// Plan of the run.
    pub fn plan(&self) -> &Plan {
        &self.plan
    }

    /// Duration of the run, unless it ends early [s].
    pub fn duration_s(&self) -> f64 {
        self.duration
    }

    pub(super) fn ending(&self) -> Ending {
        self.ending
    }

    pub(super) fn scale(&self) -> &Scale {
        &self.scale
    }

    pub(super) fn creep_speed(&self) -> f64 {
        self.creep_speed
    }

    /// True if this body is at rest.
    pub(super) fn rests(&self, place: usize, body: &Body) -> bool {
        self.histories[place].is_at_rest(body, &Motion::of(body))
    }

    /// The records of time 0.
    pub fn start(&mut self, simulation: &Simulation) -> Vec<Record> {
        let gravity = simulation.gravity().norm();
        let bodies = simulation.bodies().iter();
        self.histories = bodies
            .map(|body| BodyHistory::start(body, gravity))
            .collect();
        // Only notes the places: nothing has been at rest for any time.
        let ended = self.check(simulation);
        debug_assert_eq!(ended, None);
        self.look(simulation);
        let samples = self.sampling.start(simulation, &self.histories);
        in_order(samples, self.snapshots.due(simulation))
    }

    /// Adds one sub-step; returns its records (mostly none), and `Break` once nothing can move a
    /// body or the front any more.
    pub fn watch(
        &mut self,
        simulation: &Simulation,
        report: &SubstepReport,
    ) -> (Vec<Record>, ControlFlow<()>) {
        let mut records = self.observe(simulation, report);
        let last = report.step_ended.then(|| self.end_early(simulation));
        match last.flatten() {
            Some(last) => {
                records.extend(last);
                (records, ControlFlow::Break(()))
            }
            None => (records, ControlFlow::Continue(())),
        }
    }

    /// Adds one sub-step; returns the records at the end of a step (mostly none).
    pub fn observe(&mut self, simulation: &Simulation, report: &SubstepReport) -> Vec<Record> {
        self.sampling.take_in(simulation, report, &self.histories);
        for (place, body) in simulation.bodies().iter().enumerate() {
            self.histories[place].observe(simulation, place, &Motion::of(body));
        }
        if !report.step_ended {
            return Vec::new();
        }
        self.look(simulation);
        let samples = self.sampling.finished(simulation);
        in_order(samples, self.snapshots.due(simulation))
    }

    fn look(&mut self, simulation: &Simulation) {
        if let Some(inundation) = &mut self.inundation {
            inundation.look_if_due(simulation);
        }
    }

    /// Ends the run at the end of a step, if nothing can move a body or the front any more and the
    /// scenario allows it: then returns the last records, and the outcome says so. The check has
    /// times of its own.
    fn end_early(&mut self, simulation: &Simulation) -> Option<Vec<Record>> {
        let time_s = simulation.time_s();
        if time_s < self.next_look || time_s >= self.duration {
            return None;
        }
        let interval = LOOK_INTERVAL * self.scale.rest_time();
        self.next_look = interval * ((time_s / interval).floor() + 1.0);
        self.ended_early = self.check(simulation);
        self.ended_early.as_ref()?;
        let samples = self.sampling.end(simulation, &self.histories);
        Some(in_order(samples, self.snapshots.end(simulation)))
    }

    /// Checks for an early stop; what has been seen of the deposit's creep is forgotten if more
    /// than that moves.
    fn check(&mut self, simulation: &Simulation) -> Option<EndedEarly> {
        let bounded = self.bounded_energy(simulation);
        let Some((remaining, front, ballistic)) = bounded else {
            self.creep.forget();
            return None;
        };
        let time_s = simulation.time_s();
        let left = (self.duration - time_s).max(0.0);
        let motions = simulation.bodies().iter().map(Motion::of);
        let now = Places {
            time_s,
            deposit: front.map(|front| [front, remaining.mass_centre]),
            outflow: simulation.audit().outflow_mass(),
            bodies: motions.collect(),
        };
        let lasted = self.creep.add(now, self.scale.rest_time());
        let lasted = lasted.filter(|_| self.bodies_rest(simulation))?;
        let rate = left / lasted;
        let creeps_on = |place: usize, body: &Body| {
            let history = &self.histories[place];
            let distance = |one: &Motion, other: &Motion| history.distance(body, one, other);
            let way = self.creep.body_range(place, distance);
            // A body that has not moved at all waits without steps.
            let shifts = Scale::of_body(body, simulation.gravity().norm()).rest_distance();
            if way > 0.0 { way * rate + shifts } else { 0.0 }
        };
        let body_bound_m = body_bound(simulation, &remaining, &self.front, creeps_on)?;
        let front_bound_m = (self.creep.deposit_range())
            .map(|way| way * rate + ballistic + front_resolution(simulation));
        if front_bound_m.is_some_and(|bound| !front_rests(simulation, bound)) {
            return None;
        }
        let outflow_bound_kg = front_bound_m.map(|bound| {
            let reaches = reaches_open_end(simulation, &remaining, &self.front, (bound, left));
            self.creep.outflow() * rate + reaches
        });
        if outflow_bound_kg.is_some_and(|bound| !outflow_rests(simulation, bound)) {
            return None;
        }
        Some(EndedEarly {
            time_s,
            reason: "nothing that still moves can move a body or the front any more".to_owned(),
            body_bound_m,
            front_bound_m,
            outflow_bound_kg,
        })
    }

    /// True if every free body has been at rest for its rest time, and no prescribed motion is left.
    fn bodies_rest(&self, simulation: &Simulation) -> bool {
        let time_s = simulation.time_s();
        let mut bodies = simulation.bodies().iter().zip(&self.histories);
        bodies.all(|(body, history)| match body.prescribed() {
            Some(prescribed) => prescribed.motion.rests_from(time_s),
            None => !body.is_free() || history.rests_long(body, time_s),
        })
    }

    /// Energies that remain, the front, and how far it can still be moved by what is faster than
    /// creep [m], if that moves bodies and front by little and no release is to come.
    fn bounded_energy(&self, simulation: &Simulation) -> Option<(Remaining, Option<f64>, f64)> {
        if self.ending == Ending::Full || simulation.next_release_s().is_some() {
            return None;
        }
        let remaining = Remaining::of(simulation, &self.front, self.creep_speed);
        body_bound(simulation, &remaining, &self.front, |_, _| 0.0)?;
        let places = self.front.places(simulation);
        let [front, farthest] =
            [&places, &remaining.reaches].map(|of| self.front.front_of_rest(simulation, of));
        let ballistic = front.zip(farthest).map_or(0.0, |(now, then)| then - now);
        front_rests(simulation, ballistic).then_some((remaining, front, ballistic))
    }

    fn body_outcomes(&self, simulation: &Simulation) -> Vec<BodyOutcome> {
        let bodies = self.histories.iter().zip(simulation.bodies()).enumerate();
        bodies
            .map(|(place, (history, body))| BodyOutcome {
                energy: body_energy(simulation, place),
                burial_depth_m: burial_depth(simulation, body),
                ..history.outcome(body)
            })
            .collect()
    }

    /// Maps of what the flow has done to the terrain so far; `None` in a channel and without a flow.
    pub fn flow_maps(&self, simulation: &Simulation) -> Option<FlowMaps> {
        let inundation = self.inundation.as_ref()?;
        Some(inundation.maps(simulation))
    }

    /// The outcome so far, with the wall time the caller measured [s].
    pub fn outcome(&self, simulation: &Simulation, wall_s: f64) -> Outcome {
        let audit = simulation.audit();
        let (steps, substeps, point_steps) = simulation.counts();
        let bodies = self.body_outcomes(simulation);
        let flow = flow_outcome(simulation, &self.front);
        let released = simulation.audit().released_mass;
        let seen = Seen {
            bodies: &bodies,
            free: simulation.bodies().iter().map(Body::is_free).collect(),
            flow: (released > 0.0).then_some((&flow, released)),
            outlet: *simulation.outlet(),
            ended_s: simulation.time_s(),
            at_rest: (self.ending == Ending::Auto).then_some(self.ended_early.is_some()),
        };
        Outcome {
            remarks: seen.remarks(),
            bodies,
            flow,
            conservation: Conservation {
                mass_error: audit.mass_error,
                momentum_residual: audit.momentum_residual,
                angular_momentum_residual: audit.angular_momentum_residual,
                angular_momentum_from_shifting: audit.angular_momentum_from_shifting,
                energy_residual: audit.energy_residual(),
                max_overlap_ratio: audit.deepest_overlap_ratio,
                max_body_overlap_ratio: audit.deepest_body_overlap_ratio,
                penetration_corrections: audit.penetration_corrections,
                points_outflow: audit.points_outflow,
                points_lost: simulation.released_points()
                    - audit.points_outflow
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
            plan: Some(self.plan.clone()),
            accuracy: None,
        }
    }
}

/// Characteristic size of a scene [m].
fn size(scenario: &Scenario) -> f64 {
    let bodies = 0..scenario.bodies.len();
    let sizes = bodies.map(|body| scenario.shape_of(body).volume().cbrt());
    match scenario.release_thickness_m() {
        Some(thickness) => thickness,
        None => sizes.reduce(f64::min).unwrap_or(SIZE_OF_NOTHING),
    }
}

/// Records of a step, samples first: a snapshot shows the step's end.
fn in_order(samples: Vec<Sample>, snapshot: Option<FlowSnapshot>) -> Vec<Record> {
    let samples = samples.into_iter().map(Record::Sample);
    samples.chain(snapshot.map(Record::Snapshot)).collect()
}

#[cfg(test)]
mod tests;
