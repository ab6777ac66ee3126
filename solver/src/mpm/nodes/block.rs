//! Numbers of the nodes of one block, and the kernels that update them.

use crate::grid::layout::{OCTANTS, there};
use crate::grid::{BLOCK, BLOCK_NODES, TILE, in_block, in_tile};
use crate::mpm::lanes::{NODE_NUMBERS, ROW, Real, Row};
use crate::mpm::rows::Tile;
use fearless_simd::prelude::*;

/// Four numbers of each node of a block.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct NodeBlock<R>(pub(super) [R; NODE_NUMBERS * BLOCK_NODES]);

impl<R: Real> NodeBlock<R> {
    pub(super) const EMPTY: Self = Self([R::ZERO; NODE_NUMBERS * BLOCK_NODES]);

    pub(super) fn node(&self, node: usize) -> &[R] {
        &self.0[4 * node..4 * node + 4]
    }
}

/// All numbers of the nodes of a block; see [`Nodes`].
pub(super) struct WholeBlock<'a, R> {
    pub(super) motion: &'a mut NodeBlock<R>,
    pub(super) remainder: &'a mut NodeBlock<R>,
    pub(super) displacement: &'a mut NodeBlock<R>,
}

/// A node lighter than this [kg] is empty: its numbers would be rounding, and
/// the points hardly see it.
const LIGHTEST: f64 = 1e-30;
/// Changes that a sub-step adds to every node with mass.
pub(super) struct Push<R> {
    /// Δt g, after a zero [m/s].
    pub(super) fall: [R; 4],
    /// [s].
    pub(super) dt: R,
}

/// Rows along z that a tile shares with the block in an octant of it: the numbers along x and
/// y, and their beginning in the tile. They are whole, four nodes long, in the lower octants
/// and half as long in the upper ones.
const fn shared(octant: [usize; 3]) -> ([usize; 2], usize) {
    let rows = [
        if octant[0] == 0 { BLOCK } else { TILE - BLOCK },
        if octant[1] == 0 { BLOCK } else { TILE - BLOCK },
    ];
    let start = in_tile(octant[0] * BLOCK, octant[1] * BLOCK, octant[2] * BLOCK);
    (rows, start)
}

#[inline(always)]
pub(super) fn fill<S: Simd, R: Real>(
    simd: S,
    reach: &[u32; 8],
    blocks: &[NodeBlock<R>],
    tile: &mut Tile<R>,
) {
    for (octant, block) in OCTANTS.iter().zip(reach) {
        let nodes = &blocks[*block as usize].0;
        let ([along_x, along_y], start) = shared(*octant);
        for a in 0..along_x {
            for b in 0..along_y {
                let from = &nodes[4 * in_block(a, b, 0)..];
                let to = &mut tile.0[4 * (start + in_tile(a, b, 0))..];
                if octant[2] == 0 {
                    R::Row::<S>::load(simd, &from[..ROW]).store(&mut to[..ROW]);
                } else {
                    let half = R::TwoNodes::<S>::from_slice(simd, &from[..ROW / 2]);
                    half.store_slice(&mut to[..ROW / 2]);
                }
            }
        }
    }
}

#[inline(always)]
pub(super) fn add_up<S: Simd, R: Real>(
    simd: S,
    sources: &[u32; 8],
    tiles: &[Tile<R>],
    sums: &mut NodeBlock<R>,
) {
    *sums = NodeBlock::EMPTY;
    for (octant, source) in OCTANTS.iter().zip(sources) {
        let Some(source) = there(*source) else {
            continue;
        };
        let tile = &tiles[source].0;
        let ([along_x, along_y], start) = shared(*octant);
        for a in 0..along_x {
            for b in 0..along_y {
                let part = &tile[4 * (start + in_tile(a, b, 0))..];
                let sum = &mut sums.0[4 * in_block(a, b, 0)..];
                if octant[2] == 0 {
                    let (part, sum) = (&part[..ROW], &mut sum[..ROW]);
                    let part = R::Row::<S>::load(simd, part);
                    R::Row::load(simd, sum).plus(part).store(sum);
                } else {
                    let (part, sum) = (&part[..ROW / 2], &mut sum[..ROW / 2]);
                    let part = R::TwoNodes::<S>::from_slice(simd, part);
                    (R::TwoNodes::from_slice(simd, sum) + part).store_slice(sum);
                }
            }
        }
    }
}

