//! Case 20: early stop.
//!
//! Members of a study – one slope and cube, with base friction, volume and the cube's yaw random –
//! scenes drawn at random (`drawn.rs`), and scenes with an open end nearby, each computed to its
//! early stop and once for its whole duration. Reference solution: the whole duration. Tolerance:
//! no body and no front moves on, and no more mass leaves, than the bound that the early stop came
//! with. How many stop early, how far they would have moved on, and the share of the point-steps
//! that is left are reported.

use crate::verify::dice::Dice;
use crate::verify::drawn;
use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::on_all_cores::side_by_side;
use crate::verify::run::{Answer, CaseError, Cost, scenario_of};
use crate::verify::{Case, Effort, How};
use scree_solver::compute;
use scree_solver::record::{BodyOutcome, Outcome};
use scree_solver::scenario::{Ending, Scenario};
use serde_json::{Value, json};

pub(super) const CASE: Case = Case {
    name: "early-stop",
    number: "20",
    title: "what an early stop leaves out stays within its bounds",
    source: "the same scenes for their whole duration",
    how: How::Runs(run),
};

/// Members of the study, and drawn scenes, small and full version.
const MEMBERS: [u64; 2] = [8, 100];
const DRAWN: [usize; 2] = [4, 40];
/// Scenes with a floor that most of the flow leaves, likewise.
const SHORT_FLOORS: [u64; 2] = [2, 60];
/// Number of the first drawn scene: those before are judged by the error bars.
const FIRST_DRAWN: u64 = 100;
/// Duration of all [s].
const DURATION: f64 = 3.0;

fn run(effort: Effort, findings: &mut Findings) {
    let size = usize::from(effort == Effort::Full);
    let members: Vec<Value> = (0..MEMBERS[size]).map(member).collect();
    judge("members of a study", &members, findings);
    let drawn = (FIRST_DRAWN..).map(drawn_scene);
    // A drawn body may stand in a side wall.
    let legal = drawn.filter(|scene| scenario_of(scene).is_ok());
    let drawn: Vec<Value> = legal.take(DRAWN[size]).collect();
    judge("drawn scenes", &drawn, findings);
    let short: Vec<Value> = (0..SHORT_FLOORS[size]).map(on_a_short_floor).collect();
    judge("scenes on a short floor", &short, findings);
}

fn member(number: u64) -> Value {
    let mut dice = Dice::of(number);
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2,
                    "base_friction": dice.within(0.3, 0.45)},
        "flow": {"volume_m3": dice.decades(0.0053, 0.012)},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}, "yaw_deg": dice.within(0.0, 90.0)}],
        "numerics": {"cell_size_m": 0.02}, "duration_s": DURATION, "flow_snapshots": 0
    })
}

fn on_a_short_floor(number: u64) -> Value {
    let mut dice = Dice::of(number);
    json!({
        "channel": {"inclination_deg": dice.within(28.0, 45.0), "incline_length_m": 0.8,
                    "runout_length_m": dice.within(0.1, 0.3), "base_friction": dice.within(0.3, 0.5)},
        "flow": {"volume_m3": dice.decades(0.004, 0.01), "release": {"height_m": 0.1}},
        "bodies": [],
        "numerics": {"cell_size_m": 0.014}, "duration_s": DURATION, "flow_snapshots": 0
    })
}

fn drawn_scene(number: u64) -> Value {
    let drawn = drawn::scene(number);
    let mut scenario = drawn.scenario;
    scenario["duration_s"] = json!(DURATION);
    scenario["numerics"] = json!({"cell_size_m": drawn.cell_size_m});
    scenario
}

/// Motion and work that one early stop leaves out.
#[derive(Debug, Clone, Copy)]
struct LeftOut {
    /// True if the run stopped early.
    early: bool,
    /// Farthest further way of a body and of the front [m], and further outflow [kg].
    ways: [f64; 3],
    /// The same over their bounds.
    over_bounds: [f64; 3],
    /// Point-steps of both runs.
    point_steps: [u64; 2],
}

