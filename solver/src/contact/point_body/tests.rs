use super::*;
use crate::grid::block_of;
use crate::kernel::Lattice;
use crate::math::{Mat3, Sym3};
use crate::points::sort_by_block;
use crate::rigid::fixture::cuboid;
use nalgebra::UnitQuaternion;

const SPHERE: PointSphere = PointSphere {
    radius: 0.003,
    impedance: 5.0,
    spacing: 0.005,
};

fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(0.01),
    }
}

fn point(id: u32, position: Vec3) -> Point {
    Point {
        id,
        mass: 1e-3,
        volume: 1e-6,
        position,
        velocity: Vec3::zeros(),
        affine: Mat3::zeros(),
        stress: Sym3::default(),
    }
}

/// A grid that moves as one, with the points laid on it.
fn grid_moving(points: &mut Vec<Point>, velocity: Vec3) -> Grid {
    let occupied = sort_by_block(points, &lattice());
    let mut grid = Grid::new(lattice());
    grid.reset_around(&occupied);
    for place in 0..grid.nodes().len() {
        grid.node_mut(place).velocity = velocity;
    }
    grid
}

/// The cube of 0.04 m, turned and moving, its centre at 0.1 m on every axis.
fn cube() -> Body {
    let mut body = cuboid([0.04; 3]);
    body.state.position = Vec3::repeat(0.1);
    body
}

/// Forces on points where they stand, the grid moving as one.
fn loads(points: &mut Vec<Point>, velocity: Vec3, body: &Body) -> Loads {
    let grid = grid_moving(points, velocity);
    let bodies = std::slice::from_ref(body);
    let mut loads = Loads::default();
    loads.find_candidates(points, &grid, bodies, 0.01);
    loads.evaluate(points, &grid, bodies, SPHERE, 1e-5);
    loads
}

/// A place over the upper face: so far above the flat, in R_p.
fn above(in_radii: f64) -> Vec3 {
    Vec3::new(0.105, 0.098, 0.12 + in_radii * SPHERE.radius)
}

#[test]
fn a_point_in_touch_is_pushed_out_and_the_body_back() {
    let mut points = vec![point(0, above(0.5))];
    let body = cube();
    let loads = loads(&mut points, Vec3::zeros(), &body);
    let force = loads.on_points[0];
    // Hertz at δ = R_p/2, the point at rest.
    let expected = body.flow_law.stiffness * (0.5 * SPHERE.radius).powf(1.5);
    assert!((force - Vec3::new(0.0, 0.0, expected)).norm() < 1e-9 * expected);
    let on_body = loads.on_bodies[0];
    assert_eq!(on_body.load.force, -force);
    let arm = points[0].position - body.state.position;
    assert_eq!(on_body.load.torque, arm.cross(&-force));
    assert_eq!(on_body.touching_points, 1);
    let overlap = 0.5 * SPHERE.radius / (SPHERE.radius + body.shape.sphero_radius());
    assert!((on_body.deepest_overlap_ratio - overlap).abs() < 1e-9);
    assert!((on_body.energy / (0.4 * expected * 0.5 * SPHERE.radius) - 1.0).abs() < 1e-9);
}

#[test]
fn apart_is_apart() {
    let mut points = vec![point(0, above(1.01)), point(1, Vec3::repeat(0.2))];
    let loads = loads(&mut points, Vec3::new(0.0, 0.0, -5.0), &cube());
    assert_eq!(loads.on_points, vec![Vec3::zeros(); 2]);
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
    let place = |n: u32| 0.07 + 0.004 * f64::from(n);
    let mut points: Vec<_> = (0..16u32.pow(3))
        .map(|id| {
            point(
                id,
                Vec3::new(place(id % 16), place(id / 16 % 16), place(id / 256)),
            )
        })
        .collect();
    let loads = loads(&mut points, Vec3::new(0.3, -0.2, 0.4), &body);
    let (mut force, mut torque) = (Vec3::zeros(), Vec3::zeros());
    for (point, on_point) in points.iter().zip(&loads.on_points) {
        force += on_point;
        torque += (point.position - body.state.position).cross(on_point);
    }
    let on_body = loads.on_bodies[0];
    assert!(on_body.touching_points > 50);
    assert!((force + on_body.load.force).norm() < 1e-10 * on_body.load.force.norm());
    assert!((torque + on_body.load.torque).norm() < 1e-10);
}

