//! Balls and capsules: rolling, impacts and flows with a known answer.

use crate::scenes::{Scene, run, watch};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;
const RADIUS: f64 = 0.02;
/// Contact modulus [Pa] that makes the overlap of a body at rest small against its radius.
const STIFF: f64 = 1e9;

fn ball(position: &Value) -> Value {
    json!({"shape": {"ball": {"radius_m": RADIUS}}, "position": position, "friction": 1.0})
}

fn capsule(position: &Value) -> Value {
    json!({"shape": {"capsule": {"radius_m": RADIUS, "length_m": 0.09}}, "position": position,
           "friction": 1.0})
}

fn at(x: f64, y: f64, z: f64) -> Value {
    json!({"downstream_m": x, "lateral_m": y, "elevation_m": z})
}

/// Largest share of a body's energy that its contacts made.
fn made_share(simulation: &Simulation) -> f64 {
    let bodies = simulation.bodies().iter().enumerate();
    let shares = bodies.map(|(place, body)| {
        let balance = simulation.body_energy(place);
        balance.rise() / balance.scale(body, &simulation.gravity())
    });
    shares.fold(0.0, f64::max)
}

fn assert_made_nothing(simulation: &Simulation) {
    let share = made_share(simulation);
    assert!(share < 1e-3, "made {share:e}");
}

/// Acceleration down a slope over that of rolling without slip, g sin θ/(1 + I/(m r²)), and the
/// slip at the end over the speed.
fn rolls(body: Value, axis: usize) -> (f64, f64) {
    let inclination_deg = 20.0;
    let scene = Scene::channel(inclination_deg, 4.0, 1.0, 0.2)
        .body(body)
        .lasting(1.0);
    let mut simulation = scene.start();
    let (sin, cos) = f64::to_radians(inclination_deg).sin_cos();
    let down = Vec3::new(cos, 0.0, -sin);
    let speed = |simulation: &Simulation| simulation.bodies()[0].velocity().dot(&down);
    run(&mut simulation, 0.2);
    let (first, start) = (speed(&simulation), simulation.time_s());
    run(&mut simulation, 1.0);
    assert_made_nothing(&simulation);
    let body = &simulation.bodies()[0];
    let moment = body.inertia[(axis, axis)] / (body.mass * RADIUS.powi(2));
    let exact = GRAVITY * sin / (1.0 + moment);
    let got = (speed(&simulation) - first) / (simulation.time_s() - start);
    let slip = speed(&simulation) - body.angular_velocity().y * RADIUS;
    (got / exact, slip / speed(&simulation))
}

// (5/7) g sin θ. A soft contact pushes in the middle of its overlap, nearer to the centre than
// the radius: with the automatic modulus by a thousandth of it here.
#[test]
fn a_ball_rolls_down_a_slope() {
    let start = json!({"downstream_m": -3.7});
    let mut stiff = ball(&start);
    stiff["contact_modulus_pa"] = json!(STIFF);
    for (name, body, bound) in [("stiff", stiff, 2e-4), ("automatic", ball(&start), 1e-3)] {
        let (share, slip) = rolls(body, 0);
        println!("ball, {name}: {share:.6} of 5/7 g sin θ, slip {slip:.1e}");
        assert!(
            (share - 1.0).abs() < bound && slip.abs() < 2.0 * bound,
            "{share} {slip}"
        );
    }
}

#[test]
fn a_capsule_rolls_across_its_axis() {
    let mut body = capsule(&json!({"downstream_m": -3.7}));
    body["contact_modulus_pa"] = json!(STIFF);
    body["yaw_deg"] = json!(90);
    let (share, slip) = rolls(body, 0);
    println!("capsule: {share:.6} of g sin θ/(1 + I/m r²), slip {slip:.1e}");
    assert!(
        (share - 1.0).abs() < 2e-4 && slip.abs() < 4e-4,
        "{share} {slip}"
    );
}

// Friction takes what slides until the ball rolls, whatever the friction is.
#[test]
fn a_pushed_ball_ends_at_five_sevenths_of_its_speed() {
    for friction in [0.1, 0.4] {
        let mut body = ball(&json!({"downstream_m": 0.1}));
        body["contact_modulus_pa"] = json!(STIFF);
        body["friction"] = json!(friction);
        body["velocity_m_s"] = json!([1.0, 0.0, 0.0]);
        let scene = Scene::channel(0.0, 0.5, 2.0, 0.2).body(body).lasting(0.6);
        let simulation = scene.finished();
        let share = simulation.bodies()[0].velocity().x / (5.0 / 7.0);
        println!("pushed at a friction of {friction}: {share:.6} of 5/7");
        assert!((share - 1.0).abs() < 1e-3, "{share}");
        assert_made_nothing(&simulation);
    }
}