fn left_out(scene: &Value) -> Result<LeftOut, CaseError> {
    let scenario = scenario_of(scene)?;
    let early = ended(&scenario, Ending::Auto)?;
    let full = ended(&scenario, Ending::Full)?;
    let bodies = early.bodies.iter().zip(&full.bodies);
    let body = bodies.map(|(early, full)| way(early, full));
    let front = early.flow.front_m.zip(full.flow.front_m);
    let mut left_out = LeftOut {
        early: early.ended_early.is_some(),
        ways: [0.0; 3],
        over_bounds: [0.0; 3],
        point_steps: [early.cost.point_steps, full.cost.point_steps],
    };
    if let Some(ended) = early.ended_early {
        let front = front.map_or(0.0, |(early, full)| (full - early).abs());
        let outflow = full.flow.outflow_mass_kg - early.flow.outflow_mass_kg;
        left_out.ways = [body.fold(0.0, f64::max), front, outflow.abs()];
        let bounds = [
            ended.body_bound_m,
            ended.front_bound_m.unwrap_or(0.0),
            ended.outflow_bound_kg.unwrap_or(0.0),
        ];
        left_out.over_bounds = [0, 1, 2].map(|of| match left_out.ways[of] {
            0.0 => 0.0,
            way => way / bounds[of],
        });
    }
    Ok(left_out)
}

fn ended(scenario: &Scenario, ending: Ending) -> Result<Outcome, CaseError> {
    let mut scenario = scenario.clone();
    scenario.numerics.ending = ending;
    compute(&scenario, 1, |_| {}).map_err(|error| match error {
        scree_solver::ComputeError::Setup(error) => error.into(),
        scree_solver::ComputeError::Step(error) => error.into(),
        _ => CaseError::Never("the run ends"),
    })
}

/// Distance between a body's places at the end of two runs [m].
fn way(early: &BodyOutcome, full: &BodyOutcome) -> f64 {
    let both = early.final_position_m.iter().zip(full.final_position_m);
    let squares = both.map(|(early, full)| (early - full).powi(2));
    squares.sum::<f64>().sqrt()
}

fn judge(what: &str, scenes: &[Value], findings: &mut Findings) {
    let mut all = Vec::new();
    for result in side_by_side(scenes, left_out) {
        match result {
            Ok(left_out) => all.push(left_out),
            Err(error) => {
                let question = Question::new(format!("{what}, computed"), "", 1.0);
                let failed: Result<Answer<1>, CaseError> = Err(error);
                findings.take(&Resolution::named("both runs"), [question], failed);
            }
        }
    }
    let most = |of: fn(&LeftOut) -> f64| all.iter().map(of).fold(0.0, f64::max);
    let early = all.iter().filter(|of| of.early).count();
    let steps = |run: usize| all.iter().map(|of| of.point_steps[run]).sum::<u64>() as f64;
    let absolute =
        |name: &str, unit| Question::new(format!("{name}, {what}"), unit, 0.0).by(Error::Absolute);
    let questions = [
        absolute("share that stops early", ""),
        absolute("farthest way of a body over its bound", "").within(1.0),
        absolute("farthest way of a front over its bound", "").within(1.0),
        absolute("largest outflow over its bound", "").within(1.0),
        absolute("farthest way of a body", "m"),
        absolute("farthest way of a front", "m"),
        absolute("largest outflow", "kg"),
        absolute("point-steps over those of the whole duration", ""),
    ];
    let values = [
        early as f64 / all.len() as f64,
        most(|of| of.over_bounds[0]),
        most(|of| of.over_bounds[1]),
        most(|of| of.over_bounds[2]),
        most(|of| of.ways[0]),
        most(|of| of.ways[1]),
        most(|of| of.ways[2]),
        steps(0) / steps(1),
    ];
    let resolution = Resolution::named(format!("{early} of {}", all.len()));
    let cost = Cost::default();
    findings.take(&resolution, questions, Ok(Answer { values, cost }));
}
