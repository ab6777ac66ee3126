use crate::bed::PlanarBed;
use crate::math::Vec3;
use crate::walls::tests::{H, channel, constrained, grid_with, velocity};
use crate::walls::{Impulse, Walls};
use std::sync::Arc;

/// A channel whose bed is one plane through a place, falling along x.
fn slope(degrees: f64, through: &Vec3, friction: f64) -> Walls {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let normal = Vec3::new(sin, 0.0, cos);
    let mut walls = channel(8, 0.0, 0.0);
    let bed = PlanarBed::incline(degrees.to_radians(), normal.dot(through), friction);
    walls.bed = Arc::new(bed);
    walls
}

fn at([i, j, k]: [i32; 3]) -> Vec3 {
    Vec3::new(f64::from(i), f64::from(j), f64::from(k)) * H
}

/// Slopes with a column that crosses each: its nodes in order, the first two in the channel at
/// places 1 and 2, and its intersection with the bed.
fn crossings() -> Vec<(Walls, Vec<[i32; 3]>, Vec3)> {
    let standing = |degrees, gap| {
        let foot = at([5, 3, 4]) - Vec3::z() * gap * H;
        let nodes = vec![[5, 3, 3], [5, 3, 4], [5, 3, 5]];
        (slope(degrees, &foot, 0.5), nodes, foot)
    };
    let lying = |degrees, gap| {
        let foot = at([5, 3, 4]) - Vec3::x() * gap * H;
        let nodes = vec![[4, 3, 4], [5, 3, 4], [6, 3, 4]];
        (slope(degrees, &foot, 0.5), nodes, foot)
    };
    vec![
        standing(0.0, 0.0),
        standing(0.0, 0.25),
        standing(35.0, 0.7),
        standing(60.0, 0.0),
        lying(70.0, 0.4),
        lying(90.0, 0.0),
    ]
}

// A shear flow at rest on the bed is unchanged, nodes behind included.
#[test]
fn a_linear_flow_that_sticks_to_the_base_stays() {
    for (walls, nodes, _) in crossings() {
        let base = &walls.bed.planes()[0];
        let along = base.normal.cross(&Vec3::y()) * 3.0;
        let moving = |node: &[i32; 3]| (*node, along * base.height(&at(*node)));
        let moving: Vec<_> = nodes.iter().map(moving).collect();
        let mut grid = grid_with(&moving);
        let given = constrained(&walls, &mut grid);
        for (node, before) in moving {
            assert!((velocity(&grid, node) - before).norm() < 1e-14);
        }
        assert!(given.linear.norm() < 1e-14);
    }
}

// For any initial motion: afterwards velocities lie on a line, there is no inflow at the bed's
// position, and the change is that of one force there, on the cone of friction.
#[test]
fn the_base_acts_at_its_own_place() {
    for (walls, nodes, foot) in crossings() {
        let base = &walls.bed.planes()[0];
        let along = base.normal.cross(&Vec3::y());
        let arriving = [
            along * 3.0 - base.normal,
            along * 4.0 - base.normal * 0.5 + Vec3::y() * 0.3,
            along * 4.5 - base.normal * 0.75,
        ];
        let moving: Vec<_> = nodes.iter().copied().zip(arriving).collect();
        let mut grid = grid_with(&moving);
        let given = constrained(&walls, &mut grid);
        let [behind, first, second] = [0, 1, 2].map(|which| velocity(&grid, nodes[which]));
        assert!((2.0 * first - second - behind).norm() < 1e-14);
        let gap = (at(nodes[1]) - foot).norm() / H;
        let there = first * (1.0 + gap) - second * gap;
        assert!(there.dot(&base.normal).abs() < 1e-14, "{there}");
        let pressed = given.linear.dot(&base.normal);
        let rubbed = (given.linear - base.normal * pressed).norm();
        assert!(pressed > 0.1 && (rubbed - 0.5 * pressed).abs() < 1e-13);
        assert!((given.angular - foot.cross(&given.linear)).norm() < 1e-14);
    }
}

#[test]
fn what_leaves_the_base_is_left_alone() {
    for (walls, nodes, _) in crossings() {
        let leaving = |which: usize| (nodes[which], walls.bed.planes()[0].normal * which as f64);
        let moving = [0, 1, 2].map(leaving);
        let mut grid = grid_with(&moving);
        constrained(&walls, &mut grid);
        for (node, before) in moving {
            assert!((velocity(&grid, node) - before).norm() < 1e-14);
        }
    }
}

// A lone node does not determine a velocity gradient: it is stopped as it is.
#[test]
fn a_lone_node_behind_the_base_is_held() {
    for (walls, nodes, _) in crossings() {
        let mut grid = grid_with(&[(nodes[0], -walls.bed.planes()[0].normal)]);
        let given = constrained(&walls, &mut grid);
        assert!(velocity(&grid, nodes[0]).norm() < 1e-15);
        assert_ne!(given, Impulse::default());
    }
}