/// Two bodies in the air, 0.1 m apart along x, that meet at 2 m/s.
fn head_on(bodies: [Value; 2], restitution: f64) -> Simulation {
    let scene = bodies
        .into_iter()
        .fold(Scene::channel(0.0, 0.5, 1.0, 0.3), Scene::body);
    let mut scene = scene.lasting(0.15);
    for (place, velocity) in [(0, 1.0), (1, -1.0)] {
        scene = scene.body_field(place, "velocity_m_s", json!([velocity, 0.0, 0.0]));
        scene = scene.body_field(place, "restitution", restitution);
    }
    scene.finished()
}

#[test]
fn balls_rebound_as_asked() {
    for restitution in [0.2, 0.5, 0.9] {
        let pair = [0.3, 0.42].map(|x| ball(&at(x, 0.0, 0.5)));
        let simulation = head_on(pair, restitution);
        let speeds: Vec<f64> = simulation.bodies().iter().map(|b| b.velocity().x).collect();
        let got = 0.5 * (speeds[1] - speeds[0]);
        println!("two balls, e {restitution}: {got:.5}");
        assert!((got / restitution - 1.0).abs() < 0.01, "{got}");
        assert!(simulation.audit().momentum_residual < 1e-12);
        assert_made_nothing(&simulation);
    }
}

/// Pairs of round bodies, and of a round body and a box, that meet in their ends, sides and edges.
fn meetings() -> Vec<(&'static str, [Value; 2])> {
    let cube = json!({"shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002,
                      "friction": 1.0, "position": at(0.42, 0.004, 0.503)});
    let askew = json!([0.8, 0.2, 0.4, 0.4]);
    let turned = |mut body: Value, key: &str, value: Value| {
        body[key] = value;
        body
    };
    let left = at(0.3, 0.0, 0.5);
    let right = at(0.43, 0.003, 0.502);
    let upright = json!([0.5f64.sqrt(), 0.0, 0.5f64.sqrt(), 0.0]);
    vec![
        (
            "balls off centre",
            [ball(&left), ball(&at(0.42, 0.01, 0.51))],
        ),
        ("ball on a face", [ball(&left), cube.clone()]),
        (
            "ball on an edge",
            [ball(&left), turned(cube.clone(), "yaw_deg", json!(45))],
        ),
        (
            "ball on a vertex",
            [
                ball(&left),
                turned(cube.clone(), "orientation", askew.clone()),
            ],
        ),
        (
            "ball on the side of a capsule",
            [ball(&left), turned(capsule(&right), "yaw_deg", json!(90))],
        ),
        (
            "ball on the end of a capsule",
            [ball(&left), capsule(&at(0.45, 0.003, 0.502))],
        ),
        (
            "parallel capsules",
            [
                turned(capsule(&left), "yaw_deg", json!(90)),
                turned(capsule(&at(0.43, 0.01, 0.502)), "yaw_deg", json!(90)),
            ],
        ),
        (
            "crossed capsules",
            [
                turned(capsule(&left), "yaw_deg", json!(90)),
                turned(capsule(&right), "orientation", upright),
            ],
        ),
        (
            "capsule along a face",
            [turned(capsule(&left), "yaw_deg", json!(90)), cube.clone()],
        ),
        (
            "capsule on a vertex",
            [
                turned(capsule(&left), "yaw_deg", json!(80)),
                turned(cube, "orientation", askew),
            ],
        ),
    ]
}

/// Kinetic and potential energy of all bodies [J].
fn energy(simulation: &Simulation) -> f64 {
    let of_body = |body: &scree_solver::rigid::Body| {
        body.kinetic_energy() - body.mass * simulation.gravity().dot(&body.state.position)
    };
    simulation.bodies().iter().map(of_body).sum()
}

// Elastic and without friction nothing takes energy; momentum is kept by any impact.
#[test]
fn elastic_meetings_of_round_bodies_keep_energy_and_momentum() {
    for (name, bodies) in meetings() {
        let smooth = bodies.map(|mut body| {
            body["friction"] = json!(0.0);
            body
        });
        let simulation = head_on(smooth, 1.0);
        let audit = simulation.audit();
        let start: f64 = (0..2).map(|body| simulation.body_energy(body).start).sum();
        let kinetic: f64 = simulation.bodies().iter().map(|body| 0.5 * body.mass).sum();
        let change = (energy(&simulation) - start) / kinetic;
        let turned_back = simulation.bodies()[0].velocity().x;
        println!(
            "{name}: energy {change:+.1e}, momentum {:.1e}, angular {:.1e}, then {turned_back:.3} m/s",
            audit.momentum_residual, audit.angular_momentum_residual
        );
        assert!(turned_back < 0.9, "{name}: they never met");
        assert!(change.abs() < 1e-4, "{name}: {change:e}");
        assert!(audit.momentum_residual < 1e-12 && audit.angular_momentum_residual < 1e-12);
    }
}

