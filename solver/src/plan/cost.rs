//! Points, steps and memory of a run.

use super::course::Course;
use super::memory::memory;
use crate::contact::island::substeps_at_rest;
use crate::method::METHOD;
use crate::scenario::Ending;
use crate::simulation::{Columns, Division, PreparedScene, Share};
use crate::stability::Limits;
use serde::{Deserialize, Serialize};

/// Cost of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = PlannedCost))]
pub struct Cost {
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Material points of the flow at the start.
    pub points: u64,
    /// Acoustic sub-steps of a run of the whole duration.
    pub substeps: u64,
    /// Transfers between points and grid of a run of the whole duration.
    pub steps: u64,
    /// Sub-steps summed over the computed points, of a run of the whole duration.
    pub point_steps: u64,
    /// Sub-steps of the bodies' own, summed over the free bodies, of a run of the whole duration in
    /// which all of them stay in contact.
    #[serde(default)]
    pub body_substeps: u64,
    /// Memory of the run while the release is set up or once the flow has spread, whichever is more
    /// [bytes]. Records that the caller keeps are not part of it.
    pub memory_bytes: u64,
    /// Time at which the run is expected to end [s].
    pub expected_end_s: f64,
    /// Parts of the run, one after the other, by the share of the flow that is computed.
    pub stages: Vec<Stage>,
}

/// Part of a run during which the same share of the flow is computed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Stage {
    /// Share of the flow.
    pub share: Share,
    /// Points of the share.
    pub points: u64,
    /// Expected number of sub-steps.
    pub substeps: u64,
    /// Expected number of sub-steps before the expected end.
    pub expected_substeps: u64,
}

impl Cost {
    /// Cost of a prepared scene's run: equations 25–27 at the expected speed (31).
    pub fn of(prepared: &PreparedScene) -> Self {
        let scenario = &prepared.scenario;
        let points = prepared
            .division
            .as_ref()
            .map_or(0, |division| division.points());
        let (substeps, steps) = steps(prepared, points);
        let course = Course::of(prepared);
        let expected_end_s = match scenario.numerics.ending {
            Ending::Auto => course.rests.min(scenario.duration_s),
            Ending::Full => scenario.duration_s,
        };
        let stages = stages(prepared, &course, substeps, expected_end_s);
        let last = stages.last().map_or(points, |stage| stage.points);
        Self {
            cell_size_m: prepared.given.lattice.spacing.x,
            points,
            substeps,
            steps,
            point_steps: stages.iter().map(|of| of.points * of.substeps).sum(),
            body_substeps: body_substeps(prepared),
            memory_bytes: memory(prepared, points, last),
            expected_end_s,
            stages,
        }
    }
}

/// Time that a sub-step of a body takes, over that of a point: 0.4 to 1.5 µs in piles of cubes
/// over 0.02 µs, on two threads.
const BODY_SUBSTEP: u64 = 40;
/// Points whose sub-steps take as long as what a sub-step costs whatever the points: 7000 to
/// 14,000 in coarse runs with two bodies, on two threads.
const SUBSTEP: f64 = 7000.0;
/// Sub-steps that take a point as long as the transfers of a step.
const STEP: f64 = 2.0;

impl Cost {
    /// Point-steps, and the bodies' own sub-steps as if each took as long as 40 of them.
    pub fn work(&self) -> u64 {
        let bodies = self.body_substeps.saturating_mul(BODY_SUBSTEP);
        self.point_steps.saturating_add(bodies)
    }

    /// Work of the run to its expected end, in sub-steps of points: what later runs of a study
    /// take is told from it and the pace of the current one.
    pub fn work_to_the_end(&self) -> f64 {
        let transfers = STEP * self.steps as f64 / self.substeps.max(1) as f64;
        let stages = self.stages.iter();
        let work = stages.map(|of| (of.points as f64 + SUBSTEP) * of.expected_substeps as f64);
        work.sum::<f64>() * (1.0 + transfers)
    }
}

/// Sub-steps of the bodies' own over the whole duration.
fn body_substeps(prepared: &PreparedScene) -> u64 {
    let gravity = prepared.given.gravity.norm();
    let free = prepared.bodies.iter().filter(|body| body.is_free());
    let each = free.map(|body| substeps_at_rest(body, gravity, prepared.given.timing.duration));
    each.sum::<f64>().ceil() as u64
}

/// Stages, with their parts of this number of sub-steps.
fn stages(prepared: &PreparedScene, course: &Course, substeps: u64, end: f64) -> Vec<Stage> {
    let duration = prepared.given.timing.duration;
    let within = |from: f64, to: f64| {
        let share = (to - from).max(0.0) / duration.max(f64::MIN_POSITIVE);
        (substeps as f64 * share).round() as u64
    };
    let stage = |share: Share, from: f64, to: f64| {
        let halves = prepared.given.walls.halves_across();
        let rows = |columns: &Columns| u64::from(share.rows_across(columns, halves));
        let of_row = |columns: &Columns| columns.points() / u64::from(columns.count[1]);
        Stage {
            share,
            points: match &prepared.division {
                None => 0,
                Some(Division::Channel(columns)) => of_row(columns) * rows(columns),
                Some(Division::Terrain(columns)) => columns.points(),
            },
            substeps: within(from, to),
            expected_substeps: within(from.min(end), to.min(end)),
        }
    };
    match &prepared.reductions.shares {
        None => vec![stage(Share::Whole, 0.0, duration)],
        Some(shares) if shares.first == shares.last => vec![stage(shares.last, 0.0, duration)],
        Some(shares) => {
            let met = course.meets_body.min(duration);
            let mut both = vec![stage(shares.first, 0.0, met)];
            if met < duration {
                both.push(stage(shares.last, met, duration));
            }
            both
        }
    }
}

/// Sub-steps and steps of the whole duration.
fn steps(prepared: &PreparedScene, points: u64) -> (u64, u64) {
    let duration = prepared.given.timing.duration;
    let flow = prepared.given.flow.as_ref().filter(|_| points > 0);
    let Some(flow) = flow else {
        return over(duration, METHOD.time_step.without_flow, 1.0);
    };
    let longest = longest_substep(&flow.limits).min(flow.contact_substep(&prepared.bodies));
    let division = flow.limits.division(longest, flow.limits.slow);
    over(duration, division.substep, division.count)
}

pub(super) fn longest_substep(limits: &Limits) -> f64 {
    limits.substep(limits.slow)
}

/// Sub-steps and steps of a duration [s], with sub-steps of at most `longest` [s] and so many
/// per step.
fn over(duration: f64, longest: f64, per_step: f64) -> (u64, u64) {
    let substeps = (duration / longest - 1e-9).ceil().max(0.0);
    (substeps as u64, (substeps / per_step).ceil() as u64)
}