#[inline(always)]
pub(super) fn take<S: Simd, R: Real>(
    simd: S,
    sources: &[u32; 8],
    tiles: &[Tile<R>],
    motion: &mut NodeBlock<R>,
) {
    add_up(simd, sources, tiles, motion);
    for node in motion.0.chunks_exact_mut(4) {
        let mass = node[0];
        if mass > R::of(LIGHTEST) {
            let velocity =
                R::Quad::<S>::from_slice(simd, node) * quad::<S, R>(simd, R::of(1.0) / mass);
            velocity.store_slice(node);
            node[0] = mass;
        } else {
            quad::<S, R>(simd, R::ZERO).store_slice(node);
        }
    }
}

/// Sums over nodes with mass, over their masses; zero elsewhere.
#[inline(always)]
pub(super) fn per_mass<S: Simd, R: Real>(simd: S, motion: &NodeBlock<R>, sums: &mut NodeBlock<R>) {
    for (sum, moving) in sums.0.chunks_exact_mut(4).zip(motion.0.chunks_exact(4)) {
        let mass = moving[0];
        let per_mass = if mass > R::ZERO {
            R::of(1.0) / mass
        } else {
            R::ZERO
        };
        let mean = R::Quad::<S>::from_slice(simd, sum) * quad::<S, R>(simd, per_mass);
        mean.store_slice(sum);
    }
}

#[inline(always)]
pub(super) fn take_residual<S: Simd, R: Real>(
    simd: S,
    residual: &NodeBlock<R>,
    kernel_mass: R,
    block: WholeBlock<R>,
) {
    let WholeBlock {
        motion,
        remainder,
        displacement,
    } = block;
    for node in 0..BLOCK_NODES {
        let moving = &mut motion.0[4 * node..4 * node + 4];
        let given = &residual.0[4 * node..4 * node + 4];
        let mass = moving[0];
        remainder.0[4 * node] = (mass + given[0]) / kernel_mass;
        if mass > R::ZERO {
            let per_mass = quad::<S, R>(simd, R::of(1.0) / mass);
            displacement.0[4 * node] = given[0] / mass;
            let missing = R::Quad::<S>::from_slice(simd, given);
            let velocity = missing.mul_add(per_mass, R::Quad::<S>::from_slice(simd, moving));
            velocity.store_slice(moving);
            moving[0] = mass;
        }
    }
}

#[inline(always)]
pub(super) fn advance<S: Simd, R: Real>(
    simd: S,
    forces: &NodeBlock<R>,
    push: &Push<R>,
    block: WholeBlock<R>,
) {
    let WholeBlock {
        motion,
        remainder,
        displacement,
    } = block;
    let fall = R::Quad::<S>::from_slice(simd, &push.fall);
    let dt = quad::<S, R>(simd, push.dt);
    for node in 0..BLOCK_NODES {
        let here = 4 * node..4 * node + 4;
        let moving = &mut motion.0[here.clone()];
        let mass = moving[0];
        if mass > R::ZERO {
            let left = &mut remainder.0[here.clone()];
            let moved = &mut displacement.0[here.clone()];
            let (volume_fraction, compressive) = (left[0], moved[0]);
            let force = R::Quad::<S>::from_slice(simd, &forces.0[here]);
            let before = R::Quad::<S>::from_slice(simd, moving);
            let owed = fall + R::Quad::<S>::from_slice(simd, left);
            // Kahan's sum.
            let change = force.mul_add(quad::<S, R>(simd, push.dt / mass), owed);
            let velocity = before + change;
            (change - (velocity - before)).store_slice(left);
            let displaced = velocity.mul_add(dt, R::Quad::<S>::from_slice(simd, moved));
            displaced.store_slice(moved);
            velocity.store_slice(moving);
            (moving[0], left[0], moved[0]) = (mass, volume_fraction, compressive);
        }
    }
}

#[inline(always)]
fn quad<S: Simd, R: Real>(simd: S, value: R) -> R::Quad<S> {
    R::Quad::<S>::simd_from(simd, value)
}
