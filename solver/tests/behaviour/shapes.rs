//! Bodies of every shape: they rest, fit in the flow, and balance it.

use crate::scenes::{PRECISIONS, Scene, run, watch};
use scree_solver::Simulation;
use serde_json::{Value, json};

/// A boulder that lies on a triangle, its weight unevenly shared.
fn boulder() -> Value {
    json!({"polyhedron": {"vertices_m": [
        [0.0, 0.0, 0.0], [0.04, 0.0, 0.0], [0.01, 0.03, 0.0], [0.045, 0.012, 0.018],
        [0.012, 0.035, 0.015], [-0.004, 0.004, 0.02], [0.02, 0.012, 0.032]]}})
}

fn regular(solid: &str, size_m: f64) -> Value {
    json!({"regular": {"solid": solid, "size_m": size_m}})
}

/// Shapes of all kinds, about 4 cm large.
fn shapes() -> Vec<(&'static str, Value)> {
    vec![
        ("box", json!({"box": {"sides_m": [0.02, 0.05, 0.03]}})),
        ("tetrahedron", regular("tetrahedron", 0.06)),
        ("octahedron", regular("octahedron", 0.045)),
        ("dodecahedron", regular("dodecahedron", 0.018)),
        ("icosahedron", regular("icosahedron", 0.025)),
        ("boulder", boulder()),
    ]
}

/// Shapes that are round by themselves, which a slope does not hold.
fn round_shapes() -> Vec<(&'static str, Value)> {
    vec![
        ("ball", json!({"ball": {"radius_m": 0.02}})),
        (
            "capsule",
            json!({"capsule": {"radius_m": 0.015, "length_m": 0.06}}),
        ),
    ]
}

// A body without an elevation starts at rest, however its weight is shared: it neither falls
// nor rocks. On a slope its tangential springs start unstretched: it moves by a fraction of
// its overlap at rest, 1e-5 m (measured: 2e-6 m).
#[test]
fn a_body_of_any_shape_starts_at_rest() {
    for (name, shape) in shapes() {
        for inclination_deg in [0.0, 15.0] {
            let scene = Scene::channel(inclination_deg, 1.0, 1.0, 0.2)
                .body(json!({"shape": shape, "friction": 1.0, "yaw_deg": 30,
                             "position": {"downstream_m": -0.5}}))
                .lasting(0.3);
            let mut simulation = scene.start();
            let start = simulation.bodies()[0].state.clone();
            let mut highest: f64 = 0.0;
            watch(&mut simulation, f64::INFINITY, |simulation, _| {
                let body = &simulation.bodies()[0];
                highest = highest.max(body.kinetic_energy() / body.mass);
            })
            .expect("the scene runs");
            let end = &simulation.bodies()[0].state;
            let moved = (end.position - start.position).norm();
            let turned = end.orientation.angle_to(&start.orientation);
            println!(
                "{name} on {inclination_deg}°: {moved:.1e} m, {turned:.1e} rad, {highest:.1e} J/kg"
            );
            let (far, fast) = if inclination_deg == 0.0 {
                (1e-9, 1e-12)
            } else {
                (1e-5, 1e-5)
            };
            assert!(
                moved < far && highest < fast,
                "{name} on {inclination_deg}°"
            );
        }
    }
}

// A single contact under the centre, or two beside it, carry the weight from the start.
#[test]
fn a_round_body_on_the_floor_starts_at_rest() {
    for (name, shape) in round_shapes() {
        let scene = Scene::channel(0.0, 1.0, 1.0, 0.2)
            .body(json!({"shape": shape, "yaw_deg": 30, "position": {"downstream_m": -0.5}}))
            .lasting(0.3);
        let simulation = scene.finished();
        let start = scene.start().bodies()[0].state.position;
        let body = &simulation.bodies()[0];
        let moved = (body.state.position - start).norm();
        println!("{name}: {moved:.1e} m, {:.1e} J", body.kinetic_energy());
        assert!(
            moved < 1e-9 && body.kinetic_energy() < 1e-12 * body.mass,
            "{name}"
        );
    }
}

