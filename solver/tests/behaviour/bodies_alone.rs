//! Bodies without a flow: docs/accuracy.md, cases 1, 4 and 6.

use crate::scenes::{Scene, run, watch};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;

fn cube(friction: f64, position: &Value) -> Value {
    json!({"shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002,
           "position": position, "friction": friction})
}

/// A cube resting flat on a slope 4 m long, 0.3 m below its top.
fn on_slope(inclination_deg: f64, friction: f64, duration_s: f64) -> Scene {
    Scene::channel(inclination_deg, 4.0, 1.0, 0.2)
        .body(cube(friction, &json!({"downstream_m": -3.7})))
        .lasting(duration_s)
}

fn down(inclination_deg: f64) -> Vec3 {
    let (sin, cos) = inclination_deg.to_radians().sin_cos();
    Vec3::new(cos, 0.0, -sin)
}

/// A cube in the air over a flat floor.
fn dropped(orientation: &Value, elevation_m: f64, restitution: f64) -> Scene {
    let place = json!({"downstream_m": 0.5, "elevation_m": elevation_m});
    Scene::channel(0.0, 0.5, 1.0, 0.2)
        .body(cube(0.4, &place))
        .first_body("restitution", restitution)
        .first_body("orientation", orientation.clone())
        .lasting(1.0)
}

/// Orientation of a cube standing on a vertex: its diagonal (1, 1, 1) turned to the vertical.
fn on_vertex() -> Value {
    // About (1, −1, 0)/√2 by acos(1/√3).
    let half = 0.5 * (1.0f64 / 3.0).sqrt().acos();
    let part = half.sin() / 2f64.sqrt();
    json!([half.cos(), part, -part, 0.0])
}

// docs/accuracy.md, case 6: a = g (sin θ − μ cos θ) within 0.1 %, from the speeds
// at two times after the contact has settled.
#[test]
fn a_cube_slides_at_the_acceleration_of_coulomb() {
    let (sin, cos) = f64::to_radians(35.0).sin_cos();
    let exact = GRAVITY * (sin - 0.25 * cos);
    let mut simulation = on_slope(35.0, 0.25, 1.2).start();
    let speed = |simulation: &Simulation| simulation.bodies()[0].velocity().dot(&down(35.0));
    run(&mut simulation, 0.2);
    let (first, start) = (speed(&simulation), simulation.time_s());
    run(&mut simulation, 1.2);
    let got = (speed(&simulation) - first) / (simulation.time_s() - start);
    let error = got / exact - 1.0;
    println!("cube at 35°: {got:.6} against {exact:.6} m/s², error {error:+.1e}");
    assert!(error.abs() < 1e-3);
}

// Sticks for μ > tan θ. The tangential springs stretch at the start and ring out within 0.2 s;
// after that the cube must not creep (docs/accuracy.md, case 6: 1e-6 m in 5 s).
#[test]
fn a_cube_below_its_angle_of_friction_does_not_creep() {
    let mut simulation = on_slope(25.0, 0.6, 5.0).start();
    let place = |simulation: &Simulation| simulation.bodies()[0].state.position;
    let start = place(&simulation);
    run(&mut simulation, 0.2);
    let settled = place(&simulation);
    run(&mut simulation, 5.0);
    let creep = (place(&simulation) - settled).norm();
    let total = (place(&simulation) - start).norm();
    println!("cube at 25°, μ 0.6: creep {creep:.1e} m in 4.8 s, {total:.1e} m in all");
    assert!(creep < 1e-6);
    // In all: the springs' stretch under the weight's part along the slope, a
    // fraction of the overlap of a body at rest, 1 % of 2 mm.
    assert!(total < 2e-5);
}

// A constant force is exact in velocity Verlet; the remaining error is the rounding of 400
// sums of order 1.
#[test]
fn free_fall_is_exact() {
    let scene = dropped(&json!([1, 0, 0, 0]), 2.0, 0.3)
        .first_body("velocity_m_s", json!([0.1, 0.02, 1.0]))
        .lasting(0.4);
    let simulation = scene.finished();
    let body = &simulation.bodies()[0];
    let exact = Vec3::new(0.54, 0.008, 2.0 + 0.4 - 0.5 * GRAVITY * 0.16);
    let error = (body.state.position - exact).norm();
    println!("free fall: {error:.1e} m");
    assert!(error < 1e-13);
    assert!((body.velocity() - Vec3::new(0.1, 0.02, 1.0 - 0.4 * GRAVITY)).norm() < 1e-13);
}

