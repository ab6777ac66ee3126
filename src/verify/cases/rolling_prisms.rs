//! Case 6b: prisms of 6 to 32 sides roll down an incline.
//!
//! A rolling cylinder has the acceleration ⅔ g sin θ, and all of m g s sin θ as kinetic
//! energy. A prism of n sides loses energy at every edge that strikes: a rimless wheel that
//! rolls over inelastic edges loses the share 1 − ((i + cos 2π/n)/(i + 1))² with i = I/(m R²)
//! (McGeer 1990), so its loss over a given distance is proportional to 1/n and the prism tends to
//! the
//! cylinder. At 40° all of them also hop, so the wheel gives the scaling, not the amount,
//! and only after many edges have struck: six on 0.8 m are a matter of chance.
//!
//! Tolerances: for the unaccounted energy (38a), a thousandth of the energy released by gravity;
//! for acceleration and kinetic energy of 32 sides, a tenth below the cylinder's. The order in 1/n
//! is shown.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scene_of};
use crate::verify::scenes::{GRAVITY, channel, downhill};
use crate::verify::{Case, Effort, How};
use scree_solver::math::Vec3;
use scree_solver::rigid::{Body, InverseInertia, TurnedCore};
use scree_solver::shape::{SharpPolyhedron, SpheroPolyhedron};
use scree_solver::simulation::Scene;
use serde_json::json;
use std::f64::consts::TAU;
use std::ops::ControlFlow;

pub(super) const CASE: Case = Case {
    name: "rolling-prisms",
    number: "6b",
    title: "prisms of 6, 8, 16 and 32 sides roll down 40°",
    source: "⅔ g sin θ of a cylinder; losses of a rimless wheel (McGeer 1990)",
    how: How::Runs(run),
};

const SIDES: [u32; 4] = [6, 8, 16, 32];
const ANGLE: f64 = 40.0;
/// Radius of the circle of the edges before rounding, and length [m].
const RADIUS: f64 = 0.05;
const LENGTH: f64 = 0.1;
const SPHERO_RADIUS: f64 = 0.001;
/// Friction high enough that none slides.
const FRICTION: f64 = 2.0;
/// Distance travelled by the centre down the slope [m].
const WAY: f64 = 0.8;
/// Longest time that any of them takes [s].
const LONGEST: f64 = 2.0;

fn run(_: Effort, findings: &mut Findings) {
    let sin = ANGLE.to_radians().sin();
    for sides in SIDES {
        let rounded = sides == SIDES[SIDES.len() - 1];
        let tolerance = rounded.then_some(0.1);
        let questions = [
            Question {
                tolerance,
                ..Question::new(
                    "acceleration, mean over the way",
                    "m/s²",
                    GRAVITY * sin / 1.5,
                )
            },
            Question {
                tolerance,
                ..Question::new("kinetic energy over what gravity gave", "", 1.0)
            },
            Question::new("taken by contacts, over what gravity gave", "", 0.0).by(Error::Absolute),
            Question::new("made, over what gravity gave", "", 0.0)
                .by(Error::Absolute)
                .within(1e-3),
        ];
        let resolution = Resolution::sized(format!("{sides} sides"), 1.0 / f64::from(sides));
        findings.take(&resolution, questions, roll(sides));
    }
    for quantity in [
        "kinetic energy over what gravity gave",
        "taken by contacts, over what gravity gave",
    ] {
        findings.take_order(quantity, 1e-6, None);
    }
}

/// Acceleration, and shares of the energy released by gravity: kinetic energy, energy
/// dissipated by the contacts, and energy created.
fn roll(sides: u32) -> Result<Answer<4>, CaseError> {
    let mut run = Run::start(scene(sides)?)?;
    let start = run.simulation.bodies()[0].state.position;
    let way = |body: &Body| (body.state.position - start).dot(&downhill(ANGLE));
    run.watch(LONGEST, |simulation, _| {
        if way(&simulation.bodies()[0]) < WAY {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    })?;
    let body = &run.simulation.bodies()[0];
    let gone = way(body);
    if gone < WAY {
        return Err(CaseError::Never("it never rolled so far"));
    }
    let speed = body.velocity().dot(&downhill(ANGLE));
    let given = body.mass * GRAVITY * (start.z - body.state.position.z);
    let energy = run.simulation.body_energy(0);
    let shares = [body.kinetic_energy(), energy.dissipated, energy.made].map(|part| part / given);
    Ok(run.answer([
        speed * speed / (2.0 * gone),
        shares[0],
        shares[1],
        shares[2],
    ]))
}

/// The prism lying on a side, high on the slope.
fn scene(sides: u32) -> Result<Scene, CaseError> {
    let mut document = channel(ANGLE, 3.0, 1.0, 0.6);
    // A scenario has at most 32 vertices; for more sides they are set on the body afterwards.
    let vertices: Vec<[f64; 3]> = edges(16).into_iter().map(Into::into).collect();
    document["bodies"] = json!([{
        "shape": {"polyhedron": {"vertices_m": vertices}}, "sphero_radius_m": SPHERO_RADIUS,
        "position": {"downstream_m": -2.5}, "restitution": 0.0, "friction": FRICTION
    }]);
    document["duration_s"] = json!(LONGEST);
    document["numerics"] = json!({"ending": "full"});
    let mut scene = scene_of(&document)?;
    let shape = SharpPolyhedron::hull_of(&edges(sides))
        .and_then(|solid| solid.rounded(SPHERO_RADIUS))
        .map_err(|error| CaseError::Scene(error.to_string()))?;
    let body = &mut scene.bodies[0];
    let density = body.mass / body.shape.volume();
    body.mass = density * shape.volume();
    body.inertia = shape.unit_inertia() * density;
    body.inverse_inertia = InverseInertia::of(&body.inertia)
        .ok_or_else(|| CaseError::Scene("a prism without inertia".to_owned()))?;
    let down = downhill(ANGLE);
    let normal = Vec3::new(-down.z, 0.0, down.x);
    let low = |shape: &SpheroPolyhedron, body: &Body| shape.extent_along(&body.to_body(&-normal));
    let lower = low(&shape, body) - low(&body.shape, body);
    body.state.position += normal * lower;
    body.state.springs.clear();
    body.turned_core = TurnedCore::default();
    body.shape = shape;
    Ok(scene)
}

/// Ends of the edges along y, with a side at the bottom.
fn edges(sides: u32) -> Vec<Vec3> {
    let angle = |side: u32| (f64::from(side) + 0.5) * TAU / f64::from(sides);
    let end = |side: u32, y: f64| {
        let (sin, cos) = angle(side).sin_cos();
        Vec3::new(RADIUS * sin, y, -RADIUS * cos)
    };
    (0..sides)
        .flat_map(|side| [end(side, -0.5 * LENGTH), end(side, 0.5 * LENGTH)])
        .collect()
}
