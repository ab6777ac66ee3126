//! Errors of plans: wall time and memory of ten scenes, from small flows to three million points.

use super::Effort;
use super::own_process;
use super::stopwatch::median;
use crate::cli::columns::table;
use crate::cli::failure::{Failure, not_set_up};
use crate::cli::machine::cores;
use scree::jobs::forecast::{Planned, forecast};
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
    /// Planned memory [bytes].
    planned_bytes: u64,
    /// Growth of resident memory, median of the runs [bytes]; null where the system does not tell.
    used_bytes: Option<f64>,
}

/// A scene: its name, inclination [°], volume [m³], height [m], width [m], cell size [m],
/// duration [s], and all else.
pub(super) type Given = (&'static str, [f64; 6], fn(&mut Value));

pub(super) const SCENES: [Given; 10] = [
    ("bare", [35.0, 0.016, 0.12, 0.28, 0.01, 0.8], |_| {}),
    (
        "bare, wide, fine",
        [22.0, 0.12, 0.25, 0.96, 0.01, 0.5],
        |_| {},
    ),
    (
        "narrow, long way",
        [38.0, 0.0025, 0.1, 0.04, 0.005, 0.4],
        |_| {},
    ),
    ("cube", [45.0, 0.009, 0.12, 0.24, 0.01, 0.6], |scene| {
        scene["bodies"] = json!([cube(0.1, 0.0)]);
    }),
    (
        "two cubes aside, error bars",
        [48.0, 0.008, 0.12, 0.28, 0.0125, 0.6],
        |scene| {
            scene["bodies"] = json!([cube(0.08, 0.06), cube(0.2, -0.05)]);
            scene["accuracy"] = json!({"error_bars": true});
        },
    ),
    (
        "40 icosahedra",
        [45.0, 0.01, 0.12, 0.3, 0.01, 0.4],
        |scene| {
            scene["bodies"] = (0..40).map(icosahedron).collect();
        },
    ),
    (
        "cube aside, double",
        [36.0, 0.011, 0.12, 0.3, 0.01, 0.3],
        |scene| {
            scene["bodies"] = json!([cube(0.05, 0.03)]);
            scene["numerics"]["precision"] = json!("double");
        },
    ),
    (
        "cube aside, one point per cell",
        [40.0, 0.018, 0.12, 0.4, 0.006, 0.25],
        |scene| {
            scene["bodies"] = json!([cube(0.06, 0.05)]);
            scene["numerics"]["points_per_cell"] = json!(1);
        },
    ),
    (
        "no reductions",
        [42.0, 0.05, 0.2, 0.4, 0.01, 0.15],
        |scene| {
            scene["bodies"] = json!([cube(0.1, 0.0)]);
            without_reductions(scene);
        },
    ),
    (
        "no reductions, wide, fine",
        [10.0, 0.38, 0.4, 1.1, 0.01, 0.02],
        without_reductions,
    ),
];

fn cube(x: f64, y: f64) -> Value {
    json!({"shape": {"cube": {"side_m": 0.05}},
           "position": {"downstream_m": x, "lateral_m": y}})
}

/// One of many in rows of five.
fn icosahedron(place: usize) -> Value {
    let (row, column) = (place / 5, place % 5);
    json!({"shape": {"regular": {"solid": "icosahedron", "size_m": 0.02}},
           "position": {"downstream_m": 0.05 + 0.06 * row as f64,
                        "lateral_m": -0.12 + 0.06 * column as f64}})
}

fn without_reductions(scene: &mut Value) {
    scene["numerics"]["symmetry"] = json!("full");
    scene["numerics"]["approach"] = json!("full");
}

/// Forecasts and runs every scene.
pub(super) fn measure(effort: &Effort) -> Result<Forecasts, Failure> {
    let scenes = SCENES.iter().map(|given| {
        let scenario = scenario(given)?;
        Foretold::of(given.0, &scenario, effort.repeats)
    });
    Ok(Forecasts {
        threads: cores(),
        scenes: scenes.collect::<Result<_, Failure>>()?,
    })
}

pub(super) fn scenario((scene, numbers, change): &Given) -> Result<Scenario, Failure> {
    let [inclination, volume, height, width, cell, duration] = *numbers;
    let mut document = json!({
        "channel": {"inclination_deg": inclination, "incline_length_m": 1.2,
                    "runout_length_m": 1.5, "width_m": width},
        "flow": {"volume_m3": volume, "release": {"height_m": height, "toe_distance_m": 0.1}},
        "bodies": [], "duration_s": duration, "flow_snapshots": 0,
        "numerics": {"cell_size_m": cell}
    });
    change(&mut document);
    Scenario::from_json(&document.to_string())
        .map_err(|error| Failure::Other(format!("the scene {scene:?} is refused: {error:?}")))
}

fn planned(scenario: &Scenario) -> Result<Planned, Failure> {
    let prepared = PreparedScene::of(scenario).map_err(|error| not_set_up(&error))?;
    let plan = Plan::of(&prepared);
    let cancellation = Cancellation::default();
    Ok(forecast(&prepared.scenario, plan, cores(), &cancellation)?)
}

impl Foretold {
    fn of(scene: &'static str, scenario: &Scenario, repeats: u32) -> Result<Self, Failure> {
        let (mut expected, mut took, mut used) = (Vec::new(), Vec::new(), Vec::new());
        let (mut points, mut planned_bytes) = (0, 0);
        let (mut expected_end_s, mut ended_s) = (0.0, 0.0);
        for _ in 0..repeats {
            let Planned {
                plan, wall_time, ..
            } = planned(scenario)?;
            points = plan.cost.points;
            planned_bytes = plan.cost.memory_bytes;
            expected_end_s = plan.cost.expected_end_s;
            expected.extend(wall_time.expected_s);
            let run = own_process::run(scenario, cores())?;
            took.push(run.wall_s);
            used.extend(run.memory_bytes.map(|bytes| bytes as f64));
            ended_s = run
                .outcome
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
            planned_bytes,
            used_bytes: (!used.is_empty()).then(|| median(used)),
        })
    }

    fn row(&self) -> [String; 10] {
        let planned = self.planned_bytes as f64;
        let known = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        [
            self.scene.to_owned(),
            self.points.to_string(),
            format!("{:.1}", 1e-6 * planned),
            known(self.used_bytes.map(|used| format!("{:.1}", 1e-6 * used))),
            known(self.used_bytes.map(|used| off(planned, used))),
            format!("{:.2}", self.expected_s),
            format!("{:.2}", self.took_s),
            off(self.expected_s, self.took_s),
            format!("{:.2}", self.expected_end_s),
            format!("{:.2}", self.ended_s),
        ]
    }
}

/// Relative error of a forecast.
fn off(foretold: f64, actual: f64) -> String {
    format!("{:+.0} %", 100.0 * (foretold / actual - 1.0))
}

impl Forecasts {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!(
            "forecast: memory and wall time, foretold and actual, {} threads",
            self.threads
        );
        let headings = [
            "scene",
            "points",
            "planned MB",
            "used MB",
            "off",
            "foretold s",
            "took s",
            "off",
            "foretold end s",
            "ended s",
        ];
        table(&title, headings, self.scenes.iter().map(Foretold::row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_legal() {
        for given in &SCENES {
            let scenario = scenario(given).unwrap();
            assert!(PreparedScene::of(&scenario).is_ok(), "{}", given.0);
        }
    }
}
