//! Available nodal volume: the share of a node's kernel inside the domain and outside bodies
//! (docs/method.md, equations 39 and 40).

use crate::grid::{BLOCK, BlockKey, block_of};
use crate::kernel::{Lattice, REACH, share_above};
use crate::math::Vec3;
use crate::rigid::Body;
use crate::walls::{Boundary, NodeAccess, filled};
use std::ops::Range;

/// Kernel weight of a node at its own place.
const PEAK: f64 = 0.75 * 0.75 * 0.75;

/// Takes the volume behind walls and inside bodies from the nodes around them.
pub fn exclude_volume(boundary: &Boundary, bodies: &[Body], nodes: &mut impl NodeAccess) {
    boundary.exclude_volume(nodes);
    for body in bodies {
        exclude_body(body, nodes);
    }
    // A body in the channel takes room from a node's images as well.
    boundary.fill_ghost_nodes(nodes);
}

fn exclude_body(body: &Body, nodes: &mut impl NodeAccess) {
    let lattice = *nodes.lattice();
    let (low, high) = box_of(body, &lattice);
    // However small its share, a small body does not fill a kernel.
    let least = 1.0 - PEAK * body.shape.volume() / lattice.spacing.product();
    let width = lattice.spacing.max();
    let (first, last) = (block_of(low), block_of(high));
    for place in blocks_along(nodes.blocks(), first[0], last[0]) {
        let block = nodes.blocks()[place];
        if !(1..3).all(|axis| (first[axis]..=last[axis]).contains(&block[axis])) {
            continue;
        }
        let within = |axis: usize| {
            let first = block[axis] * BLOCK as i32;
            first.max(low[axis])..=(first + BLOCK as i32 - 1).min(high[axis])
        };
        for i in within(0) {
            for j in within(1) {
                for k in within(2) {
                    let Some(place) = nodes.place_of([i, j, k]) else {
                        continue;
                    };
                    let height = body.distance_to(&lattice.position([i, j, k]));
                    let room = share_above(height / width).max(least);
                    nodes.set_volume_fraction(place, filled(nodes.volume_fraction(place), room));
                }
            }
        }
    }
}

/// Range of those of the blocks, which come sorted, that lie between two along x: a large
/// body holds millions of cells, most of them without a point near.
fn blocks_along(blocks: &[BlockKey], first: i32, last: i32) -> Range<usize> {
    let start = blocks.partition_point(|block| block[0] < first);
    let end = blocks.partition_point(|block| block[0] <= last);
    start..end
}

/// Lowest and highest node whose kernel may meet a body.
fn box_of(body: &Body, lattice: &Lattice) -> ([i32; 3], [i32; 3]) {
    let reach = body.shape.bounding_radius() + REACH * lattice.spacing.max();
    let at = |sign: f64| {
        let corner = body.state.position + Vec3::repeat(sign * reach) - lattice.origin;
        let in_cells = corner.component_div(&lattice.spacing);
        [0, 1, 2].map(|axis| in_cells[axis].clamp(-1e9, 1e9) as i32)
    };
    (at(-1.0), at(1.0))
}
