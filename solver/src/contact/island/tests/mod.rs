//! Tests of bodies that move, and their fixtures.

mod balance;
mod collisions;
mod flight;
mod heap;

use super::pace::substeps_alone;
use super::*;
use crate::contact::law::ContactLaw;
use crate::rigid::fixture::cuboid;
use crate::rigid::{Freedom, InverseInertia};
use crate::walls::{Plane, RigidWalls};
use nalgebra::UnitQuaternion;

const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);

fn floor() -> Plane {
    Plane {
        name: "floor",
        normal: Vec3::z(),
        offset: 0.0,
        flow_friction: 0.0,
    }
}

fn cube_at(height: f64) -> Body {
    let mut body = cuboid([0.04; 3]);
    body.state.position.z = height;
    body
}

/// Advances bodies; returns their reports.
fn advance(
    bodies: &mut [Body],
    contact_pairs: &mut Vec<ContactPair>,
    flow: impl Fn(usize) -> Load + Sync,
    around: &Surroundings,
    dt: f64,
) -> Vec<BodyReport> {
    let mut reports = vec![BodyReport::default(); bodies.len()];
    super::advance(bodies, contact_pairs, &mut reports, flow, around, dt);
    reports
}

/// Advances a body on its own.
fn alone(body: &mut Body, flow: &Load, dt: f64) -> BodyReport {
    let around = Surroundings {
        cancellation: None,
        walls: RigidWalls {
            planes: &[floor()],
            terrain: None,
        },
        gravity: GRAVITY,
        time: 0.0,
    };
    let bodies = std::slice::from_mut(body);
    advance(bodies, &mut Vec::new(), |_| *flow, &around, dt)[0]
}

fn angular_about_origin(body: &Body) -> Vec3 {
    body.state.position.cross(&body.state.momentum) + body.state.angular_momentum
}

#[test]
fn a_barrier_stands() {
    let mut body = cube_at(0.02);
    body.freedom = Freedom::Fixed;
    let before = body.state.clone();
    let push = Load {
        force: Vec3::new(1e3, 0.0, 0.0),
        torque: Vec3::y(),
    };
    let report = alone(&mut body, &push, 0.1);
    assert_eq!(body.state, before);
    assert_eq!(report, BodyReport::default());
}

// For any contact with the wall: the body's momentum changes by the impulses of walls and
// gravity in the report, and by the flow's force on its line of action. A tumbling cube that
// strikes the floor; rounding of sums of order 1.
#[test]
fn the_report_accounts_for_every_impulse() {
    let mut body = cube_at(0.03);
    body.state.position.x = 0.7;
    body.state.orientation = UnitQuaternion::from_euler_angles(0.4, 0.3, 0.2);
    body.state.momentum = Vec3::new(0.1, 0.02, -0.15);
    body.state.angular_momentum = body.inertia * Vec3::new(20.0, -30.0, 10.0);
    let (linear, angular) = (body.state.momentum, angular_about_origin(&body));
    let flow = Load {
        force: Vec3::new(0.5, -0.2, 0.1),
        torque: Vec3::new(0.01, 0.0, -0.02),
    };
    let about_origin = body.state.position.cross(&flow.force) + flow.torque;
    let dt = 0.01;
    let report = alone(&mut body, &flow, dt);
    assert!(report.supported_share > 0.0, "it never struck");
    assert!(report.wall.linear.z > 0.0);
    let given = report.wall.linear + report.gravity.linear + flow.force * dt;
    assert!((body.state.momentum - linear - given).norm() < 1e-14);
    let turned = report.wall.angular + report.gravity.angular + about_origin * dt;
    assert!((angular_about_origin(&body) - angular - turned).norm() < 1e-14);
    let mean = report.wall.linear / dt;
    assert!((report.wall_load.force - mean).norm() < 1e-11);
}

// A cube at rest on the floor: the wall carries its weight, on four vertices whose springs are
// unstretched, and sinks where 4 k δ^1.5 = m g.
#[test]
fn a_resting_cube_is_carried() {
    let mut body = cube_at(0.02);
    body.wall_law.damping = 2.0;
    for _ in 0..400 {
        alone(&mut body, &Load::default(), 1e-3);
    }
    let weight = body.mass * 9.81;
    let sunk = (weight / (4.0 * body.wall_law.stiffness)).powf(2.0 / 3.0);
    assert!((body.state.wall_load.force.z / weight - 1.0).abs() < 1e-9);
    assert!(((0.02 - body.state.position.z) / sunk - 1.0).abs() < 1e-6);
    assert!(body.state.wall_load.torque.norm() < 1e-12);
    assert!(body.velocity().norm() < 1e-9);
    assert_eq!(body.state.springs.len(), 8);
    // ∫ k δ^1.5 for four vertices.
    let held = 4.0 * 0.4 * body.wall_law.stiffness * sunk.powf(2.5);
    assert!((body.state.wall_energy / held - 1.0).abs() < 1e-5);
}

