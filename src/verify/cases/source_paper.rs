//! Case 16: the source paper's scene.
//!
//! A cube of 4 cm at the foot of an incline is struck and carried by a dry flow.
//! Its motion was measured: it sets off at about 0.17 s, peaks once, at 1.08 m/s,
//! and comes to rest (Ji, Liang & Choi, figure 7). Inclination, volume and
//! materials are not given; ours were chosen to match these two values closely at four
//! cells per side (docs/source-paper.md), so the comparison
//! proves nothing. No tolerance.
//!
//! The case shows how the answer depends on the computation: the limit of each
//! quantity as cells get finer, with the values of every resolution (or only
//! the finest value if they don't settle); and the effect of the lengths of step and sub-step,
//! neither of which is part of the problem. Tolerance: peak and
//! displacement change by less than 1 % when either is halved and halved again.
//! Twice the sound speed, and Drucker–Prager's law instead of μ(I), change the
//! problem; their effects are shown without a tolerance.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::limit::limit_or_finest;
use crate::verify::paper::{QUANTITIES, limits_of, motion, scene};
use crate::verify::run::{Answer, CaseError};
use crate::verify::{Case, Effort, How};
use serde_json::{Value, json};

pub(super) const CASE: Case = Case {
    name: "source-paper",
    number: "16",
    title: "the source paper's cube, and how its motion depends on the computation",
    source: "onset 0.17 s, peak 1.08 m/s (Ji, Liang & Choi); its own limits",
    how: How::Runs(run),
};

/// Measured onset [s] and peak speed [m/s].
const MEASURED: [f64; 2] = [0.17, 1.08];
/// Cells per side of the cube.
const CELLS: [f64; 6] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0];

type Motion = Result<Answer<4>, CaseError>;

fn run(effort: Effort, findings: &mut Findings) {
    let cells = effort.take(&CELLS, 3);
    let motions: Vec<Motion> = cells.iter().map(|&cells| motion(&scene(cells))).collect();
    let references = limits(cells, &motions);
    for (&cells, motion) in cells.iter().zip(motions) {
        resolved(cells, &references, motion, findings);
    }
    for (name, _) in QUANTITIES {
        findings.take_limit(name);
    }
    let cells = match effort {
        Effort::Quick => 1.0,
        Effort::Full => 3.0,
    };
    influences(cells, findings);
}

/// Limit of each quantity, or its finest value.
fn limits(cells: &[f64], motions: &[Motion]) -> [f64; 4] {
    [0, 1, 2, 3].map(|quantity: usize| {
        let place = |(cells, motion): (&f64, &Motion)| {
            let value = motion.as_ref().ok()?.values[quantity];
            Some((1.0 / cells, value))
        };
        let places: Vec<_> = cells.iter().zip(motions).filter_map(place).collect();
        limit_or_finest(&places)
    })
}

fn resolved(cells: f64, references: &[f64; 4], motion: Motion, findings: &mut Findings) {
    let resolution = Resolution::sized(format!("{cells} cells a side"), 1.0 / cells);
    let measured = |place: usize| {
        let (name, unit) = QUANTITIES[place];
        Question::new(format!("{name}, against the paper"), unit, MEASURED[place])
    };
    let own = |place: usize| {
        let (name, unit) = QUANTITIES[place];
        Question::new(name, unit, references[place])
    };
    let questions = [measured(0), measured(1), own(0), own(1), own(2), own(3)];
    let motion = motion.map(|Answer { values, cost }| {
        let [onset, peak, way, rest] = values;
        let values = [onset, peak, onset, peak, way, rest];
        Answer { values, cost }
    });
    findings.take(&resolution, questions, motion);
}

/// Finds the effects of other parameters on the cube's motion, relative to the original scene.
fn influences(cells: f64, findings: &mut Findings) {
    let references = match motion(&scene(cells)) {
        Ok(answer) => answer.values,
        Err(_) => [f64::NAN; 4],
    };
    let resolution = Resolution::named(format!("{cells} cells a side"));
    let mut take = |what: &str, tolerance: Option<f64>, scene: &Value| {
        let question = |place: usize| {
            let (name, unit) = QUANTITIES[place];
            let question = Question::new(format!("{name}, {what}"), unit, references[place]);
            tolerance.map_or(question.clone(), |tolerance| question.within(tolerance))
        };
        let motion = motion(scene).map(|Answer { values, cost }| Answer {
            values: [values[1], values[2]],
            cost,
        });
        findings.take(&resolution, [question(1), question(2)], motion);
    };
    let chosen = limits_of(&scene(cells));
    let (courant, flow_courant, sound_speed) = match chosen {
        Ok(limits) => (limits.courant, limits.flow_courant, limits.sound_speed),
        Err(_) => (f64::NAN, f64::NAN, f64::NAN),
    };
    let numerics = |key: &str, value: f64| {
        let mut scene = scene(cells);
        scene["numerics"][key] = json!(value);
        scene
    };
    for (what, factor) in [("courant ×½", 0.5), ("courant ×¼", 0.25)] {
        take(what, Some(0.01), &numerics("courant", factor * courant));
    }
    for (what, factor) in [
        ("flow_courant ×2", 2.0),
        ("flow_courant ×½", 0.5),
        ("flow_courant ×¼", 0.25),
    ] {
        take(
            what,
            Some(0.01),
            &numerics("flow_courant", factor * flow_courant),
        );
    }
    take(
        "sound speed ×2",
        None,
        &numerics("sound_speed_m_s", 2.0 * sound_speed),
    );
    take("Drucker–Prager", None, &without_rate(cells));
}

/// The scene with the same friction at every shear rate.
fn without_rate(cells: f64) -> Value {
    let mut scene = scene(cells);
    let material = &mut scene["flow"]["material"];
    material["limiting_friction"] = material["static_friction"].clone();
    scene
}
