//! Case 22: a channel as the raster of a terrain.
//!
//! A flow runs down a slope onto a floor, strikes a cube and carries it away: in a channel, whose
//! bed is two planes and whose side walls are smooth, and on a height map of the same slope, whose
//! cells of 20 mm round the slope break off. The map has no side walls. There the release is three
//! times as wide, so that what happens at its sides does not come to the middle before the end.
//! Reference: the channel. Tolerance of the cube's displacement, its peak speed and the front of
//! the middle strip: half the width of the channel's own error bars of them (those of the run-out
//! for the front), over the values; of the strip's mean speed before the cube is struck: 1 %.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scenario_of};
use crate::verify::with_error_bars::answer;
use crate::verify::{Case, Effort, How};
use scree_solver::Simulation;
use scree_solver::raster::Raster;
use scree_solver::record::{Outcome, Recorder, UncertaintyInterval};
use scree_solver::scenario::{Ending, Maps, Scenario};
use scree_solver::simulation::PreparedScene;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::sync::Arc;

pub(super) const CASE: Case = Case {
    name: "channel-as-raster",
    number: "22",
    title: "a height map of a channel's slope against the channel",
    source: "the same scene in a channel, and its error bars",
    how: How::Runs(run),
};

const INCLINATION_DEG: f64 = 40.0;
/// Horizontal length of the slope and of the floor [m].
const LENGTHS: [f64; 2] = [1.0, 2.0];
/// Width of the channel; that of the release on the map [m].
const WIDTHS: [f64; 2] = [0.8, 2.4];
/// Thickness of the release along the normal, horizontal length, distance of its toe [m].
const RELEASE: [f64; 3] = [0.15, 0.4, 0.05];
/// Side of the cube, and its place behind the foot [m].
const CUBE: [f64; 2] = [0.1, 0.1];
/// Side of a cell of the map [m].
const MAP_CELL: f64 = 0.02;
/// Half the width of the strip round the middle in which the flow is looked at [m].
const STRIP: f64 = 0.2;
/// Time at which its speed is looked at, before it comes to the cube, and end [s].
const TIMES: [f64; 2] = [0.15, 2.0];
/// Share of the strip's mass beyond its front.
const FRONT_SHARE: f64 = 1e-3;
/// Cells across the cube.
const CELLS: [f64; 2] = [3.0, 6.0];

fn run(effort: Effort, findings: &mut Findings) {
    for &cells in effort.take(&CELLS, 1) {
        let resolution = Resolution::sized(format!("{cells} cells across the cube"), 1.0 / cells);
        match reference(cells) {
            Ok((values, bars)) => {
                let map = on_map(cells).and_then(|scenario| measured(&scenario, middle()));
                findings.take(&resolution, questions(&values, &bars), map);
            }
            Err(error) => {
                let question = Question::new("the channel, computed", "", 1.0);
                let failed: Result<Answer<1>, CaseError> = Err(error);
                findings.take(&resolution, [question], failed);
            }
        }
    }
}

/// Speed of the flow, displacement and peak speed of the cube, front.
fn questions(values: &[f64; 4], bars: &[f64; 3]) -> [Question; 4] {
    let [speed, displacement, peak, front] = *values;
    let [of_displacement, of_peak, of_front] = *bars;
    [
        Question::new("mean speed of the flow", "m/s", speed).within(0.01),
        Question::new("displacement", "m", displacement).within(of_displacement),
        Question::new("peak speed", "m/s", peak).within(of_peak),
        Question::new("front from the foot", "m", front).within(of_front),
    ]
}

/// The values in the channel, and half the widths of the error bars over the value, of
/// displacement, peak speed and run-out.
fn reference(cells: f64) -> Result<([f64; 4], [f64; 3]), CaseError> {
    let mut channel = channel(cells);
    let values = measured(&scenario_of(&channel)?, [0.0; 2])?.values;
    channel["accuracy"] = json!({"error_bars": true});
    let outcome = answer(&channel)?;
    Ok((values, half_widths(&outcome)?))
}

fn half_widths(outcome: &Outcome) -> Result<[f64; 3], CaseError> {
    let missing = || CaseError::Never("the channel's outcome has no error bars");
    let body = outcome.bodies[0].error_bars.as_ref().ok_or_else(missing)?;
    let flow = outcome.flow.error_bars.as_ref().ok_or_else(missing)?;
    let half_width = |of: &UncertaintyInterval| {
        let (value, low, high) = (of.value?, of.low?, of.high?);
        Some(0.5 * (high - low) / value.abs())
    };
    let bars = [body.displacement_m, body.peak_speed_m_s, flow.runout_m];
    let [displacement, peak, runout] = bars.each_ref().map(half_width);
    let all = displacement.zip(peak).zip(runout).ok_or_else(missing)?;
    Ok([all.0.0, all.0.1, all.1])
}

fn cell_size(cells: f64) -> f64 {
    CUBE[0] / cells
}

