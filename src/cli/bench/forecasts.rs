//! Errors of forecasts of wall time, on ten scenes that were not used to tune the forecast.

use super::Effort;
use super::plan::timed;
use super::stopwatch::median;
use crate::cli::columns::table;
use crate::cli::failure::{Failure, not_set_up};
use crate::cli::machine::cores;
use scree::jobs::forecast::forecast;
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Cancellation, Plan};
use serde::Serialize;
use serde_json::{Value, json};

/// Scenes, their runs and their forecasts.
#[derive(Debug, Serialize)]
pub(super) struct Forecasts {
    threads: usize,
    scenes: Vec<Foretold>,
}

#[derive(Debug, Serialize)]
struct Foretold {
    scene: &'static str,
    points: u64,
    expected_s: f64,
    /// Median of the runs.
    took_s: f64,
    /// Expected and actual end of the run: simulated time [s].
    expected_end_s: f64,
    ended_s: f64,
}

/// A scene: its name, inclination [°], volume [m³], width [m], cell size [m],
/// duration [s], and bodies.
type Given = (&'static str, [f64; 5], fn() -> Value);

fn cube(x: f64, y: f64) -> Value {
    json!({"shape": {"cube": {"side_m": 0.05}},
           "position": {"downstream_m": x, "lateral_m": y}})
}

const SCENES: [Given; 10] = [
    ("bare, 30°", [30.0, 0.004, 0.2, 0.02, 1.0], || json!([])),
    ("bare, 45°, wide", [45.0, 0.008, 0.4, 0.02, 0.8], || {
        json!([])
    }),
    ("bare, flat", [0.0, 0.006, 0.24, 0.02, 1.0], || json!([])),
    ("cube, 35°", [35.0, 0.005, 0.2, 0.02, 1.5], || {
        json!([cube(0.1, 0.0)])
    }),
    ("cube, 55°", [55.0, 0.004, 0.24, 0.02, 1.0], || {
        json!([cube(0.2, 0.0)])
    }),
    ("cube aside", [40.0, 0.005, 0.28, 0.02, 1.0], || {
        json!([cube(0.1, 0.06)])
    }),
    ("two cubes", [45.0, 0.006, 0.24, 0.02, 1.2], || {
        json!([cube(0.08, 0.05), cube(0.2, -0.05)])
    }),
    ("finer cube", [45.0, 0.003, 0.16, 0.0133, 0.6], || {
        json!([cube(0.08, 0.0)])
    }),
    ("long way", [38.0, 0.003, 0.2, 0.02, 2.5], || {
        json!([cube(0.3, 0.0)])
    }),
    ("far cube", [42.0, 0.006, 0.2, 0.02, 0.5], || {
        json!([cube(1.0, 0.0)])
    }),
];

/// Forecasts and runs every scene.
pub(super) fn measure(effort: &Effort) -> Result<Forecasts, Failure> {
    let mut scenes = Vec::new();
    for given in &SCENES {
        scenes.push(Foretold::of(given, effort.repeats)?);
    }
    Ok(Forecasts {
        threads: cores(),
        scenes,
    })
}

impl Foretold {
    fn of((scene, numbers, bodies): &Given, repeats: u32) -> Result<Self, Failure> {
        let [inclination, volume, width, cell, duration] = *numbers;
        let document = json!({
            "channel": {"inclination_deg": inclination, "incline_length_m": 1.0,
                        "runout_length_m": 1.5, "width_m": width},
            "flow": {"volume_m3": volume, "release": {"height_m": 0.12, "toe_distance_m": 0.1}},
            "bodies": bodies(), "duration_s": duration, "flow_snapshots": 0,
            "numerics": {"cell_size_m": cell}
        });
        let scenario = Scenario::from_json(&document.to_string()).map_err(|error| {
            Failure::Other(format!("the scene {scene:?} is refused: {error:?}"))
        })?;
        let (mut expected, mut took) = (Vec::new(), Vec::new());
        let (mut points, mut expected_end_s, mut ended_s) = (0, 0.0, 0.0);
        for _ in 0..repeats {
            let prepared = PreparedScene::of(&scenario).map_err(|error| not_set_up(&error))?;
            let planned = forecast(
                &prepared.scenario,
                Plan::of(&prepared),
                cores(),
                &Cancellation::default(),
            )?;
            points = planned.plan.cost.points;
            expected_end_s = planned.plan.cost.expected_end_s;
            expected.extend(planned.wall_time.expected_s);
            let (wall_s, outcome) = timed(&scenario, cores())?;
            took.push(wall_s);
            ended_s = outcome
                .ended_early
                .map_or(scenario.duration_s, |ended| ended.time_s);
        }
        Ok(Self {
            scene,
            points,
            expected_s: median(expected),
            took_s: median(took),
            expected_end_s,
            ended_s,
        })
    }

    fn row(&self) -> [String; 7] {
        [
            self.scene.to_owned(),
            self.points.to_string(),
            format!("{:.2}", self.expected_s),
            format!("{:.2}", self.took_s),
            format!("{:.2}", self.expected_end_s),
            format!("{:.2}", self.ended_s),
            format!("{:+.0} %", 100.0 * (self.expected_s / self.took_s - 1.0)),
        ]
    }
}

impl Forecasts {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!(
            "forecast: wall time foretold and taken, {} threads",
            self.threads
        );
        let headings = [
            "scene",
            "points",
            "foretold s",
            "took s",
            "foretold end s",
            "ended s",
            "off",
        ];
        table(&title, headings, self.scenes.iter().map(Foretold::row))
    }
}
