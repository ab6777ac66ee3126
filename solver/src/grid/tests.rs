use super::fixture::PlainGrid;
use super::*;
use crate::kernel::Lattice;
use crate::math::Vec3;

/// Two neighbouring blocks with points and one far off, across the origin.
fn laid_out() -> PlainGrid {
    let lattice = Lattice {
        origin: Vec3::new(-0.1, 0.0, 0.2),
        spacing: Vec3::new(0.01, 0.02, 0.03),
    };
    PlainGrid::around(lattice, [[-4, -4, 0], [0, -4, 0], [20, 20, 20]].into_iter())
}

#[test]
fn blocks_lie_only_where_points_reach() {
    let grid = laid_out();
    // Eight each, four of them shared by the neighbours.
    assert_eq!(grid.nodes.len(), (8 + 4 + 8) * BLOCK_NODES);
    assert_eq!(grid.layout.place_of([0, 0, 40]), None);
    assert!(grid.layout.place_of([-4, -4, 0]).is_some());
    assert_eq!(grid.layout.place_of([-5, -4, 0]), None);
}

#[test]
fn place_and_index_are_inverse() {
    let grid = laid_out();
    for place in 0..grid.nodes.len() {
        assert_eq!(grid.layout.place_of(grid.index_of(place)), Some(place));
    }
}

#[test]
fn negative_nodes_have_their_own_blocks() {
    assert_eq!(block_of([-1, 0, 3]), [-1, 0, 0]);
    assert_eq!(block_of([-4, -5, 4]), [-1, -2, 1]);
}
