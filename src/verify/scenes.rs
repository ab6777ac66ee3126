//! Scenes that a scenario can express, as JSON.

use super::run::{CaseError, scene_of};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use scree_solver::rigid::Body;
use scree_solver::simulation::Scene;
use serde_json::{Value, json};

/// Gravity of every scenario here [m/s²].
pub(super) const GRAVITY: f64 = 9.81;

/// Precisions in which a flow can be computed.
pub(super) const PRECISIONS: [&str; 2] = ["double", "single"];

/// A channel with neither flow nor bodies, lengths in metres.
pub(super) fn channel(inclination_deg: f64, incline_m: f64, runout_m: f64, width_m: f64) -> Value {
    json!({
        "channel": {"inclination_deg": inclination_deg, "incline_length_m": incline_m,
                    "runout_length_m": runout_m, "width_m": width_m},
        "gravity_m_s2": GRAVITY, "flow": null, "bodies": []
    })
}

/// A cube of 40 mm, just touching a flat floor, that moves down into it at 1 m/s
/// without gravity or friction; `body` adds to its description or overrides it.
pub(super) fn thrown_down(body: &Value) -> Result<Scene, CaseError> {
    let mut document = channel(0.0, 0.5, 0.5, 0.2);
    let mut cube = json!({"shape": {"cube": {"side_m": 0.04}},
        "position": {"downstream_m": 0.1, "elevation_m": 0.1},
        "velocity_m_s": [0.0, 0.0, -1.0], "friction": 0.0});
    for (key, value) in body.as_object().into_iter().flatten() {
        cube[key] = value.clone();
    }
    document["bodies"] = json!([cube]);
    document["duration_s"] = json!(1.0);
    let mut scene = scene_of(&document)?;
    scene.given.gravity = Vec3::zeros();
    let body = &mut scene.bodies[0];
    body.state.position.z = height_of_touch(body);
    Ok(scene)
}

/// Height of a body's centre at contact with the floor, in its present orientation [m].
pub(super) fn height_of_touch(body: &Body) -> f64 {
    body.shape.extent_along(&body.to_body(&-Vec3::z()))
}

/// Orientation in which a cube stands on a vertex: its diagonal (1, 1, 1) is vertical.
pub(super) fn on_vertex() -> [f64; 4] {
    // About (1, −1, 0)/√2 by acos(1/√3).
    let half = 0.5 * (1.0f64 / 3.0).sqrt().acos();
    let part = half.sin() / 2f64.sqrt();
    [half.cos(), part, -part, 0.0]
}

/// Unit vector down a slope.
pub(super) fn downhill(inclination_deg: f64) -> Vec3 {
    let (sin, cos) = inclination_deg.to_radians().sin_cos();
    Vec3::new(cos, 0.0, -sin)
}

/// Gravity of a slope whose surface is horizontal in the scene [m/s²].
pub(super) fn tilted_gravity(inclination_deg: f64) -> Vec3 {
    let (sin, cos) = inclination_deg.to_radians().sin_cos();
    Vec3::new(sin, 0.0, -cos) * GRAVITY
}

/// A body with this description, in a channel of its own.
pub(super) fn body(description: &Value) -> Result<Body, CaseError> {
    let mut document = channel(0.0, 1.0, 1.0, 1.0);
    document["bodies"] = json!([description]);
    document["duration_s"] = json!(1.0);
    let body = scene_of(&document)?.bodies.pop();
    body.ok_or(CaseError::Never("there is no body"))
}

/// Velocity of the flow's mass centre [m/s].
pub(super) fn mean_velocity(simulation: &Simulation) -> Vec3 {
    let (mut mass, mut momentum) = (0.0, Vec3::zeros());
    simulation.visit_points(None, |point| {
        mass += point.mass;
        momentum += point.velocity * point.mass;
    });
    momentum / mass
}
