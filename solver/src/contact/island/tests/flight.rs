//! Long sub-steps in flight, and short ones in contact.

use super::*;
use crate::rigid::fixture::tetrahedron;

/// A stiff slender box that spins, at a height.
fn spinning(height: f64) -> Body {
    let mut body = cuboid([0.01, 0.012, 0.2]);
    body.wall_law = ContactLaw::hertz(1e9, body.shape.sphero_radius(), 1.0, 0.3);
    body.state.orientation = UnitQuaternion::from_euler_angles(1.3, 0.3, 0.2);
    body.state.position.z = height;
    let spin = body.to_body(&Vec3::new(3.0, -5.0, 8.0));
    body.state.angular_momentum = body.to_world(&(body.inertia * spin));
    body
}

/// Height of the lowest place over the floor.
fn clearance(body: &Body) -> f64 {
    body.state.position.z - body.shape.extent_along(&body.to_body(&-Vec3::z()))
}

// As near the floor as it may come within the step: more than a hundred short sub-steps are
// required, a few are taken. Gravity is uniform, so the path is a parabola to rounding;
// turning conserves its energy as in any steps of 0.05 rad.
#[test]
fn a_flight_takes_few_substeps_along_a_parabola() {
    let mut body = spinning(0.0);
    body.state.position.z = 1.2e-3 - clearance(&body);
    body.state.momentum = Vec3::new(0.3, 0.0, 0.1) * body.mass;
    let (start, energy) = (body.clone(), body.kinetic_energy());
    let dt = 1e-3;
    let report = alone(&mut body, &Load::default(), dt);
    assert!(report.substeps_asked > 100.0, "{report:?}");
    assert!(report.substeps < 10, "{report:?}");
    assert_eq!(report.supported_share, 0.0);
    let way = start.velocity() * dt + 0.5 * GRAVITY * dt * dt;
    assert!((body.state.position - start.state.position - way).norm() < 1e-15);
    assert_eq!(body.state.angular_momentum, start.state.angular_momentum);
    let fallen = body.kinetic_energy() - body.mass * GRAVITY.dot(&way);
    assert!((fallen / energy - 1.0).abs() < 1e-9);
}

/// Rebound speed of a cube that falls on a vertex from 0.4 mm, in a flight cut into pieces of
/// `dt`, and the number of its sub-steps.
fn rebound_in(dt: f64, restitution: f64) -> (f64, u32) {
    let mut cube = cube_at(0.0);
    cube.wall_law = ContactLaw::hertz(1e9, 0.004, restitution, 0.0);
    let on_vertex = UnitQuaternion::rotation_between(&Vec3::new(1.0, 1.0, 1.0), &-Vec3::z());
    cube.state.orientation = on_vertex.expect("not opposite");
    cube.state.position.z = 4e-4 - clearance(&cube);
    cube.state.momentum.z = -cube.mass;
    let mut taken = 0;
    for _ in 0..(2e-3 / dt).round() as u32 {
        taken += alone(&mut cube, &Load::default(), dt).substeps;
    }
    (cube.velocity().z, taken)
}

// As in pieces that leave no room for long sub-steps: undamped within 1e-4; damped, where six
// times as long ones resolve it, within the resolution of these.
#[test]
fn an_impact_after_a_flight_is_resolved() {
    for (restitution, close) in [(1.0, 1e-4), (0.5, 1e-3)] {
        let (short, many) = rebound_in(1e-6, restitution);
        let (long, few) = rebound_in(1e-3, restitution);
        assert!(short > 0.9 * restitution, "it rebounds: {short}");
        assert!((long / short - 1.0).abs() < close, "{long} {short}");
        assert!(2 * few < many, "{few} of {many}");
    }
}

// Two bodies that pass each other closely: no face separates them, their edges do.
#[test]
fn bodies_that_pass_each_other_are_in_flight() {
    let mut bodies = [cuboid([0.01, 0.01, 0.2]), cuboid([0.01, 0.2, 0.01])];
    bodies[0].state.orientation =
        UnitQuaternion::from_scaled_axis(Vec3::z() * std::f64::consts::FRAC_PI_4);
    bodies[1].state.orientation =
        UnitQuaternion::from_scaled_axis(Vec3::y() * std::f64::consts::FRAC_PI_4);
    bodies[1].state.position.x = 0.01 * 2f64.sqrt() + 1e-3;
    for body in &mut bodies {
        body.wall_law = ContactLaw::hertz(1e9, body.shape.sphero_radius(), 1.0, 0.3);
    }
    bodies[1].state.momentum.y = bodies[1].mass;
    let mut contact_pairs = meet(&mut bodies);
    let reports = advance(
        &mut bodies,
        &mut contact_pairs,
        |_| Load::default(),
        &NOWHERE,
        1e-3,
    );
    assert_eq!(contact_pairs.len(), 1);
    assert!(reports[0].substeps_asked > 100.0, "{reports:?}");
    assert!(reports[0].substeps < 20, "{reports:?}");
}

// For any shape and spin no place is ever faster than the bound of free turning.
#[test]
fn turning_stays_below_its_bound() {
    let mut numbers = Numbers(0.7);
    for mut body in [
        cuboid([0.01, 0.012, 0.2]),
        tetrahedron(0.05),
        cuboid([0.1, 0.02, 0.01]),
    ] {
        body.state.angular_momentum = body.inertia * numbers.vector() * 30.0;
        let bound = body.turning_bound();
        let mut fastest = 0.0f64;
        for _ in 0..2000 {
            body.drift(1e-3);
            fastest = fastest.max(body.largest_speed());
        }
        assert!(fastest <= bound * (1.0 + 1e-4), "{fastest} of {bound}");
        assert!(fastest > 0.3 * bound, "{fastest} of {bound}");
    }
}

// A body at rest on the floor has nothing at stake: its sub-steps are longer than those of
// an impact, and it stays.
#[test]
fn weak_contacts_take_longer_substeps() {
    let mut body = cube_at(0.02);
    body.wall_law = ContactLaw::hertz(1e10, 0.004, 0.5, 0.5);
    for _ in 0..200 {
        alone(&mut body, &Load::default(), 1e-3);
    }
    let report = alone(&mut body, &Load::default(), 1e-3);
    let (asked, taken) = (report.substeps_asked, f64::from(report.substeps));
    assert!(asked >= 100.0 && taken < 0.5 * asked, "{taken} of {asked}");
    assert_eq!(report.supported_share, 1.0);
    let weight = body.mass * 9.81;
    assert!((report.wall_load.force.z / weight - 1.0).abs() < 1e-6);
}
