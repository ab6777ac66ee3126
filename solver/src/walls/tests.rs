use super::*;
use crate::bed::PlanarBed;
use crate::grid::fixture::PlainGrid;
use crate::kernel::Lattice;

pub(super) const H: f64 = 0.01;
const PACE: WallPace = WallPace {
    dt: 1e-3,
    crossing: 1.0,
};

pub(super) fn plane(name: &'static str, normal: Vec3, offset: f64, flow_friction: f64) -> Plane {
    Plane {
        name,
        normal,
        offset,
        flow_friction,
    }
}

/// A flat channel of so many cells across, with this friction on base and sides.
pub(super) fn channel(cells_across: i32, base_friction: f64, side_friction: f64) -> Walls {
    let width = f64::from(cells_across) * H;
    Walls {
        bed: Arc::new(PlanarBed::floor(base_friction)),
        vertical_walls: Some(VerticalWalls {
            ends: Ends::Back(VerticalBoundary::Wall(plane(
                "back wall",
                Vec3::x(),
                0.0,
                side_friction,
            ))),
            sides: [
                VerticalBoundary::Wall(plane("right side wall", Vec3::y(), 0.0, side_friction)),
                VerticalBoundary::Wall(plane("left side wall", -Vec3::y(), -width, side_friction)),
            ],
            halves_across: 2 * cells_across,
        }),
    }
}

/// A grid round a few blocks with mass 1 at these nodes, with these velocities.
pub(super) fn grid_with(nodes: &[([i32; 3], Vec3)]) -> PlainGrid {
    let lattice = Lattice {
        origin: Vec3::zeros(),
        spacing: Vec3::repeat(H),
    };
    let mut grid = PlainGrid::around(lattice, nodes.iter().map(|(index, _)| *index));
    for (index, velocity) in nodes {
        let node = grid.node(*index);
        (node.mass, node.velocity) = (1.0, *velocity);
    }
    grid
}

pub(super) fn velocity(grid: &PlainGrid, index: [i32; 3]) -> Vec3 {
    grid.nodes[grid.place_of(index).expect("its block is there")].velocity
}

/// Constrains, and checks that the reported impulse of the walls is the change of momentum.
pub(super) fn constrained(walls: &Walls, grid: &mut PlainGrid) -> Impulse {
    let momentum = |grid: &PlainGrid| {
        let mut sum = Impulse::default();
        for (place, node) in grid.nodes.iter().enumerate() {
            let at = grid.lattice.position(grid.index_of(place)) + node.displacement;
            sum.add_at(&at, &(node.velocity * node.mass));
        }
        sum
    };
    let before = momentum(grid);
    let mut boundary = Boundary::default();
    walls.find_boundary(grid, &mut boundary);
    let given = walls.constrain(&mut boundary, grid, PACE);
    let after = momentum(grid);
    assert!((after.linear - before.linear - given.linear).norm() < 1e-14);
    assert!((after.angular - before.angular - given.angular).norm() < 1e-14);
    given
}

#[test]
fn inflow_stops_and_friction_takes_its_share() {
    let at = [5, 3, 0];
    let mut grid = grid_with(&[(at, Vec3::new(3.0, 4.0, -2.0))]);
    let given = constrained(&channel(8, 0.5, 0.0), &mut grid);
    // Speed 5 along the floor less μ × 2.
    assert!((velocity(&grid, at) - Vec3::new(2.4, 3.2, 0.0)).norm() < 1e-14);
    assert!((given.linear - Vec3::new(-0.6, -0.8, 2.0)).norm() < 1e-14);
}

#[test]
fn friction_stops_but_never_turns_back() {
    let mut grid = grid_with(&[([5, 3, 0], Vec3::new(0.3, 0.4, -2.0))]);
    constrained(&channel(8, 0.5, 0.0), &mut grid);
    assert_eq!(velocity(&grid, [5, 3, 0]), Vec3::zeros());
}

#[test]
fn leaving_the_floor_is_free_and_so_is_all_above() {
    let (rising, above) = (Vec3::new(1.0, 0.0, 0.1), Vec3::new(1.0, 0.0, -5.0));
    let mut grid = grid_with(&[([5, 3, 0], rising), ([5, 3, 1], above)]);
    let given = constrained(&channel(8, 0.5, 0.0), &mut grid);
    assert_eq!(velocity(&grid, [5, 3, 0]), rising);
    assert_eq!(velocity(&grid, [5, 3, 1]), above);
    assert_eq!(given, Impulse::default());
}