// Far from walls one sub-step is enough; a spin requires more, near a wall the contact's own
// time scale.
#[test]
fn substeps_follow_what_happens() {
    let planes = [floor()];
    let walls = RigidWalls::planar(&planes);
    let asked = |body: &Body, acceleration| substeps_alone(body, &walls, acceleration, 1e-3, 1e-3);
    let count = |body: &Body| asked(body, 9.81).ceil().max(1.0);
    assert_eq!(count(&cube_at(1.0)), 1.0);
    // A body that gravity takes to the wall from rest strikes it like one in flight.
    let start = cube_at(0.020_001);
    assert!(count(&start) > 1.0);
    assert_eq!(asked(&start, 0.0), 0.0);
    let mut spinning = cube_at(1.0);
    spinning.state.angular_momentum = spinning.inertia * Vec3::new(0.0, 0.0, 500.0);
    assert!((count(&spinning) - 10.0).abs() <= 1.0);
    // √(m/k') is 3 ms at this depth, and a tenth of it is taken.
    assert!(count(&cube_at(0.0199)) > 2.0);
    // About to strike within the step.
    let mut falling = cube_at(0.0205);
    falling.state.momentum.z = -falling.mass;
    assert!(count(&falling) > 5.0);
}

/// Pseudo-random numbers in −1 … 1 (Weyl's sequence).
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = (self.0 + 0.754_877_666_246_692_7).fract();
        (self.0 * 12.345).fract() * 2.0 - 1.0
    }

    fn vector(&mut self) -> Vec3 {
        Vec3::new(self.next(), self.next(), self.next())
    }
}

const NOWHERE: Surroundings = Surroundings {
    cancellation: None,
    walls: RigidWalls {
        planes: &[],
        terrain: None,
    },
    gravity: Vec3::new(0.0, 0.0, 0.0),
    time: 0.0,
};

// A nearly round body (a cube rounded with almost half its side) rolls down 10°;
// with a rolling resistance above tan 10° = 0.18 it stands, and does not creep.
#[test]
fn rolling_resistance_holds_a_round_body_on_a_slope() {
    let shape = crate::shape::SpheroPolyhedron::cube(0.04, 0.0199).expect("a solid");
    let mut round = cuboid([0.04; 3]);
    round.mass = 1000.0 * shape.volume();
    round.inertia = shape.unit_inertia() * 1000.0;
    round.inverse_inertia = InverseInertia::of(&round.inertia).expect("a solid has inertia");
    round.shape = shape;
    round.wall_law = ContactLaw::hertz(1e5, 0.0199, 0.3, 2.0);
    // Standing on one vertex of its tiny core.
    let on_vertex = UnitQuaternion::rotation_between(&Vec3::new(1.0, 1.0, 1.0), &-Vec3::z());
    round.state.orientation = on_vertex.expect("not opposite");
    round.state.position.z = round.shape.extent_along(&round.to_body(&-Vec3::z()));
    let way = |rolling: f64| {
        let mut body = round.clone();
        body.rolling_friction = rolling;
        let around = Surroundings {
            cancellation: None,
            walls: RigidWalls {
                planes: &[floor()],
                terrain: None,
            },
            // 10° of slope.
            gravity: 9.81 * Vec3::new(0.173_648, 0.0, -0.984_808),
            time: 0.0,
        };
        let mut step = |count: usize| {
            for _ in 0..count {
                let bodies = std::slice::from_mut(&mut body);
                advance(bodies, &mut Vec::new(), |_| Load::default(), &around, 1e-3);
            }
            body.state.position.x
        };
        let settled = step(400);
        (settled, step(400) - settled)
    };
    let (free, _) = way(0.0);
    let (held, creep) = way(0.25);
    assert!(free > 0.05, "it rolls without resistance: {free}");
    assert!(held.abs() < 1e-3, "and stands with it: {held}");
    assert!(creep.abs() < 1e-7, "without creeping: {creep}");
}
