//! Inspection of the points in all blocks: their sums, and offending points.

use crate::bed::{Bed, HeightField};
use crate::diagnostics::Totals;
use crate::grid::{BLOCK, BlockKey, first_node};
use crate::kernel::Lattice;
use crate::math::Vec3;
use crate::mpm::blocks::Block;
use crate::mpm::lanes::Real;
use crate::mpm::packing::Packing;
use crate::simulation::flow::offending_point::{Bounds, OffendingPoint};
use crate::walls::Plane;

/// Sum over the blocks, half by half: a tree of its own, so that the sum does not depend on the
/// threads.
pub(super) fn sum_up<R: Real>(
    blocks: &[Block<R>],
    of: &(impl Fn(&Block<R>) -> Totals + Sync),
) -> Totals {
    match blocks {
        [] => Totals::default(),
        [block] => of(block),
        _ => {
            let (low, high) = blocks.split_at(blocks.len() / 2);
            let (low, high) = rayon::join(|| sum_up(low, of), || sum_up(high, of));
            low.plus(&high)
        }
    }
}

/// An offending point, if there is one: of `every` block, or of those whose points are behind a
/// wall.
pub(super) fn find_offending_point<R: Real>(
    blocks: &[Block<R>],
    packing: &Packing,
    every: bool,
    bounds: &Bounds,
) -> Option<OffendingPoint> {
    let Bounds {
        walls, tolerance, ..
    } = *bounds;
    let lattice = &packing.lattice;
    let behind = |plane: &Plane, block: &Block<R>| {
        let height = |slot| {
            let position = block.position(slot);
            plane.height(&packing.position(&block.key, &position))
        };
        lowest(plane, lattice, &block.key) < -tolerance
            && (0..block.count()).any(|slot| height(slot) < -tolerance)
    };
    let in_ground = |ground: &HeightField, block: &Block<R>| {
        let lid = ground.lid_over([block.key[0], block.key[1]], lattice);
        // Along the vertical nothing is less deep than along the normal.
        let is_in = |slot| {
            let place = packing.position(&block.key, &block.position(slot));
            let deep = |over: f64| over - place.z > tolerance;
            deep(lid.elevation(place.x, place.y)) && deep(ground.elevation(place.x, place.y))
        };
        let (low, high) = corners(lattice, &block.key);
        lid.height_of_box(&low, &high) < -tolerance && (0..block.count()).any(is_in)
    };
    let suspect = |block: &&Block<R>| {
        let on_terrain = || walls.terrain.is_some_and(|ground| in_ground(ground, block));
        every || walls.planes.iter().any(|plane| behind(plane, block)) || on_terrain()
    };
    let suspects = blocks.iter().filter(suspect);
    let mut points = suspects.flat_map(|block| {
        (0..block.count()).map(|slot| packing.unpack(&block.key, &block.get(slot)))
    });
    points.find_map(|point| OffendingPoint::of(&point, bounds))
}

/// Height above a plane of the lowest possible place of a point of this block [m].
fn lowest(plane: &Plane, lattice: &Lattice, key: &BlockKey) -> f64 {
    let (low, high) = corners(lattice, key);
    plane.height_of_box(&low, &high)
}

/// Corners of the box of the points of this block [m].
fn corners(lattice: &Lattice, key: &BlockKey) -> (Vec3, Vec3) {
    let low = lattice.position(first_node(*key)) + lattice.spacing * 0.5;
    (low, low + lattice.spacing * BLOCK as f64)
}