#[test]
fn nodes_below_the_floor_are_held_too() {
    let mut grid = grid_with(&[([5, 3, -1], Vec3::new(0.0, 0.0, -1.0))]);
    constrained(&channel(8, 0.0, 0.0), &mut grid);
    assert_eq!(velocity(&grid, [5, 3, -1]), Vec3::zeros());
}

/// The vertical walls of a channel.
fn vertical(walls: &mut Walls) -> &mut VerticalWalls {
    walls.vertical_walls.as_mut().expect("a channel has them")
}

/// The walls as planes of symmetry.
fn symmetric(mut walls: Walls) -> Walls {
    let sides = vertical(&mut walls).sides.clone();
    vertical(&mut walls).sides = sides.map(|side| match side {
        VerticalBoundary::Wall(plane) | VerticalBoundary::Symmetry(plane) => {
            VerticalBoundary::Symmetry(plane)
        }
    });
    walls
}

// A node and its image behind a smooth side are one flow and its reflection: both end with the
// mean, mirrored, and no momentum is lost along the wall. A plane of symmetry also mirrors
// flow that moves off it.
#[test]
fn a_smooth_side_mirrors() {
    let right = ([5, 1, 4], [5, -1, 4], [5, 0, 4], -1.0);
    let left = ([5, 7, 4], [5, 9, 4], [5, 8, 4], 1.0);
    let wall = channel(8, 0.0, 0.0);
    let symmetry = symmetric(wall.clone());
    for (walls, (node, image, on, outward), towards) in [
        (&wall, right, 1.0),
        (&wall, left, 1.0),
        (&symmetry, right, 1.0),
        (&symmetry, left, -1.0),
    ] {
        let across = outward * towards;
        let mut grid = grid_with(&[
            (node, Vec3::new(1.0, 0.5 * across, 3.0)),
            (image, Vec3::new(2.0, 0.1 * across, -1.0)),
            (on, Vec3::new(1.0, 9.0 * across, 2.0)),
        ]);
        let given = constrained(walls, &mut grid);
        let mean = Vec3::new(1.5, 0.2 * across, 1.0);
        assert!((velocity(&grid, node) - mean).norm() < 1e-15);
        let mirrored = Vec3::new(1.5, -0.2 * across, 1.0);
        assert!((velocity(&grid, image) - mirrored).norm() < 1e-15);
        assert_eq!(velocity(&grid, on), Vec3::new(1.0, 0.0, 2.0));
        assert!(given.linear.x.abs() < 1e-15 && given.linear.z.abs() < 1e-15);
    }
}

// Flow that separates from a wall moves on, its images with it; flow pressed there by the
// forces of a sub-step is held.
#[test]
fn flow_leaves_a_wall_once_it_outruns_its_pressure() {
    let walls = channel(8, 0.0, 0.0);
    let leaving = Vec3::new(1.0, 0.5, 3.0);
    let nodes = [[5, 1, 4], [5, -1, 4], [5, 0, 4]];
    let mut grid = grid_with(&nodes.map(|node| (node, leaving)));
    let mut boundary = Boundary::default();
    walls.find_boundary(&grid, &mut boundary);
    assert_eq!(walls.join(&mut boundary, &mut grid), Impulse::default());
    for (lost, held) in [(0.1, false), (0.3, true)] {
        for node in nodes {
            let place = grid.place_of(node).expect("its block is there");
            grid.set_velocity(place, &(leaving - Vec3::y() * lost), 0.0);
        }
        walls.constrain(&mut boundary, &mut grid, PACE);
        let on_wall = velocity(&grid, nodes[2]).y;
        assert_eq!(on_wall == 0.0, held, "{on_wall}");
    }
}

// In the edge between back wall and side a node has three images.
#[test]
fn a_corner_mirrors_both_ways() {
    let v = Vec3::new(-1.0, -2.0, 3.0);
    let mut grid = grid_with(&[
        ([1, 1, 4], v * 4.0),
        ([-1, -1, 4], Vec3::zeros()),
        ([-1, 1, 4], Vec3::zeros()),
        ([1, -1, 4], Vec3::zeros()),
    ]);
    constrained(&channel(8, 0.0, 0.0), &mut grid);
    assert!((velocity(&grid, [1, 1, 4]) - v).norm() < 1e-15);
    assert!((velocity(&grid, [-1, -1, 4]) - Vec3::new(1.0, 2.0, 3.0)).norm() < 1e-15);
    assert!((velocity(&grid, [-1, 1, 4]) - Vec3::new(1.0, -2.0, 3.0)).norm() < 1e-15);
}

