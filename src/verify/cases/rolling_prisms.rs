//! Case 6b: prisms of 6 to 32 sides roll down an incline.
//!
//! A cylinder that rolls has the acceleration ⅔ g sin θ, and all of m g s sin θ as kinetic
//! energy. A prism of n sides loses some at every edge that strikes: of a rimless wheel that
//! rolls over inelastic edges the share 1 − ((i + cos 2π/n)/(i + 1))² with i = I/(m R²)
//! (McGeer 1990), so that what it loses on the same way goes with 1/n and the prism becomes the
//! cylinder. At 40° all of them hop as well, so the wheel says by what law, not by how much,
//! and that only once many edges have struck: six on 0.8 m are a matter of chance.
//!
//! Tolerances: what nothing accounts for (38a), a thousandth of the energy that gravity gave;
//! acceleration and kinetic energy of 32 sides, a tenth below the cylinder's. The order in 1/n
//! is shown.

use crate::verify::findings::{Error, Findings, Question, Resolution};
use crate::verify::run::{Answer, CaseError, Run, scene_of};
use crate::verify::scenes::{GRAVITY, channel, downhill};
use crate::verify::{Case, Effort, How};
use scree_solver::math::Vec3;
use scree_solver::rigid::{Body, InverseInertia};
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
/// Radius of the circle that the edges lie on before rounding, and length [m].
const RADIUS: f64 = 0.05;
const LENGTH: f64 = 0.1;
const SPHERO_RADIUS: f64 = 0.001;
/// Enough for none to slide.
const FRICTION: f64 = 2.0;
/// Way of the centre down the slope [m].
const WAY: f64 = 0.8;
/// None takes longer for it [s].
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

/// Acceleration, and shares of the energy that gravity gave: what it moves with, what its
/// contacts took, and what was made.
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

/// Lying on a side, high on the slope.
fn scene(sides: u32) -> Result<Scene, CaseError> {
    let mut document = channel(ANGLE, 3.0, 1.0, 0.6);
    // A scenario holds 32 places at most; more sides are put on the body then.
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
    body.shape = shape;
    Ok(scene)
}

/// Ends of the edges along y, a side lowest.
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