/// Vertical thickness of the release [m].
fn thickness() -> f64 {
    RELEASE[0] / INCLINATION_DEG.to_radians().cos()
}

fn channel(cells: f64) -> Value {
    let [thickness_along_normal, length, toe] = RELEASE;
    json!({
        "channel": {"inclination_deg": INCLINATION_DEG, "incline_length_m": LENGTHS[0],
                    "runout_length_m": LENGTHS[1], "width_m": WIDTHS[0]},
        "flow": {"volume_m3": thickness() * length * WIDTHS[0],
                 "release": {"height_m": thickness_along_normal, "toe_distance_m": toe}},
        "bodies": [{"shape": {"cube": {"side_m": CUBE[0]}}, "position": {"downstream_m": CUBE[1]}}],
        "duration_s": TIMES[1], "numerics": {"cell_size_m": cell_size(cells)}, "flow_snapshots": 0
    })
}

/// Foot of the slope in the middle of the map [m].
fn middle() -> [f64; 2] {
    [LENGTHS[0], 0.5 * (LENGTHS[0] + LENGTHS[1])]
}

fn on_map(cells: f64) -> Result<Scenario, CaseError> {
    let [_, length, toe] = RELEASE;
    let [foot, axis] = middle();
    let (front, back) = (foot - toe, foot - toe - length);
    let [low, high] = [-0.5, 0.5].map(|side| axis + side * WIDTHS[1]);
    let document = json!({
        "terrain": {"height_map": MAP, "coordinates": "local"},
        "flow": {"releases": [{
            "polygon_m": [[back, low], [front, low], [front, high], [back, high]],
            "thickness_m": thickness()
        }]},
        "bodies": [{"shape": {"cube": {"side_m": CUBE[0]}},
                    "position": {"east_m": foot + CUBE[1], "north_m": axis}}],
        "duration_s": TIMES[1], "numerics": {"cell_size_m": cell_size(cells)}, "flow_snapshots": 0
    });
    let mut maps = Maps::default();
    maps.insert(MAP, Arc::new(map()));
    Scenario::from_value_with(&document, &maps).map_err(|error| CaseError::Scene(error.to_string()))
}

/// Name of the map in the scenario.
const MAP: &str = "0000000000000000000000000000000000000000000000000000000000000022";

fn map() -> Raster {
    let count = ((LENGTHS[0] + LENGTHS[1]) / MAP_CELL).round() as usize;
    let tan = INCLINATION_DEG.to_radians().tan();
    Raster::sampled([count; 2], MAP_CELL, |x, _| {
        100.0 + (LENGTHS[0] - x).max(0.0) * tan
    })
}

/// Mean speed of the flow's middle strip at the first time, displacement and peak speed of the cube,
/// and front of the strip at the end, from the foot on.
fn measured(scenario: &Scenario, foot: [f64; 2]) -> Result<Answer<4>, CaseError> {
    let mut scenario = scenario.clone();
    scenario.numerics.ending = Ending::Full;
    let prepared = PreparedScene::whole(&scenario)?;
    let mut recorder = Recorder::of(&prepared);
    let mut run = Run::start(prepared.scene())?;
    recorder.start(&run.simulation);
    let mut speed = None;
    run.watch(TIMES[1], |simulation, report| {
        recorder.observe(simulation, report);
        if simulation.time_s() >= TIMES[0] && speed.is_none() {
            speed = Some(Strip::of(simulation, foot).speed());
        }
        ControlFlow::Continue(())
    })?;
    let outcome = recorder.outcome(&run.simulation, 0.0);
    let cube = &outcome.bodies[0];
    let front = Strip::of(&run.simulation, foot).front();
    let speed = speed.ok_or(CaseError::Never("the flow is looked at"))?;
    Ok(run.answer([speed, cube.displacement_m, cube.peak_speed_m_s, front]))
}

/// Points of the middle strip: x from the foot on [m], velocity along it [m/s], mass [kg].
struct Strip(Vec<[f64; 3]>);

impl Strip {
    fn of(simulation: &Simulation, [foot, axis]: [f64; 2]) -> Self {
        let mut points = Vec::new();
        simulation.visit_points(None, |point| {
            if (point.position.y - axis).abs() < STRIP {
                points.push([point.position.x - foot, point.velocity.x, point.mass]);
            }
        });
        Self(points)
    }

    fn mass(&self) -> f64 {
        self.0.iter().map(|[_, _, mass]| mass).sum()
    }

    fn speed(&self) -> f64 {
        let momentum: f64 = self
            .0
            .iter()
            .map(|[_, velocity, mass]| velocity * mass)
            .sum();
        momentum / self.mass()
    }

    fn front(mut self) -> f64 {
        let mut left = FRONT_SHARE * self.mass();
        self.0.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
        let beyond = self.0.iter().find(|[_, _, mass]| {
            left -= mass;
            left <= 0.0
        });
        beyond.map_or(f64::NAN, |[x, ..]| *x)
    }
}
