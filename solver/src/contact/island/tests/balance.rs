//! Balance of bodies' energies.

use super::*;
use crate::body_energy::{BodyEnergy, potential, stored};
use crate::rigid::fixture::tetrahedron;

/// Balances of bodies that move for so many milliseconds over a floor.
fn balances(
    bodies: &mut [Body],
    milliseconds: u32,
    spoil: impl Fn(&mut [Body]),
) -> Vec<BodyEnergy> {
    let around = Surroundings {
        cancellation: None,
        walls: RigidWalls {
            planes: &[floor()],
            terrain: None,
        },
        gravity: GRAVITY,
        time: 0.0,
    };
    let mut contact_pairs = meet(bodies);
    let mut balances = BodyEnergy::of(bodies, &contact_pairs, &GRAVITY);
    for passed in 0..milliseconds {
        if passed == milliseconds / 2 {
            spoil(bodies);
        }
        let push = |_| Load {
            force: Vec3::new(1e-2, 0.0, 0.0),
            torque: Vec3::new(0.0, 0.0, 1e-4),
        };
        let reports = advance(bodies, &mut contact_pairs, push, &around, 1e-3);
        for (place, balance) in balances.iter_mut().enumerate() {
            balance.take_in(&reports[place].energy, &bodies[place], &GRAVITY);
        }
    }
    for (place, balance) in balances.iter().enumerate() {
        let body = &bodies[place];
        let now = body.kinetic_energy()
            + potential(body, &GRAVITY)
            + stored(place, bodies, &contact_pairs);
        let brought = balance.start + balance.flow_work + balance.body_work;
        let off = now - (brought - balance.dissipated + balance.made);
        assert!(off.abs() < 1e-12, "{off:e}");
    }
    balances
}

fn thrown(mut body: Body, restitution: f64) -> Body {
    let radius = body.shape.sphero_radius();
    body.wall_law = ContactLaw::hertz(1e6, radius, restitution, 0.5);
    body.state.orientation = UnitQuaternion::from_euler_angles(0.4, 0.3, 0.2);
    body.state.position.z = 0.1;
    body.state.momentum = Vec3::new(0.3, 0.1, -0.5) * body.mass;
    let spin = Vec3::new(5.0, -20.0, 10.0);
    body.state.angular_momentum = body.to_world(&(body.inertia * body.to_body(&spin)));
    body
}

/// Energy made, over the energy there was.
fn share(balance: &BodyEnergy, body: &Body) -> f64 {
    balance.made / balance.scale(body, &GRAVITY)
}

/// A tenth of the limit of the guard. Impacts are resolved to some 4e-4 of their energy, the
/// square of a body sub-step over a contact's time scale being 4e-3: 5e-4 was measured.
const RESOLVED: f64 = 1e-3;

// For any restitution: no energy is made or lost beyond the resolution of impacts; also when
// pushed along the floor, rolling and sliding.
#[test]
fn what_a_bouncing_body_loses_is_accounted_for() {
    for shape in [
        cuboid([0.04; 3]),
        cuboid([0.01, 0.02, 0.08]),
        tetrahedron(0.05),
    ] {
        for restitution in [0.0, 0.5, 1.0] {
            let mut body = [thrown(shape.clone(), restitution)];
            let balance = balances(&mut body, 1000, |_| {})[0];
            let share = share(&balance, &body[0]);
            assert!(balance.dissipated > 0.1 * balance.start);
            assert!(share.abs() < RESOLVED, "{share:e}");
        }
    }
}

// The energy that one gives is the energy that the other gets, and the dissipation of their
// contact is taken from both.
#[test]
fn what_bodies_exchange_adds_up() {
    let mut bodies = [
        thrown(cuboid([0.04; 3]), 0.5),
        thrown(tetrahedron(0.05), 0.5),
    ];
    bodies[1].state.position += Vec3::new(0.005, 0.01, 0.08);
    bodies[1].state.momentum.z *= 4.0;
    let found = balances(&mut bodies, 200, |_| {});
    assert!(
        found[0].body_work.abs() > 0.01 * found[0].start,
        "{found:?}"
    );
    assert_eq!(found[0].body_work, -found[1].body_work);
    for (balance, body) in found.iter().zip(&bodies) {
        let share = share(balance, body);
        assert!(share.abs() < RESOLVED, "{share:e}");
    }
}

// A cube that stands on another: both sink in by their weight, and next to nothing is
// made; 1.2e-6 was measured.
#[test]
fn a_standing_stack_makes_nothing() {
    let mut bodies = [0.02, 0.06].map(cube_at);
    for body in &mut bodies {
        body.wall_law = ContactLaw::hertz(1e6, 0.004, 0.3, 0.5);
    }
    for (balance, body) in balances(&mut bodies, 1000, |_| {}).iter().zip(&bodies) {
        let share = share(balance, body);
        assert!(share.abs() < 1e-5, "{share:e}");
    }
}

// Contacts with the floor become four times as stiff at once: so does their stored energy, and
// the difference is made, by this body and no other.
#[test]
fn energy_out_of_nothing_is_found_and_named() {
    let mut bodies = [0.02, 0.02].map(cube_at);
    bodies[1].state.position.y = 0.2;
    for body in &mut bodies {
        body.wall_law = ContactLaw::hertz(1e5, 0.004, 0.3, 0.5);
    }
    let weight = bodies[0].mass * 9.81;
    let sunk = (weight / (4.0 * bodies[0].wall_law.stiffness)).powf(2.0 / 3.0);
    let held = 4.0 * bodies[0].wall_law.elastic_energy(sunk);
    let found = balances(&mut bodies, 2000, |bodies| {
        bodies[0].wall_law.stiffness *= 4.0;
    });
    assert!((found[0].rise() / (3.0 * held) - 1.0).abs() < 0.05);
    assert!(found[1].made.abs() < 1e-3 * held);
}
