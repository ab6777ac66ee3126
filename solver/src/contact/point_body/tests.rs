mod continuity;

use super::force::PointContact;
use super::*;
use crate::contact::law::ContactLaw;
use crate::grid::block_of;
use crate::grid::fixture::PlainGrid;
use crate::kernel::{Lattice, PointStencil, Stencil};
use crate::rigid::InverseInertia;
use crate::rigid::fixture::{cuboid, of_shape};
use crate::shape::{Feature, RegularSolid, SharpPolyhedron};
use crate::walls::{NodeAccess, Plane, RigidWalls};
use nalgebra::UnitQuaternion;

const SPHERE: PointSphere = PointSphere {
    radius: 0.003,
    spacing: 0.006,
};

const REACH: Reach = Reach {
    sphere: SPHERE.radius,
    travel: 0.007,
};

fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(0.01),
    }
}

/// Mass of a point [kg].
const MASS: f64 = 1e-3;
/// Length of a sub-step [s].
const DT: f64 = 1e-5;

/// Points of 1 g that move as one, and the grid that they lie on.
struct Cloud {
    positions: Vec<Vec3>,
    velocity: Vec3,
    grid: PlainGrid,
}

impl Cloud {
    fn new(positions: Vec<Vec3>, velocity: Vec3) -> Self {
        let lowest = positions.iter().map(|place| lattice().base(place));
        let grid = PlainGrid::around(lattice(), lowest);
        let mut cloud = Self {
            positions,
            velocity,
            grid,
        };
        for place in 0..cloud.positions.len() {
            for (node, weight) in cloud.stencil(place) {
                cloud.grid.nodes[node as usize].mass += weight * MASS;
            }
        }
        cloud
    }

    fn loads(&self, bodies: &[Body], loads: &mut Loads<usize>, passed: f64) {
        let boundary = Boundary::default();
        let grid = CouplingGrid {
            nodes: &self.grid,
            boundary: &boundary,
            partners: &[],
        };
        let time = ContactTime { dt: DT, passed };
        loads.evaluate(self, &grid, bodies, SPHERE, time);
    }
}

impl PointAccess for Cloud {
    type Place = usize;

    fn find_within(&self, around: &Around, found: &mut Vec<usize>) {
        let inside = |place: &usize| around.holds(&self.positions[*place]);
        found.extend((0..self.positions.len()).filter(inside));
    }

    fn resting(&self, place: usize) -> Vec3 {
        self.positions[place]
    }

    fn stencil(&self, place: usize) -> PointStencil {
        let Stencil { base, weight, .. } = lattice().stencil(&self.positions[place]);
        std::array::from_fn(|n| {
            let along = [n / 9, n / 3 % 3, n % 3];
            let index = [0, 1, 2].map(|axis| base[axis] + along[axis] as i32);
            let node = self.grid.place_of(index).expect("its block is there");
            let share = (0..3).map(|axis| weight[axis][along[axis]]).product();
            (node as u32, share)
        })
    }

    fn moving(&self, place: usize) -> Moving {
        Moving {
            position: self.positions[place],
            velocity: self.velocity,
        }
    }
}

/// A cube of points, with this many per side and this spacing.
fn lump(side: u32, start: f64, spacing: f64) -> Vec<Vec3> {
    let place = |n: u32| start + spacing * f64::from(n);
    let position = |id: u32| {
        let (x, y, z) = (id % side, id / side % side, id / side.pow(2));
        Vec3::new(place(x), place(y), place(z))
    };
    (0..side.pow(3)).map(position).collect()
}

/// The cube of 0.04 m, turned and moving, its centre at 0.1 m on every axis.
fn cube() -> Body {
    let mut body = cuboid([0.04; 3]);
    body.state.position = Vec3::repeat(0.1);
    body
}

/// Forces on points at these positions, moving as one.
fn loads(positions: Vec<Vec3>, velocity: Vec3, body: &Body) -> Loads<usize> {
    let cloud = Cloud::new(positions, velocity);
    let bodies = std::slice::from_ref(body);
    let mut loads = Loads::default();
    loads.find_candidates(&cloud, bodies, REACH);
    cloud.loads(bodies, &mut loads, 0.0);
    loads
}

/// Force on a single point over the upper face, at this height above the flat in R_p.
fn force_on_one(in_radii: f64, velocity: Vec3) -> Vec3 {
    let loads = loads(vec![above(in_radii)], velocity, &cube());
    assert_eq!(loads.on_points.len(), 1);
    loads.on_points[0].1
}

/// A place over the upper face, at this height above the flat in R_p.
fn above(in_radii: f64) -> Vec3 {
    Vec3::new(0.105, 0.098, 0.12 + in_radii * SPHERE.radius)
}

