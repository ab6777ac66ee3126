//! Bodies among bodies, through scenarios: stacks, barriers, flows with many.

use crate::scenes::{Scene, run, watch};
use scree_solver::Simulation;
use scree_solver::math::Vec3;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;

fn cube(position: &Value) -> Value {
    json!({"shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002,
           "position": position, "friction": 0.5, "restitution": 0.3})
}

fn at(x: f64, y: f64, z: f64) -> Value {
    json!({"downstream_m": x, "lateral_m": y, "elevation_m": z})
}

/// Three cubes on three levels, a millimetre apart, over a flat floor.
fn tower() -> Scene {
    [0.0205, 0.0615, 0.1025]
        .iter()
        .fold(Scene::channel(0.0, 0.5, 1.0, 0.3), |scene, &z| {
            scene.body(cube(&at(0.3, 0.0, z)))
        })
        .lasting(1.5)
}

fn places(simulation: &Simulation) -> Vec<Vec3> {
    let bodies = simulation.bodies().iter();
    bodies.map(|body| body.state.position).collect()
}

// Each level carries the bodies above; nothing creeps, and the overlap is below 2 % of r.
#[test]
fn a_tower_stands() {
    let mut simulation = tower().start();
    run(&mut simulation, 0.5);
    let settled = places(&simulation);
    run(&mut simulation, 1.5);
    let weight = simulation.bodies()[0].mass * GRAVITY;
    for (level, body) in simulation.bodies().iter().enumerate() {
        let creep = (body.state.position - settled[level]).norm();
        assert!(creep < 1e-7, "level {level} creeps {creep:e} m");
        let report = simulation.body_report(level);
        let carried = [report.wall_load.force.z, report.body_load.force.z];
        let expected = [[3.0, -2.0], [0.0, 1.0], [0.0, 1.0]][level];
        for (carried, expected) in carried.iter().zip(expected) {
            assert!(
                (carried / weight - expected).abs() < 1e-4,
                "level {level}: {carried}"
            );
        }
    }
    for contact_pair in simulation.contact_pairs() {
        assert!(contact_pair.deepest > 0.0 && contact_pair.deepest < 0.02 * 0.002);
    }
    assert!(simulation.audit().momentum_residual < 1e-12);
    assert!(simulation.audit().angular_momentum_residual < 1e-12);
}

// A barrier stops a cube that slides into it: its impulse is booked as one from outside, and
// it does not move.
#[test]
fn a_barrier_stops_a_cube() {
    let mut barrier = cube(&json!({"downstream_m": 0.3}));
    barrier["fixed"] = json!(true);
    let mut slider = cube(&json!({"downstream_m": 0.2}));
    slider["velocity_m_s"] = json!([1.0, 0.0, 0.0]);
    slider["friction"] = json!(0.0);
    let scene = Scene::channel(0.0, 0.5, 1.0, 0.3)
        .body(barrier)
        .body(slider)
        .lasting(0.15);
    let mut simulation = scene.start();
    let start = simulation.bodies()[0].state.clone();
    let mut pushed = 0.0;
    watch(&mut simulation, 1.0, |simulation, report| {
        pushed += simulation.body_report(1).body_load.force.x * report.substep_s;
    })
    .expect("it runs");
    let slider = &simulation.bodies()[1];
    assert_eq!(simulation.bodies()[0].state.position, start.position);
    let speed = slider.velocity().x;
    assert!(
        (speed / -0.3 - 1.0).abs() < 0.02,
        "it rebounds with {speed}"
    );
    assert!((slider.mass * (speed - 1.0) / pushed - 1.0).abs() < 1e-9);
    assert!(simulation.audit().momentum_residual < 1e-12);
}

// Linear and angular momentum of a flow that strikes a pile are booked to rounding.
#[test]
fn a_flow_strikes_a_pile() {
    let scene = [(0.06, -0.021), (0.06, 0.021)]
        .iter()
        .fold(Scene::impact().precision("double"), |scene, &(x, y)| {
            scene.body(cube(&at(x, y, 0.0601)))
        })
        .set("channel", "runout_length_m", 0.3);
    let mut simulation = scene.start();
    let mut met = 0.0f64;
    watch(&mut simulation, 1.0, |simulation, _| {
        for contact_pair in simulation.contact_pairs() {
            met = met.max(contact_pair.deepest);
        }
    })
    .expect("it runs");
    assert!(met > 0.0, "nothing touched");
    let audit = simulation.audit();
    println!(
        "{:e} {:e}",
        audit.momentum_residual, audit.angular_momentum_residual
    );
    assert!(audit.momentum_residual < 1e-12);
    assert_eq!(audit.penetration_corrections, 0);
    assert!(audit.angular_momentum_residual < 1e-12);
}