// The volume of a body is excluded from a release, and no point is nearer to its surface than
// half the point spacing. The volume is counted in points of which a thousand or more fit; the
// body stands askew, so that no whole layers of them lie just in or out.
#[test]
fn a_release_leaves_room_for_any_shape() {
    /// Small enough for a thousand points in the smallest shape [m].
    const CELL: f64 = 0.006;
    // Of 8 points in a cell, less the tolerance for a lattice that fits.
    let stand_off = 0.98 * 0.25 * CELL;
    for (name, shape) in shapes().into_iter().chain(round_shapes()) {
        let position = json!({"downstream_m": -0.2, "elevation_m": 0.1});
        let askew = json!([0.8, 0.2, 0.4, 0.4]);
        let scene = Scene::channel(0.0, 0.5, 1.0, 0.15)
            .flow(json!({"volume_m3": 0.012, "release": {"height_m": 0.2, "toe_distance_m": 0.0}}))
            .body(json!({"shape": shape, "position": position, "orientation": askew}))
            .set("numerics", "cell_size_m", CELL)
            .lasting(0.0);
        let simulation = scene.start();
        let body = &simulation.bodies()[0];
        let gaps = simulation.points().into_iter();
        let nearest = gaps
            .map(|point| body.distance_to(&point.position))
            .fold(f64::INFINITY, f64::min);
        // Points are kept in single precision: 1e-7 of a cell and more.
        assert!(nearest > stand_off - 1e-7, "{name}: {nearest}");
        let share = simulation.excluded_volume_m3() / body.shape.volume();
        println!("{name}: {share:.3} of its volume");
        assert!((share - 1.0).abs() < 0.05, "{name}: {share}");
    }
}

// As in balances.rs, with its bounds: an imbalance is rounding.
#[test]
fn flow_and_any_shape_balance() {
    for (name, shape) in shapes().into_iter().chain(round_shapes()) {
        for (precision, bound) in PRECISIONS.into_iter().zip([1e-12, 2e-7]) {
            let scene = Scene::impact()
                .first_body("shape", shape.clone())
                .first_body("yaw_deg", 25)
                .first_body("position", json!({"downstream_m": 0.06}))
                .precision(precision)
                .lasting(0.3);
            let mut simulation = scene.start();
            let start = simulation.bodies()[0].state.position;
            let mut touched = 0;
            watch(&mut simulation, f64::INFINITY, |simulation, report| {
                touched = touched.max(simulation.flow_load(0).touching_points);
                if report.step_ended {
                    let audit = simulation.audit();
                    let (linear, angular) =
                        (audit.momentum_residual, audit.angular_momentum_residual);
                    assert!(
                        linear < bound && angular < bound,
                        "{name}: {linear:e} {angular:e}"
                    );
                }
            })
            .expect("the scene runs");
            let (audit, moved) = (
                simulation.audit(),
                (simulation.bodies()[0].state.position - start).norm(),
            );
            println!(
                "{name}, {precision}: linear {:.1e}, angular {:.1e}, moved {moved:.3} m, {touched} points",
                audit.momentum_residual, audit.angular_momentum_residual
            );
            assert!(moved > 1e-3 && touched > 0, "{name}");
        }
    }
}

// The bits are the same with a save as without.
#[test]
fn a_boulder_goes_on_from_a_save() {
    let scene = Scene::impact().first_body("shape", boulder()).lasting(0.2);
    let mut through = scene.start();
    run(&mut through, 0.12);
    let saved = through.save().expect("a step ended");
    run(&mut through, f64::INFINITY);
    let resumed = Simulation::restore(&scene.scenario(), 2, &saved);
    let mut resumed = resumed.expect("it was just saved");
    run(&mut resumed, f64::INFINITY);
    assert_eq!(resumed.bodies()[0].state, through.bodies()[0].state);
}