#[test]
fn one_cell_across_lies_between_two_mirrors() {
    let v = Vec3::new(1.0, 2.0, 3.0);
    let mut grid = grid_with(&[
        ([5, 0, 4], v),
        ([5, 1, 4], v),
        ([5, -1, 4], v),
        ([5, 2, 4], v),
    ]);
    constrained(&channel(1, 0.0, 0.0), &mut grid);
    for j in -1..=2 {
        assert!(
            (velocity(&grid, [5, j, 4]) - Vec3::new(1.0, 0.0, 3.0)).norm() < 1e-15,
            "{j}"
        );
    }
}

// A wall node pushed into the side at 2 m/s is pressed with that impulse, by which friction
// takes 0.25 from 5 m/s along the wall.
#[test]
fn a_rough_side_rubs() {
    let mut grid = grid_with(&[([5, 0, 4], Vec3::new(3.0, -2.0, 4.0))]);
    let given = constrained(&channel(8, 0.0, 0.25), &mut grid);
    assert!((velocity(&grid, [5, 0, 4]) - Vec3::new(2.7, 0.0, 3.6)).norm() < 1e-14);
    assert!((given.linear - Vec3::new(-0.3, 2.0, -0.4)).norm() < 1e-14);
    // Off the wall it is released.
    let mut grid = grid_with(&[([5, 0, 4], Vec3::new(3.0, 2.0, 4.0))]);
    constrained(&channel(8, 0.0, 0.25), &mut grid);
    assert_eq!(velocity(&grid, [5, 0, 4]), Vec3::new(3.0, 2.0, 4.0));
}

// On the back wall and below the incline a node must not move through either; it may slide
// down the slope.
#[test]
fn at_the_foot_of_the_back_wall_only_the_slope_is_open() {
    let mut walls = channel(8, 0.0, 0.0);
    let inclination = 0.6f64.atan2(0.8);
    let offset = 0.6 * H + 0.8 * 4.0 * H;
    walls.bed = Arc::new(PlanarBed::floor(0.0).with_incline(inclination, offset, 0.0));
    let mut grid = grid_with(&[([0, 3, 2], Vec3::new(-1.0, 0.5, -2.0))]);
    constrained(&walls, &mut grid);
    assert!((velocity(&grid, [0, 3, 2]) - Vec3::new(0.96, 0.5, -0.72)).norm() < 1e-15);
}

// Nodes a period apart are one node: velocities are those of their joint momentum, which is
// conserved, and both have the same available volume.
#[test]
fn nodes_across_a_seam_move_as_one() {
    let mut walls = channel(4, 0.0, 0.0);
    vertical(&mut walls).ends = Ends::Seam { cells: 8 };
    let pair = [[1, 2, 5], [9, 2, 5]];
    let fast = Vec3::new(3.0, 0.0, 1.0);
    let mut grid = grid_with(&[(pair[0], fast), (pair[1], Vec3::zeros())]);
    for (node, volume_fraction) in pair.iter().zip([0.75, 0.5]) {
        let place = grid.place_of(*node).expect("its block is there");
        grid.set_volume_fraction(place, volume_fraction);
    }
    let mut boundary = Boundary::default();
    walls.find_boundary(&grid, &mut boundary);
    boundary.exclude_volume(&mut grid);
    walls.reflect(&mut boundary, &mut grid);
    for node in pair {
        assert_eq!(velocity(&grid, node), fast / 2.0);
        let place = grid.place_of(node).expect("its block is there");
        assert_eq!(grid.volume_fraction(place), 1.25);
    }
}

#[test]
fn what_leaves_through_a_seam_comes_in_again() {
    let mut walls = channel(4, 0.0, 0.0);
    assert_eq!(vertical(&mut walls).periodic_shift(9.0), None);
    vertical(&mut walls).ends = Ends::Seam { cells: 8 };
    for (along, shift) in [
        (-0.1, Some(8)),
        (0.0, None),
        (7.9, None),
        (8.0, Some(-8)),
        (17.0, Some(-16)),
    ] {
        assert_eq!(vertical(&mut walls).periodic_shift(along), shift, "{along}");
    }
}
