use super::*;
use crate::grid::{BLOCK, TILE, TILE_NODES, block_of, in_tile, index_of};
use crate::mpm::fixture::levels;

fn lattice() -> Lattice {
    Lattice {
        origin: Vec3::new(-0.1, 0.0, 0.2),
        spacing: Vec3::new(0.01, 0.02, 0.03),
    }
}

/// Two neighbouring blocks with points and one far off, across the origin.
const KEYS: [BlockKey; 3] = [[-1, -1, 0], [0, -1, 0], [5, 5, 5]];

fn laid_out() -> Nodes<f64> {
    let mut nodes = Nodes::new(lattice());
    nodes.lay_around(KEYS.into_iter());
    nodes
}

/// Takes tiles of which every node has the mass of its block's number, 1, 2 and 3 kg, and the
/// momentum of 1 N s along x.
fn scattered() -> Nodes<f64> {
    let mut nodes = laid_out();
    let mut tiles = vec![Tile::EMPTY; KEYS.len()];
    for (number, tile) in (1..).zip(&mut tiles) {
        for place in 0..TILE_NODES {
            tile.node_mut(place)
                .copy_from_slice(&[f64::from(number), 1.0, 0.0, 0.0]);
        }
    }
    let no_strain = vec![Tile::EMPTY; KEYS.len()];
    nodes.take_momentum(&tiles, [&no_strain; 2], levels()[0]);
    nodes
}

fn places(nodes: &Nodes<f64>) -> std::ops::Range<usize> {
    0..nodes.motion.len() * BLOCK_NODES
}

// Tiles are 6³: the two neighbours share 2 × 6 × 6 nodes, where both add up.
#[test]
fn tiles_add_up_where_they_overlap() {
    let nodes = scattered();
    let momentum = |place: usize| nodes.mass(place) * nodes.velocity(place).x;
    let touched = |count: f64| {
        let places = places(&nodes);
        places
            .filter(|place| (momentum(*place) - count).abs() < 1e-12)
            .count()
    };
    assert_eq!(touched(2.0), 2 * TILE * TILE);
    assert_eq!(touched(1.0), 3 * TILE_NODES - 2 * 2 * TILE * TILE);
    let shared = nodes.place_of([1, 0, 2]).expect("it is there");
    assert_eq!(nodes.mass(shared), 1.0 + 2.0);
}

#[test]
fn a_tile_reads_the_nodes_it_wrote() {
    let nodes = scattered();
    for (block, key) in KEYS.iter().enumerate() {
        let mut tile = Tile::EMPTY;
        dispatch!(levels()[0], simd => nodes.motion_tile(simd, block, &mut tile));
        for (a, b, c) in [(0, 0, 0), (3, 4, 5), (5, 5, 5), (2, 0, 4)] {
            let first = key.map(|key| key * BLOCK as i32);
            let index = [first[0] + a, first[1] + b, first[2] + c];
            let node = nodes.place_of(index).expect("it is in reach");
            let place = in_tile(a as usize, b as usize, c as usize);
            assert_eq!(tile.node_mut(place)[0], nodes.mass(node));
        }
    }
}

// A nodal field linear in position is interpolated exactly between the nodes, also where a
// stencil extends over several blocks of its tile.
#[test]
fn motion_between_nodes_is_that_of_a_linear_field() {
    let mut nodes = laid_out();
    let field = |x: &Vec3| Vec3::new(1.0 + x.y, 2.0 * x.x - x.z, 0.5 * x.z);
    for place in places(&nodes) {
        let key = nodes.blocks()[place / BLOCK_NODES];
        let local = place % BLOCK_NODES;
        let velocity = field(&lattice().position(index_of(key, local)));
        nodes.set_velocity(place, &velocity, 0.0);
        let moved = &mut nodes.displacement[place / BLOCK_NODES].0[4 * local..4 * local + 4];
        moved[1..].copy_from_slice((-velocity).as_slice());
    }
    for in_cells in [[-3.3, -3.2, 0.7], [-0.6, -0.6, 4.4], [-2.0, -1.1, 3.9]] {
        let x = lattice().origin + Vec3::from(in_cells).component_mul(&lattice().spacing);
        assert_eq!(block_of(lattice().base(&x)), KEYS[0]);
        let in_block = [0, 1, 2].map(|axis| in_cells[axis] - f64::from(KEYS[0][axis] * 4));
        let (velocity, displacement) = nodes.motion_at(0, &in_block);
        assert!((velocity - field(&x)).norm() < 1e-14);
        assert!((displacement + field(&x)).norm() < 1e-14);
    }
}

#[test]
fn nodes_without_mass_stay_still() {
    let mut nodes = scattered();
    let mut tiles = vec![Tile::EMPTY; KEYS.len()];
    for tile in &mut tiles {
        for place in 0..TILE_NODES {
            tile.node_mut(place)[1] = 1.0;
        }
    }
    let gravity = Vec3::new(0.0, 0.0, -10.0);
    nodes.advance(&tiles, &gravity, 0.5, levels()[0]);
    let (mut still, mut moved) = (0, 0);
    for place in places(&nodes) {
        let node = nodes.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES);
        if nodes.mass(place) == 0.0 {
            assert_eq!(node[1..], [0.0; 3]);
            still += 1;
        } else {
            assert_eq!(nodes.velocity(place).z, -5.0);
            assert_eq!(node[3], -2.5);
            moved += 1;
        }
    }
    assert!(still > 0 && moved > 0);
}