#[test]
fn a_point_in_touch_is_pushed_out_and_the_body_back() {
    let body = cube();
    let loads = loads(vec![above(0.5)], Vec3::zeros(), &body);
    let (_, force) = loads.on_points[0];
    // Hertz at δ = R_p/2, the point at rest.
    let expected = body.flow_law.stiffness * (0.5 * SPHERE.radius).powf(1.5);
    assert!((force - Vec3::new(0.0, 0.0, expected)).norm() < 1e-9 * expected);
    let on_body = loads.on_bodies[0];
    assert_eq!(on_body.load.force, -force);
    let arm = above(0.5) - body.state.position;
    assert_eq!(on_body.load.torque, arm.cross(&-force));
    assert_eq!(on_body.touching_points, 1);
    let overlap = 0.5 * SPHERE.radius / (SPHERE.radius + body.shape.sphero_radius());
    assert!((on_body.deepest_overlap_ratio - overlap).abs() < 1e-9);
    assert!((on_body.energy / (0.4 * expected * 0.5 * SPHERE.radius) - 1.0).abs() < 1e-9);
}

#[test]
fn apart_is_apart() {
    let places = vec![above(1.01), Vec3::repeat(0.2)];
    let loads = loads(places, Vec3::new(0.0, 0.0, -5.0), &cube());
    assert_eq!(loads.on_points, vec![]);
    assert_eq!(loads.on_bodies[0], FlowLoad::default());
}

// Linear and angular momentum: equal and opposite over many points round a
// turned, moving body, friction and damping included.
#[test]
fn forces_are_equal_and_opposite() {
    let mut body = cube();
    body.state.orientation = UnitQuaternion::from_euler_angles(0.3, -0.5, 0.8);
    body.state.momentum = Vec3::new(0.05, 0.01, -0.02);
    body.state.angular_momentum = body.inertia * Vec3::new(5.0, 3.0, -8.0);
    let places = lump(16, 0.07, 0.004);
    let loads = loads(places.clone(), Vec3::new(0.3, -0.2, 0.4), &body);
    let (mut force, mut torque) = (Vec3::zeros(), Vec3::zeros());
    for (point, on_point) in &loads.on_points {
        force += on_point;
        torque += (places[*point] - body.state.position).cross(on_point);
    }
    let on_body = loads.on_bodies[0];
    assert!(on_body.touching_points > 50);
    assert!((force + on_body.load.force).norm() < 1e-10 * on_body.load.force.norm());
    assert!((torque + on_body.load.torque).norm() < 1e-10);
}

#[test]
fn what_leaves_is_not_held_back() {
    let along = |speed: f64| Vec3::new(0.0, 0.0, speed);
    assert_eq!(force_on_one(0.9, along(50.0)), Vec3::zeros());
    assert!(force_on_one(0.9, along(-50.0)).z > force_on_one(0.9, along(0.0)).z);
}

#[test]
fn friction_is_coulombs_and_against_the_sliding() {
    let force = force_on_one(0.5, Vec3::new(2.0, 0.0, 0.0));
    assert!(force.y.abs() < 1e-12);
    assert!((force.x + 0.5 * force.z).abs() < 1e-12, "{force:?}");
    // Slow sliding stops within a few sub-steps and is never reversed.
    let slow = 1e-4;
    let force = force_on_one(0.5, Vec3::new(slow, 0.0, 0.0));
    let body = cube();
    let lever = (above(0.5) - body.state.position).norm();
    // The whole mass of a lone point resists, and the cube, which it also turns.
    let moment = body.inertia[(0, 0)];
    let compliance = 1.0 / MASS + 1.0 / body.mass + lever * lever / moment;
    let effective = 1.0 / compliance;
    let expected = 0.5 * effective * slow / DT;
    assert!((force.x + expected).abs() < 1e-9 * expected, "{force:?}");
}

// At the tip of a rod a force across turns it about a transverse axis, whose moment is far above that
// about its length.
#[test]
fn a_slender_body_resists_at_its_tip_with_its_transverse_inertia() {
    let mut rod = cuboid([0.2, 0.004, 0.004]);
    rod.state.position = Vec3::repeat(0.1);
    let place = Vec3::new(0.19, 0.1, 0.102 + 0.5 * SPHERE.radius);
    let slow = 1e-6;
    let loads = loads(vec![place], Vec3::new(0.0, slow, 0.0), &rod);
    let arm: Vec3 = place - rod.state.position;
    let [about_length, across] = [0, 1].map(|axis| rod.inertia[(axis, axis)]);
    assert!(about_length < 0.01 * across);
    // Across the rod in the plane of arm and length the compliance is arm²/I; across that plane it
    // is less than the sum of both turns.
    let least = 1.0 / MASS + 1.0 / rod.mass + arm.norm_squared() / across;
    let most = least + arm.z * arm.z / about_length;
    let expected = [most, least].map(|compliance| 0.5 * slow / (DT * compliance));
    let force = -loads.on_points[0].1.y;
    assert!(force >= expected[0] * (1.0 - 1e-9), "{force} {expected:?}");
    assert!(force <= expected[1] * (1.0 + 1e-9), "{force} {expected:?}");
}

