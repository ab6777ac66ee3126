//! Numbers of the nodes of one block, and the kernels that update them.

use crate::grid::layout::there;
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

/// Numbers of a block of nodes.
type Numbers<R> = [R; NODE_NUMBERS * BLOCK_NODES];

/// Octant of a tile, which overlaps a block there. The octant is known to the compiler, so that
/// every row is loaded and stored at a place that it knows: a block with few points costs little more
/// than these.
struct Octant<const X: usize, const Y: usize, const Z: usize>;

impl<const X: usize, const Y: usize, const Z: usize> Octant<X, Y, Z> {
    /// Rows along z that they share, along x and y; in the lower octants four nodes long, in the
    /// upper ones two.
    const ROWS: [usize; 2] = [
        if X == 0 { BLOCK } else { TILE - BLOCK },
        if Y == 0 { BLOCK } else { TILE - BLOCK },
    ];

    /// Places of the first numbers of a row in the block and in the tile.
    #[inline(always)]
    const fn row(a: usize, b: usize) -> [usize; 2] {
        let in_tile = in_tile(X * BLOCK + a, Y * BLOCK + b, Z * BLOCK);
        [NODE_NUMBERS * in_block(a, b, 0), NODE_NUMBERS * in_tile]
    }

    /// Copies the nodes of the block to the tile.
    #[inline(always)]
    fn fill<S: Simd, R: Real>(simd: S, nodes: &Numbers<R>, tile: &mut Tile<R>) {
        for a in 0..Self::ROWS[0] {
            for b in 0..Self::ROWS[1] {
                let [from, to] = Self::row(a, b);
                if Z == 0 {
                    let row = R::Row::<S>::load(simd, &nodes[from..from + ROW]);
                    row.store(&mut tile.0[to..to + ROW]);
                } else {
                    let half = R::TwoNodes::<S>::from_slice(simd, &nodes[from..from + ROW / 2]);
                    half.store_slice(&mut tile.0[to..to + ROW / 2]);
                }
            }
        }
    }

    /// Adds the numbers of a tile, if it is there, to those of the block.
    #[inline(always)]
    fn add<S: Simd, R: Real>(simd: S, tiles: &[Tile<R>], source: u32, sums: &mut Numbers<R>) {
        let Some(source) = there(source) else {
            return;
        };
        let tile = &tiles[source].0;
        for a in 0..Self::ROWS[0] {
            for b in 0..Self::ROWS[1] {
                let [to, from] = Self::row(a, b);
                if Z == 0 {
                    let (part, sum) = (&tile[from..from + ROW], &mut sums[to..to + ROW]);
                    let part = R::Row::<S>::load(simd, part);
                    R::Row::load(simd, sum).plus(part).store(sum);
                } else {
                    let part = &tile[from..from + ROW / 2];
                    let sum = &mut sums[to..to + ROW / 2];
                    let part = R::TwoNodes::<S>::from_slice(simd, part);
                    (R::TwoNodes::from_slice(simd, sum) + part).store_slice(sum);
                }
            }
        }
    }
}

/// Copies the nodes of the eight blocks that a tile overlaps to it.
#[inline(always)]
pub(super) fn fill<S: Simd, R: Real>(
    simd: S,
    reach: &[u32; 8],
    blocks: &[NodeBlock<R>],
    tile: &mut Tile<R>,
) {
    // In the order of the octants, see `OCTANTS`.
    Octant::<0, 0, 0>::fill(simd, &blocks[reach[0] as usize].0, tile);
    Octant::<0, 0, 1>::fill(simd, &blocks[reach[1] as usize].0, tile);
    Octant::<0, 1, 0>::fill(simd, &blocks[reach[2] as usize].0, tile);
    Octant::<0, 1, 1>::fill(simd, &blocks[reach[3] as usize].0, tile);
    Octant::<1, 0, 0>::fill(simd, &blocks[reach[4] as usize].0, tile);
    Octant::<1, 0, 1>::fill(simd, &blocks[reach[5] as usize].0, tile);
    Octant::<1, 1, 0>::fill(simd, &blocks[reach[6] as usize].0, tile);
    Octant::<1, 1, 1>::fill(simd, &blocks[reach[7] as usize].0, tile);
}

/// Sums up the parts of the tiles that overlap a block.
#[inline(always)]
pub(super) fn add_up<S: Simd, R: Real>(
    simd: S,
    sources: &[u32; 8],
    tiles: &[Tile<R>],
    sums: &mut NodeBlock<R>,
) {
    *sums = NodeBlock::EMPTY;
    Octant::<0, 0, 0>::add(simd, tiles, sources[0], &mut sums.0);
    Octant::<0, 0, 1>::add(simd, tiles, sources[1], &mut sums.0);
    Octant::<0, 1, 0>::add(simd, tiles, sources[2], &mut sums.0);
    Octant::<0, 1, 1>::add(simd, tiles, sources[3], &mut sums.0);
    Octant::<1, 0, 0>::add(simd, tiles, sources[4], &mut sums.0);
    Octant::<1, 0, 1>::add(simd, tiles, sources[5], &mut sums.0);
    Octant::<1, 1, 0>::add(simd, tiles, sources[6], &mut sums.0);
    Octant::<1, 1, 1>::add(simd, tiles, sources[7], &mut sums.0);
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
