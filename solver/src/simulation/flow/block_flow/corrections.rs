//! Corrections of the points at the end of a step: penetration, periodic boundary, outflow.

use super::access::Place;
use crate::contact::point_body::{
    Candidate, PenetratingPoint, PenetrationCorrection, penetration_correction,
};
use crate::grid::{BLOCK, BlockKey, first_node};
use crate::mpm::blocks::Blocks;
use crate::mpm::lanes::Real;
use crate::mpm::packing::Packing;
use crate::points::Point;
use crate::rigid::Body;
use crate::simulation::setup::Outlet;
use crate::walls::{RigidWalls, VerticalWalls};

/// Applies the penetration correction to the candidates of every body; returns the number of
/// corrected points, and the deepest one that has no free position.
pub(super) fn correct_penetration<R: Real>(
    blocks: &mut Blocks<R>,
    packing: &Packing,
    candidates: &[Vec<Candidate<Place>>],
    bodies: &[Body],
    walls: &RigidWalls,
) -> (u64, Option<PenetratingPoint>) {
    let (mut count, mut stuck) = (0, None);
    for (which, (body, of_body)) in bodies.iter().zip(candidates).enumerate() {
        for candidate in of_body {
            let place = &candidate.place;
            let block = &mut blocks.occupied_mut()[place.block as usize];
            let slot = place.slot as usize;
            let position = packing.position(&block.key, &block.position(slot));
            match penetration_correction(&position, body, walls) {
                None => {}
                Some(PenetrationCorrection::To(outside)) => {
                    block.shift(slot, &packing.in_block(&block.key, &outside));
                    count += 1;
                }
                Some(PenetrationCorrection::NoRoom { depth }) => {
                    let here = PenetratingPoint {
                        point: block.get(slot).id,
                        body: which,
                        depth,
                    };
                    stuck = PenetratingPoint::deeper(stuck, here);
                }
            }
        }
    }
    (count, stuck)
}

/// Moves points that crossed a periodic boundary to its other end.
pub(super) fn wrap_periodic<R: Real>(blocks: &mut Blocks<R>, vertical_walls: &VerticalWalls) {
    if !vertical_walls.is_periodic() {
        return;
    }
    for block in blocks.occupied_mut() {
        let first = f64::from(block.key[0]) * BLOCK as f64;
        for slot in 0..block.count() {
            let [x, y, z] = block.position(slot);
            if let Some(cells) = vertical_walls.periodic_shift(first + x.to_f64()) {
                block.shift(slot, &[x + R::of(f64::from(cells)), y, z]);
            }
        }
    }
}

/// Takes out the points beyond the open ends.
pub(super) fn take_outflow<R: Real>(
    blocks: &mut Blocks<R>,
    packing: &Packing,
    outlet: &Outlet,
) -> Vec<Point> {
    let mut gone = Vec::new();
    let lattice = &packing.lattice;
    let near_end = |key: &BlockKey| {
        let corner = |beyond: i32| lattice.position(first_node(key.map(|k| k + beyond)));
        // Corners of the block, with the half cell by which its points may lie beyond it.
        let last = corner(1) + lattice.spacing;
        outlet.is_beyond(&last) || outlet.is_beyond(&(corner(0) - lattice.spacing))
    };
    blocks.take_out(near_end, |key, point| {
        let beyond = outlet.is_beyond(&packing.position(key, &point.position));
        if beyond {
            gone.push(packing.unpack(key, point));
        }
        beyond
    });
    gone
}
