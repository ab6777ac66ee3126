//! Ten bodies of mixed shapes, dropped between walls and a barrier as a scenario.

use crate::scenes::{Scene, run, watch};
use scree_solver::Simulation;
use scree_solver::rigid::Body;
use serde_json::{Value, json};

const GRAVITY: f64 = 9.81;

fn regular(solid: &str, size_m: f64) -> Value {
    json!({"regular": {"solid": solid, "size_m": size_m}})
}

/// Cubes, boxes, regular solids and a polyhedron, all about 4 cm large.
fn shapes() -> [Value; 10] {
    let cube = json!({"cube": {"side_m": 0.04}});
    let boulder = json!({"polyhedron": {"vertices_m": [
        [0.0, 0.0, 0.0], [0.04, 0.0, 0.0], [0.01, 0.03, 0.0], [0.045, 0.012, 0.018],
        [0.012, 0.035, 0.015], [-0.004, 0.004, 0.02], [0.02, 0.012, 0.032]]}});
    [
        cube.clone(),
        json!({"box": {"sides_m": [0.03, 0.04, 0.05]}}),
        regular("tetrahedron", 0.05),
        regular("octahedron", 0.04),
        boulder.clone(),
        regular("dodecahedron", 0.018),
        cube,
        regular("icosahedron", 0.025),
        json!({"box": {"sides_m": [0.02, 0.05, 0.03]}}),
        boulder,
    ]
}

/// One above the other, askew, in a pit of 12 by 14 cm whose fourth side is a barrier.
fn heap() -> Scene {
    heap_of(10, 0.3, &[0.002])
}

/// A heap of the first so many bodies, with this restitution and these sphero radii [m] in
/// turn.
fn heap_of(count: usize, restitution: f64, radii: &[f64]) -> Scene {
    let barrier = json!({"shape": {"box": {"sides_m": [0.02, 0.119, 0.3]}}, "fixed": true,
                         "position": {"downstream_m": 0.09, "elevation_m": 0.15}});
    let pit = Scene::channel(0.0, 0.06, 1.0, 0.12).body(barrier);
    let fallen = |scene: Scene, (level, shape): (usize, Value)| {
        let n = level as f64;
        // Of unit length within the tolerance of a scenario.
        let (sin, cos) = (0.35 + 0.4 * n).sin_cos();
        let axis = [0.48, 0.6, 0.64];
        scene.body(json!({
            "shape": shape, "sphero_radius_m": radii[level % radii.len()],
            "restitution": restitution, "friction": 0.4,
            "position": {"downstream_m": 0.01 + 0.012 * (1.7 * n).sin(),
                         "lateral_m": 0.012 * (2.3 * n).cos(),
                         "elevation_m": 0.06 + 0.07 * n},
            "orientation": [cos, sin * axis[0], sin * axis[1], sin * axis[2]]
        }))
    };
    let shapes = shapes().into_iter().enumerate();
    shapes.take(count).fold(pit, fallen)
}

fn free(simulation: &Simulation) -> impl Iterator<Item = &Body> {
    let bodies = simulation.bodies().iter();
    bodies.filter(|body| body.is_free())
}

/// Kinetic and potential energy, and energy stored in contacts [J].
fn energy(simulation: &Simulation) -> f64 {
    let held = simulation
        .contact_pairs()
        .iter()
        .map(|contact_pair| contact_pair.energy);
    let of_body = |body: &Body| {
        let lifted = body.mass * GRAVITY * body.state.position.z;
        body.kinetic_energy() + lifted + body.state.wall_energy
    };
    free(simulation).map(of_body).sum::<f64>() + held.sum::<f64>()
}

/// Deepest overlap of any contact now, over the sphero radius of all bodies.
fn deepest(simulation: &Simulation) -> f64 {
    let radius = simulation.bodies()[1].shape.sphero_radius();
    let on_walls = free(simulation).map(|body| body.state.wall_overlap);
    let on_bodies = simulation
        .contact_pairs()
        .iter()
        .map(|contact_pair| contact_pair.deepest);
    on_walls.chain(on_bodies).fold(0.0, f64::max) / radius
}