// An elastic contact of a light body: damped by ½ k' Δt for its share of the compliance.
#[test]
fn an_elastic_contact_takes_what_the_step_makes() {
    let mut body = cube();
    body.flow_law.damping = 0.0;
    let force = |speed: f64| {
        let velocity = Vec3::new(0.0, 0.0, speed);
        loads(vec![above(0.5)], velocity, &body).on_points[0].1.z
    };
    let damping = (force(-1e-3) - force(1e-3)) / 2e-3;
    let lever = (above(0.5) - body.state.position).norm();
    let of_body = 1.0 / body.mass + lever * lever / body.inertia[(0, 0)];
    let share = of_body / (of_body + 1.0 / MASS);
    let tangent = 1.5 * body.flow_law.stiffness * (0.5 * SPHERE.radius).sqrt();
    let expected = 0.5 * tangent * DT * share;
    assert!(
        (damping / expected - 1.0).abs() < 1e-9,
        "{damping} {expected}"
    );
}

#[test]
fn forces_of_the_last_sub_step_are_gone() {
    let cloud = Cloud::new(vec![above(0.5)], Vec3::zeros());
    let mut body = cube();
    let mut loads = Loads::default();
    loads.find_candidates(&cloud, std::slice::from_ref(&body), REACH);
    cloud.loads(std::slice::from_ref(&body), &mut loads, 0.0);
    assert_eq!(loads.on_points.len(), 1);
    body.state.position.z -= 0.01;
    cloud.loads(&[body], &mut loads, 0.5);
    assert_eq!(loads.on_points, vec![]);
    assert_eq!(loads.on_bodies[0], FlowLoad::default());
}

#[test]
fn points_in_the_core_are_put_on_its_surface() {
    let body = cube();
    let core_top = 0.12 - body.shape.sphero_radius();
    let at =
        |z: f64| penetration_correction(&Vec3::new(0.1, 0.1, z), &body, &RigidWalls::planar(&[]));
    let Some(PenetrationCorrection::To(outside)) = at(core_top - 1e-3) else {
        panic!("it is inside");
    };
    assert!((outside - Vec3::new(0.1, 0.1, 0.12)).norm() < 1e-15);
    assert_eq!(at(core_top + 1e-3), None);
    assert_eq!(at(0.15), None);
}

// Nearest to the top, but a lid is there; next to the side at x = 0.12.
#[test]
fn no_point_is_put_behind_a_wall() {
    let body = cube();
    let wall = |name, normal: Vec3, offset| Plane {
        name,
        normal,
        offset,
        flow_friction: 0.0,
    };
    let lid = wall("lid", -Vec3::z(), -0.119);
    let inside = Vec3::new(0.11, 0.1, 0.114);
    let Some(PenetrationCorrection::To(at_side)) =
        penetration_correction(&inside, &body, &RigidWalls::planar(&[lid]))
    else {
        panic!("there is room");
    };
    assert!((at_side - Vec3::new(0.12, 0.1, 0.114)).norm() < 1e-15);
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    let cage = axes.map(|axis| [wall("low", axis, 0.081), wall("high", -axis, -0.119)]);
    // Nearest to the core's top, the sphero radius below the body's.
    let depth = 0.12 - body.shape.sphero_radius() - 0.114;
    let Some(PenetrationCorrection::NoRoom { depth: found }) =
        penetration_correction(&inside, &body, &RigidWalls::planar(cage.as_flattened()))
    else {
        panic!("there is no room");
    };
    assert!((found - depth).abs() < 1e-15, "{found}, not {depth}");
}

// The search goes by blocks: a block that contains a point of a body's box must overlap that
// box, wherever it ends. It is moved in steps of a third of a cell.
#[test]
fn blocks_in_reach_are_searched() {
    let places = lump(30, 0.055, 0.0031);
    let mut body = cube();
    for _ in 0..12 {
        body.state.position += Vec3::repeat(0.0033);
        let around = Around::body(&body, 0.01);
        let inside = places.iter().filter(|place| around.holds(place));
        assert!(inside.clone().count() > 500);
        for place in inside {
            let block = block_of(lattice().base(place));
            assert!(around.meets(&lattice(), &block), "{place:?}");
        }
        // And not every block is.
        assert!(!around.meets(&lattice(), &block_of(lattice().base(&Vec3::repeat(0.3)))));
    }
}

// A point half the largest travel away is skipped for half of the step, and evaluated after
// that.
#[test]
fn points_are_looked_at_when_they_can_touch() {
    let gap = 0.5 * REACH.travel / SPHERE.radius;
    let places = vec![above(1.0 + gap), above(1.0 + 2.01 * gap)];
    let cloud = Cloud::new(places, Vec3::zeros());
    let body = cube();
    let mut loads = Loads::default();
    loads.find_candidates(&cloud, std::slice::from_ref(&body), REACH);
    assert_eq!(loads.candidates[0].len(), 1);
    assert!((loads.candidates[0][0].earliest - 0.5).abs() < 1e-9);
    // It has come into contact meanwhile.
    let cloud = Cloud::new(vec![above(0.5)], Vec3::zeros());
    for (passed, touching) in [(0.4, 0), (0.6, 1)] {
        cloud.loads(std::slice::from_ref(&body), &mut loads, passed);
        assert_eq!(loads.on_points.len(), touching);
    }
}
