//! Case 3: an undamped impact.
//!
//! A ball of mass m meets a rigid plane at the speed v. With Hertz's force k δ^1.5,
//! k = 4/3 E* √R, conservation of energy gives the largest overlap, and a quadrature the duration
//! (Hertz 1882):
//!
//! δ = (5 m v²/4k)^⅖,  F = k δ^1.5,  t = 2 ∫₀¹ dx/√(1 − x^2.5) δ/v = 2.943275 δ/v,
//!
//! and it rebounds with v. The ball is the rounded vertex of a cube whose diagonal
//! is vertical, so that the force passes through its centre; the next vertices
//! stay far from the plane. m 0.0642 kg, R 0.01 m, E* 1e8 Pa, v 1 m/s give
//! 0.51499 mm, 155.83 N, 1.51573 ms. Tolerance: 0.1 %, at every step; for the
//! rebound also in the solver's own steps. Velocity Verlet has order 2;
//! Hertz's force is almost smooth enough at δ = 0 for it.

use crate::verify::findings::{Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run};
use crate::verify::scenes::{height_of_touch, on_vertex, thrown_down};
use crate::verify::{Case, Effort, How};
use scree_solver::shape::SpheroPolyhedron;
use scree_solver::simulation::Scene;
use serde_json::json;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "hertz-impact",
    number: "3",
    title: "undamped impact of a round vertex on the floor",
    source: "Hertz 1882: δ = (5 m v²/4k)^0.4, t = 2.943275 δ/v, F = k δ^1.5",
    how: How::Runs(run),
};

const MASS: f64 = 0.0642;
const RADIUS: f64 = 0.01;
const MODULUS: f64 = 1e8;
const SPEED: f64 = 1.0;

/// Steps per impact.
const STEPS: [u32; 5] = [100, 200, 400, 800, 1600];

fn run(effort: Effort, findings: &mut Findings) {
    let stiffness = 4.0 / 3.0 * MODULUS * RADIUS.sqrt();
    let deepest = (1.25 * MASS * SPEED * SPEED / stiffness).powf(0.4);
    let duration = 2.943_275 * deepest / SPEED;
    for &steps in effort.take(&STEPS, 4) {
        let questions = [
            Question::new("deepest overlap", "mm", deepest * 1e3),
            Question::new("duration", "ms", duration * 1e3),
            Question::new("largest force", "N", stiffness * deepest.powf(1.5)),
            Question::new("rebound speed", "m/s", SPEED),
        ];
        let questions = questions.map(|question| question.within(1e-3));
        let step = duration / f64::from(steps);
        let resolution = Resolution::sized(format!("t/{steps}"), step);
        findings.take(&resolution, questions, impact(step));
    }
    for quantity in ["deepest overlap", "duration", "largest force"] {
        findings.take_order(quantity, 1e-9, None);
    }
    let question = Question::new("rebound speed, own steps", "m/s", SPEED).within(1e-3);
    let answer = impact(1.0).map(|answer| Answer {
        values: [answer.values[3]],
        cost: answer.cost,
    });
    findings.take(
        &Resolution::named("as the solver chooses"),
        [question],
        answer,
    );
}

/// Deepest overlap [mm], duration [ms], largest force [N] and rebound speed
/// [m/s], seen at steps no longer than `step` [s].
fn impact(step: f64) -> Result<Answer<4>, CaseError> {
    let mut run = Run::start(scene(step)?)?;
    let touch = height_of_touch(&run.simulation.bodies()[0]);
    let (mut deepest, mut strongest) = (0.0f64, 0.0f64);
    let (mut before, mut end) = ((0.0, 0.0), None);
    run.watch(f64::INFINITY, |simulation, report| {
        let state = &simulation.bodies()[0].state;
        let overlap = touch - state.position.z;
        deepest = deepest.max(overlap);
        strongest = strongest.max(state.wall_load.force.z);
        if overlap <= 0.0 {
            let (time, last) = before;
            end = Some(time + (report.time_s - time) * last / (last - overlap));
            return ControlFlow::Break(());
        }
        before = (report.time_s, overlap);
        ControlFlow::Continue(())
    })?;
    let end = end.ok_or(CaseError::Never("the body never left the floor"))?;
    let speed = run.simulation.bodies()[0].velocity().z;
    Ok(run.answer([deepest * 1e3, end * 1e3, strongest, speed]))
}

fn scene(step: f64) -> Result<Scene, CaseError> {
    let side = 0.04;
    let cube = SpheroPolyhedron::cube(side, RADIUS)
        .map_err(|error| CaseError::Scene(error.to_string()))?;
    let mut scene = thrown_down(&json!({
        "shape": {"cube": {"side_m": side}}, "sphero_radius_m": RADIUS,
        "density_kg_m3": MASS / cube.volume(), "orientation": on_vertex(),
        "velocity_m_s": [0.0, 0.0, -SPEED], "contact_modulus_pa": MODULUS,
        "restitution": 1.0
    }))?;
    scene.given.timing.longest_substep = step;
    Ok(scene)
}