// Tolerances: overlap at rest below 2 % of r, at impact below 20 %; at rest means asleep, with
// no speed above 1e-5 m/s for 0.1 s. Energy rises by at most 1e-4 of its value, by the error
// of Verlet and by the springs of contacts that change their overlap; each body's contacts
// make no more of the energy that moves it. Kinetic energy alone rises while they fall.
#[test]
fn ten_mixed_bodies_dropped_come_to_rest() {
    let mut simulation = heap().lasting(2.0).start();
    let start = energy(&simulation);
    let (mut lowest, mut rise) = (start, 0.0f64);
    watch(&mut simulation, 2.0, |simulation, _| {
        let now = energy(simulation);
        lowest = lowest.min(now);
        rise = rise.max(now - lowest);
    })
    .expect("it runs");
    let audit = simulation.audit();
    let (at_impact, at_rest) = (audit.deepest_body_overlap_ratio, deepest(&simulation));
    println!(
        "overlap {at_impact} {at_rest}, rise {:e}, residuals {:e} {:e} {:e}",
        rise / start,
        audit.momentum_residual,
        audit.angular_momentum_residual,
        audit.energy_residual()
    );
    for (body, state) in simulation.bodies().iter().enumerate().skip(1) {
        let energy = simulation.body_energy(body);
        let made = energy.rise() / energy.scale(state, &simulation.gravity());
        println!("body {body}: {made:e} made");
        assert!(made < 1e-4, "body {body}: {made:e}");
    }
    for body in free(&simulation) {
        assert!(body.state.still_for >= 0.1, "{:?}", body.state);
        let place = body.state.position;
        assert!(
            place.z > 0.0 && place.x.abs() < 0.08,
            "it stays in: {place}"
        );
    }
    assert!(at_rest > 0.0 && at_rest < 0.02, "{at_rest}");
    assert!(at_impact > at_rest && at_impact < 0.2, "{at_impact}");
    assert!(rise < 1e-4 * start, "{rise:e} of {start}");
    assert!(audit.momentum_residual < 1e-12);
    assert!(audit.angular_momentum_residual < 1e-12);
}

// The same tolerance where little is lost: rebounding bodies meet falling ones, and sphero
// radii differ, so that overlap is measured by the smaller one and the contact modulus of the
// rounder one must not decide. Undamped contacts take ten times the steps, so there are few
// and for the first impacts only.
#[test]
fn bouncing_bodies_of_several_radii_overlap_no_more() {
    let radii = [0.002, 0.004, 0.001];
    for (count, restitution, lasting_s) in [(8, 0.9, 0.5), (3, 1.0, 0.16)] {
        let mut simulation = heap_of(count, restitution, &radii)
            .lasting(lasting_s)
            .start();
        run(&mut simulation, lasting_s);
        let at_impact = simulation.audit().deepest_body_overlap_ratio;
        println!("{count} bodies, restitution {restitution}: overlap {at_impact}");
        assert!(at_impact > 0.01 && at_impact < 0.2, "{at_impact}");
    }
}

// Two cubes that sleep on each other are saved and restored asleep; both runs are woken by the
// same cube from above, and end with the same bits.
#[test]
fn a_sleeping_island_goes_on_with_the_same_bits() {
    let cube = |downstream: f64, elevation: Value| {
        json!({"shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002,
               "position": {"downstream_m": downstream, "elevation_m": elevation}})
    };
    let scene = Scene::channel(0.0, 0.5, 1.0, 0.3)
        .body(cube(0.3, Value::Null))
        .body(cube(0.3, json!(0.06)))
        .body(cube(0.31, json!(2.0)))
        .lasting(0.9);
    let mut whole = scene.start();
    run(&mut whole, 0.5);
    let asleep: Vec<_> = whole.bodies()[..2]
        .iter()
        .map(|body| body.state.clone())
        .collect();
    assert!(asleep.iter().all(|state| state.still_for >= 0.1));
    let saved = whole.save().expect("a step ended");
    let mut moved = Simulation::restore(&scene.scenario(), 2, &saved).expect("its own state");
    assert_eq!(moved.save(), Ok(saved));

    for simulation in [&mut whole, &mut moved] {
        run(simulation, 0.55);
        let slept: Vec<_> = simulation.bodies()[..2]
            .iter()
            .map(|body| body.state.clone())
            .collect();
        assert_eq!(slept, asleep, "asleep no bit changes");
        run(simulation, 0.9);
    }
    assert_ne!(whole.bodies()[1].state, asleep[1], "nothing woke it");
    assert_eq!(whole.save(), moved.save());
}
