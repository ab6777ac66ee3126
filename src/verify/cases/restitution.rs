//! Case 4: restitution.
//!
//! A body that falls on one vertex below its centre rebounds with e times its impact
//! speed: the damping number of the contact law is solved
//! for this. The same is asked of a fall on an edge and on a face, where two and four
//! vertices touch at a time and share the mass they stop. Tolerance: 2 % of e.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::{on_vertex, thrown_down};
use crate::verify::{Case, Effort, How};
use serde_json::json;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "restitution",
    number: "4",
    title: "rebound of a cube that falls on a vertex, an edge, a face",
    source: "definition: speed of leaving over speed of arriving is the e asked for",
    how: How::Runs(run),
};

const UPRIGHT: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
/// Orientation with an edge along y below: a turn of 45° about y.
const ON_EDGE: [f64; 4] = [0.923_879_532_511_286_7, 0.0, 0.382_683_432_365_089_8, 0.0];

fn run(effort: Effort, findings: &mut Findings) {
    let asked = [0.1, 0.3, 0.5, 0.7, 0.9, 1.0, 0.2, 0.4, 0.6, 0.8];
    for (word, orientation) in [
        ("a vertex", on_vertex()),
        ("an edge", ON_EDGE),
        ("a face", UPRIGHT),
    ] {
        for &restitution in effort.take(&asked, 6) {
            let quantity = format!("rebound on {word}, e {restitution}");
            let question = Question::new(quantity, "", restitution).within(0.02);
            let answer = rebound(orientation, restitution);
            findings.take(&Resolution::named("own steps"), [question], answer);
        }
    }
}

fn rebound(orientation: [f64; 4], restitution: f64) -> Result<Answer<1>, CaseError> {
    let scene = thrown_down(&json!({"orientation": orientation, "restitution": restitution}))?;
    let mut run = Run::start(scene)?;
    run.watch(f64::INFINITY, |simulation, _| {
        let body = &simulation.bodies()[0];
        if body.velocity().z > 0.0 && body.state.wall_energy == 0.0 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    })?;
    // The impact speed is 1 m/s.
    let speed = run.simulation.bodies()[0].velocity().z;
    Ok(run.answer([speed]))
}