#[test]
fn meetings_with_friction_and_damping_make_no_energy() {
    for (name, bodies) in meetings() {
        let simulation = head_on(bodies, 0.5);
        println!("{name}: made {:.1e}", made_share(&simulation));
        assert!(
            simulation.bodies()[0].velocity().x < 0.9,
            "{name}: they never met"
        );
        assert_made_nothing(&simulation);
    }
}

// As elastic_bounces_keep_their_energy for a cube: the height of every bounce is that of the fall.
#[test]
fn an_elastic_ball_keeps_its_energy() {
    let mut body = ball(&at(0.5, 0.0, 0.32));
    body["restitution"] = json!(1.0);
    let scene = Scene::channel(0.0, 0.5, 1.0, 0.2).body(body).lasting(5.0);
    let mut simulation = scene.start();
    let start = energy(&simulation);
    let fall = simulation.bodies()[0].mass * GRAVITY * 0.3;
    let (mut worst, mut bounces, mut falling) = (0.0_f64, 0, true);
    watch(&mut simulation, f64::INFINITY, |simulation, _| {
        let body = &simulation.bodies()[0];
        bounces += i32::from(falling && body.velocity().z > 0.0);
        falling = body.velocity().z <= 0.0;
        if body.state.wall_energy == 0.0 {
            worst = worst.max((energy(simulation) - start).abs() / fall);
        }
    })
    .expect("a ball may bounce");
    println!("{bounces} elastic bounces: energy within {worst:.1e}");
    assert!(bounces >= 9 && worst < 1e-4, "{bounces} {worst:e}");
    assert_made_nothing(&simulation);
}

/// A body of this shape dropped on material at rest: its elevation at the end [m].
fn settles(shape: &Value, density: f64) -> f64 {
    let scene = Scene::channel(0.0, 0.25, 0.25, 0.12)
        .flow(json!({"volume_m3": 0.0018, "release": {"height_m": 0.06, "toe_distance_m": 0.0}}))
        .body(json!({"shape": shape, "density_kg_m3": density,
                     "position": at(-0.12, 0.0, 0.085), "velocity_m_s": [0.0, 0.0, -1.0]}))
        .set("numerics", "cell_size_m", 0.012)
        .lasting(0.15);
    let simulation = scene.finished();
    assert!(simulation.audit().momentum_residual < 1e-6);
    assert!(simulation.audit().angular_momentum_residual < 1e-6);
    assert_made_nothing(&simulation);
    assert!(simulation.flow_load(0).touching_points > 0);
    simulation.bodies()[0].state.position.z
}

// An icosahedron of the ball's volume, whose vertices stand out by a tenth.
#[test]
fn a_ball_settles_about_as_a_fine_icosahedron() {
    let ball = json!({"ball": {"radius_m": RADIUS}});
    let edge = (4.0 / 3.0 * std::f64::consts::PI / 2.181_695).cbrt() * RADIUS;
    let icosahedron = json!({"regular": {"solid": "icosahedron", "size_m": edge}});
    for density in [600.0, 3000.0] {
        let (round, faceted) = (settles(&ball, density), settles(&icosahedron, density));
        println!("{density} kg/m³: ball at {round:.4} m, icosahedron at {faceted:.4} m");
        assert!((round - faceted).abs() < 0.15 * RADIUS, "{round} {faceted}");
    }
}

#[test]
fn the_sample_scenario_runs() {
    let text = include_str!("../../../configs/scenarios/ball_and_capsule.json");
    let mut value: Value = serde_json::from_str(text).expect("it is JSON");
    value["numerics"]["cell_size_m"] = json!(0.02);
    value["duration_s"] = json!(0.4);
    let simulation = Scene::of(value).finished();
    let audit = simulation.audit();
    assert!(audit.momentum_residual < 1e-6 && audit.angular_momentum_residual < 1e-6);
    assert_made_nothing(&simulation);
    assert!(
        simulation
            .bodies()
            .iter()
            .all(|body| body.shape.faces().is_empty())
    );
}
