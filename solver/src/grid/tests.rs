use super::*;

fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::new(-0.1, 0.0, 0.2),
        spacing: Vec3::new(0.01, 0.02, 0.03),
    }
}

/// Two neighbouring blocks with points and one far off, across the origin.
fn laid_out() -> Grid {
    let mut grid = Grid::new(lattice());
    grid.reset_around(&[([-1, -1, 0], 0..2), ([0, -1, 0], 2..3), ([5, 5, 5], 3..4)]);
    grid
}

#[test]
fn blocks_lie_only_where_points_reach() {
    let grid = laid_out();
    // Eight each, four of them shared by the neighbours.
    assert_eq!(grid.nodes().len(), (8 + 4 + 8) * BLOCK_NODES);
    assert_eq!(grid.place_of([0, 0, 40]), None);
    assert!(grid.place_of([-4, -4, 0]).is_some());
    assert_eq!(grid.place_of([-5, -4, 0]), None);
}

#[test]
fn place_and_index_are_inverse() {
    let grid = laid_out();
    for place in 0..grid.nodes().len() {
        assert_eq!(grid.place_of(grid.index_of(place)), Some(place));
    }
}

#[test]
fn negative_nodes_have_their_own_blocks() {
    assert_eq!(block_of([-1, 0, 3]), [-1, 0, 0]);
    assert_eq!(block_of([-4, -5, 4]), [-1, -2, 1]);
}

/// Fills each tile with its block's number, by place.
fn scattered() -> Grid {
    let mut grid = laid_out();
    grid.scatter(
        |block, tile| {
            for entry in tile.iter_mut() {
                *entry = [block.points.start as f64 + 1.0, 1.0, 0.0, 0.0];
            }
        },
        |node, [mass, count, ..]| {
            node.mass = mass;
            node.velocity.x = count;
        },
    );
    grid
}

// Tiles are 6³: the two neighbours share 2 × 6 × 6 nodes, where both add up.
#[test]
fn tiles_add_up_where_they_overlap() {
    let grid = scattered();
    let touched = |count: f64| {
        grid.nodes()
            .iter()
            .filter(|n| n.velocity.x == count)
            .count()
    };
    assert_eq!(touched(2.0), 2 * TILE * TILE);
    assert_eq!(touched(1.0), 3 * TILE_NODES - 2 * 2 * TILE * TILE);
    let shared = grid.place_of([1, 0, 2]).expect("it is there");
    assert_eq!(grid.nodes()[shared].mass, 1.0 + 3.0);
}

#[test]
fn a_tile_reads_the_nodes_it_wrote() {
    let grid = scattered();
    for block in grid.point_blocks() {
        let tile = grid.tile_of(block, |node| [node.mass, 0.0, 0.0, 0.0]);
        for (a, b, c) in [(0, 0, 0), (3, 4, 5), (5, 5, 5), (2, 0, 4)] {
            let first = block.key.map(|key| key * BLOCK as i32);
            let index = [first[0] + a, first[1] + b, first[2] + c];
            let node = grid.place_of(index).expect("it is in reach");
            let place = in_tile(a as usize, b as usize, c as usize);
            assert_eq!(tile[place][0], grid.nodes()[node].mass);
        }
    }
}

// A nodal field linear in position is interpolated exactly between the nodes, also where a
// stencil extends over several blocks of its tile.
#[test]
fn motion_between_nodes_is_that_of_a_linear_field() {
    let mut grid = laid_out();
    let field = |x: &Vec3| Vec3::new(1.0 + x.y, 2.0 * x.x - x.z, 0.5 * x.z);
    for place in 0..grid.nodes().len() {
        let position = grid.lattice().position(grid.index_of(place));
        let node = grid.node_mut(place);
        node.velocity = field(&position);
        node.displacement = -field(&position);
    }
    let block = grid.point_blocks()[0].clone();
    for in_cells in [[-3.3, -3.2, 0.7], [-0.6, -0.6, 4.4], [-2.0, -1.1, 3.9]] {
        let x = lattice().origin + Vec3::from(in_cells).component_mul(&lattice().spacing);
        let stencil = lattice().stencil(&x);
        assert_eq!(block_of(stencil.base), block.key);
        let (velocity, displacement) = grid.motion_at(&block, &stencil);
        assert!((velocity - field(&x)).norm() < 1e-14);
        assert!((displacement + field(&x)).norm() < 1e-14);
    }
}

#[test]
fn nodes_without_mass_stay_still() {
    let mut grid = scattered();
    let still = grid.nodes().iter().filter(|node| node.mass == 0.0).count();
    let gravity = Vec3::new(0.0, 0.0, -10.0);
    for node in &mut grid.nodes {
        node.force = Vec3::new(node.mass, 0.0, 0.0);
    }
    grid.advance_momentum(gravity, 0.5);
    grid.displace(2.0);
    let mut found = 0;
    for node in grid.nodes() {
        if node.mass == 0.0 {
            assert_eq!(node.displacement, Vec3::zeros());
            found += 1;
        } else {
            assert_eq!(node.velocity.z, -5.0);
            assert_eq!(node.displacement.z, -10.0);
        }
    }
    assert!(found == still && still > 0);
}