/// Rebound speed over impact speed in the first impact, both extrapolated to the height of
/// first contact along the free flight.
fn rebound(scene: &Scene) -> f64 {
    let mut simulation = scene.start();
    let body = &simulation.bodies()[0];
    let touch_height = body.shape.extent_along(&body.to_body(&-Vec3::z()));
    let (mut arriving, mut leaving) = (0.0, 0.0);
    watch(&mut simulation, 1.0, |simulation, _| {
        let body = &simulation.bodies()[0];
        if body.state.wall_energy > 0.0 || leaving > 0.0 {
            return;
        }
        let speed = body.velocity().z;
        let height = body.state.position.z - touch_height;
        let at_touch = (speed * speed + 2.0 * GRAVITY * height).sqrt();
        if speed < 0.0 {
            arriving = at_touch;
        } else {
            leaving = at_touch;
        }
    })
    .expect("a cube may bounce");
    leaving / arriving
}

// docs/accuracy.md, case 4: the restitution is the given one within 2 %, for a cube that falls
// on a vertex below its centre, where the effective mass is its own.
#[test]
fn a_vertex_rebounds_as_asked() {
    for restitution in [0.2, 0.5, 0.9] {
        let got = rebound(&dropped(&on_vertex(), 0.5, restitution));
        println!("on a vertex, e {restitution}: {got:.4}");
        assert!((got / restitution - 1.0).abs() < 0.02, "{got}");
    }
}

// The four vertices of a face share the mass that they stop.
#[test]
fn a_face_rebounds_as_asked() {
    for restitution in [0.2, 0.5, 0.9] {
        let got = rebound(&dropped(&json!([1, 0, 0, 0]), 0.5, restitution));
        println!("on a face, e {restitution}: {got:.4}");
        assert!((got / restitution - 1.0).abs() < 0.02, "{got}");
    }
}

/// True if a cube with much friction, resting flat on a slope, has tipped.
fn tips(inclination_deg: f64) -> bool {
    let simulation = on_slope(inclination_deg, 5.0, 1.0).finished();
    let start = on_slope(inclination_deg, 5.0, 1.0).start();
    let turned = simulation.bodies()[0]
        .state
        .orientation
        .angle_to(&start.bodies()[0].state.orientation);
    turned > 0.1
}

// docs/accuracy.md, case 6: tips past atan((L/2 − r)/(L/2)) = 41.99° for r = 2 mm
// and L = 40 mm, ±0.3°.
#[test]
fn a_cube_tips_over_its_lowest_edge() {
    assert!(!tips(41.99 - 0.3));
    assert!(tips(41.99 + 0.3));
}

// A cube rounded almost to a ball, which stands on one vertex of its tiny core, is pushed
// along. It rolls on and on; a resistance of 0.1 with the lever r takes 0.1 m g of force from
// it, and it stops within v²/(2 · 0.1 g · 5/7) = 0.18 m.
#[test]
fn rolling_friction_stops_a_round_body() {
    let half = 0.5 * (1.0f64 / 3.0).sqrt().acos();
    let part = half.sin() / 2f64.sqrt();
    let travelled = |rolling_friction: f64| {
        let ball = json!({
            "shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.0199,
            "position": {"downstream_m": 0.1}, "velocity_m_s": [0.5, 0.0, 0.0],
            "angular_velocity_rad_s": [0.0, 25.0, 0.0],
            "orientation": [half.cos(), part, -part, 0.0],
            "rolling_friction": rolling_friction
        });
        let scene = Scene::channel(0.0, 0.5, 2.0, 0.2).body(ball).lasting(2.0);
        let simulation = scene.finished();
        let body = &simulation.bodies()[0];
        (body.state.position.x - 0.1, body.velocity().norm())
    };
    let (free, speed) = travelled(0.0);
    assert!(free > 0.5 && speed > 0.2, "{free} {speed}");
    let (held, speed) = travelled(0.1);
    println!("{held} m, then {speed:e} m/s");
    let expected = 0.25 / (2.0 * 0.1 * GRAVITY * 5.0 / 7.0);
    assert!(
        (held / expected - 1.0).abs() < 0.02 && speed < 1e-3,
        "{held} {speed}"
    );
}