#[test]
fn what_leaves_is_not_held_back() {
    let leaving = loads(
        &mut vec![point(0, above(0.9))],
        Vec3::new(0.0, 0.0, 50.0),
        &cube(),
    );
    assert_eq!(leaving.on_points[0], Vec3::zeros());
    let arriving = loads(
        &mut vec![point(0, above(0.9))],
        Vec3::new(0.0, 0.0, -50.0),
        &cube(),
    );
    let resting = loads(&mut vec![point(0, above(0.9))], Vec3::zeros(), &cube());
    assert!(arriving.on_points[0].z > resting.on_points[0].z);
}

#[test]
fn friction_is_coulombs_and_against_the_sliding() {
    let sliding = Vec3::new(2.0, 0.0, 0.0);
    let force = loads(&mut vec![point(0, above(0.5))], sliding, &cube()).on_points[0];
    assert!(force.y.abs() < 1e-12);
    assert!((force.x + 0.5 * force.z).abs() < 1e-12, "{force:?}");
    // Slow sliding is braked by no more than the impedance.
    let slow = Vec3::new(1e-4, 0.0, 0.0);
    let force = loads(&mut vec![point(0, above(0.5))], slow, &cube()).on_points[0];
    assert!(
        (force.x + SPHERE.impedance * 1e-4).abs() < 1e-12,
        "{force:?}"
    );
}

#[test]
fn forces_of_the_last_sub_step_are_gone() {
    let mut points = vec![point(0, above(0.5))];
    let grid = grid_moving(&mut points, Vec3::zeros());
    let mut body = cube();
    let mut loads = Loads::default();
    loads.find_candidates(&points, &grid, std::slice::from_ref(&body), 0.01);
    loads.evaluate(&points, &grid, std::slice::from_ref(&body), SPHERE, 1e-5);
    assert!(loads.on_points[0].z > 0.0);
    body.state.position.z -= 0.01;
    loads.evaluate(&points, &grid, &[body], SPHERE, 1e-5);
    assert_eq!(loads.on_points[0], Vec3::zeros());
    assert_eq!(loads.on_bodies[0], FlowLoad::default());
}

#[test]
fn points_in_the_core_are_put_on_its_surface() {
    let body = cube();
    let radius = body.shape.sphero_radius();
    let core_top = 0.12 - radius;
    let places = [
        Vec3::new(0.1, 0.1, core_top - 1e-3),
        Vec3::new(0.1, 0.1, core_top + 1e-3),
        Vec3::repeat(0.15),
    ];
    let mut points: Vec<_> = (0u32..).zip(places).map(|(id, at)| point(id, at)).collect();
    let grid = grid_moving(&mut points, Vec3::zeros());
    assert_eq!(put_back(&mut points, &grid, &[body]), 1);
    points.sort_unstable_by_key(|point| point.id);
    assert!((points[0].position - Vec3::new(0.1, 0.1, 0.12)).norm() < 1e-15);
    assert_eq!(points[1].position, places[1]);
    assert_eq!(points[2].position, places[2]);
}

// The search must not lose a point near a face of its block, wherever the
// body's own box ends: it is moved over a block in steps of a third of a cell.
#[test]
fn every_point_in_reach_is_a_candidate() {
    let place = |n: u32| 0.055 + 0.0031 * f64::from(n);
    let mut points: Vec<_> = (0..30u32.pow(3))
        .map(|id| {
            point(
                id,
                Vec3::new(place(id % 30), place(id / 30 % 30), place(id / 900)),
            )
        })
        .collect();
    let grid = grid_moving(&mut points, Vec3::zeros());
    let mut body = cube();
    for _ in 0..12 {
        body.state.position += Vec3::repeat(0.0033);
        let around = Around::body(&body, 0.01);
        let mut loads = Loads::default();
        loads.find_candidates(&points, &grid, std::slice::from_ref(&body), 0.01);
        let wanted = points.iter().filter(|p| around.holds(&p.position)).count();
        assert!(wanted > 500 && wanted < points.len());
        assert_eq!(loads.candidates[0].len(), wanted);
        for candidate in &loads.candidates[0] {
            let base = lattice().base(&points[candidate.point].position);
            assert_eq!(grid.point_blocks()[candidate.block].key, block_of(base));
        }
    }
}
