//! Nodes of the grid, in blocks of 4³, only where points are, and their update (docs/method.md,
//! equations 8–10).

use super::lanes::Real;
use super::p2g::TransferTiles;
use super::rows::Tile;
use super::stencil::weights;
use crate::grid::layout::{Layout, within};
use crate::grid::{BLOCK_NODES, BlockKey, resize_list};
use crate::kernel::{Lattice, PointStencil, WIDTH};
use crate::math::{Sym3, Vec3};
use crate::walls::NodeAccess;
use fearless_simd::{Level, dispatch, prelude::*};
use rayon::prelude::*;

mod block;

pub use block::NodeBlock;
use block::{Push, WholeBlock, add_up, advance, fill, per_mass, take, take_residual};

/// Blocks of nodes one task takes.
const TASK: usize = 16;
/// The grid of one step.
#[derive(Debug)]
pub struct Nodes<R> {
    lattice: Lattice,
    layout: Layout,
    /// Mass [kg] and velocity [m/s].
    motion: Vec<NodeBlock<R>>,
    /// Volume of points over room for them, and what rounding took from the
    /// velocity since the transfer [m/s]: without that the same small change,
    /// added again and again, would be rounded the same way again and again.
    remainder: Vec<NodeBlock<R>>,
    /// Mean compressive strain at the transfer, and displacement since then [m].
    displacement: Vec<NodeBlock<R>>,
    /// Mean strain rate at the transfer [1/s], part by part.
    strain_rate: [Vec<NodeBlock<R>>; 2],
}

impl<R: Real> Nodes<R> {
    /// No nodes.
    pub fn new(lattice: Lattice) -> Self {
        Self {
            lattice,
            layout: Layout::default(),
            motion: Vec::new(),
            remainder: Vec::new(),
            displacement: Vec::new(),
            strain_rate: [Vec::new(), Vec::new()],
        }
    }

    /// Lays blocks of nodes round these blocks of points, which are sorted. The values of the nodes
    /// are undefined afterwards.
    pub fn lay_around(&mut self, blocks: impl ExactSizeIterator<Item = BlockKey> + Clone) {
        self.layout.lay_around(blocks);
        let count = self.layout.node_blocks().len();
        let parts = [
            &mut self.motion,
            &mut self.remainder,
            &mut self.displacement,
        ];
        for part in parts.into_iter().chain(&mut self.strain_rate) {
            resize_list(part, count, NodeBlock::EMPTY);
        }
    }

    /// Takes mass and momentum from the tiles of the points, v = Σ p / Σ m, and the mean of their
    /// strain rates, Σ m D / Σ m.
    pub fn take_momentum(
        &mut self,
        momentum: &[Tile<R>],
        strain_rate: [&[Tile<R>]; 2],
        level: Level,
    ) {
        let [first, second] = &mut self.strain_rate;
        self.motion
            .par_iter_mut()
            .zip(&mut self.remainder)
            .zip(&mut self.displacement)
            .zip(first.par_iter_mut().zip(second))
            .zip(self.layout.sources())
            .with_min_len(TASK)
            .for_each(|((((motion, remainder), displacement), means), sources)| {
                dispatch!(level, simd => {
                    take(simd, sources, momentum, motion);
                    for (mean, tiles) in [means.0, means.1].into_iter().zip(strain_rate) {
                        add_up(simd, sources, tiles, mean);
                        per_mass(simd, motion, mean);
                    }
                });
                *remainder = NodeBlock::EMPTY;
                *displacement = NodeBlock::EMPTY;
            });
    }

    /// Takes the residual of the momentum, and the compressive strains, from the tiles;
    /// `kernel_mass` is the mass that fills a kernel, ρ_c h³ [kg].
    pub fn take_residual(&mut self, tiles: &[Tile<R>], kernel_mass: R, level: Level) {
        self.for_each_block(|block, sources| {
            dispatch!(level, simd => {
                let mut residual = NodeBlock::EMPTY;
                add_up(simd, sources, tiles, &mut residual);
                take_residual(simd, &residual, kernel_mass, block);
            });
        });
    }

    /// v ← v + Δt (f/m + g) with the forces in the tiles; u ← u + Δt v.
    pub fn advance(&mut self, tiles: &[Tile<R>], gravity: &Vec3, dt: f64, level: Level) {
        let fall = [0, 1, 2].map(|axis| R::of(gravity[axis] * dt));
        let push = Push {
            fall: [R::ZERO, fall[0], fall[1], fall[2]],
            dt: R::of(dt),
        };
        self.for_each_block(|block, sources| {
            dispatch!(level, simd => {
                let mut forces = NodeBlock::EMPTY;
                add_up(simd, sources, tiles, &mut forces);
                advance(simd, &forces, &push, block);
            });
        });
    }

    /// Visits the blocks, each with the tiles that reach it, in parallel.
    fn for_each_block(&mut self, visit: impl Fn(WholeBlock<R>, &[u32; 8]) + Sync) {
        self.motion
            .par_iter_mut()
            .zip(&mut self.remainder)
            .zip(&mut self.displacement)
            .zip(self.layout.sources())
            .with_min_len(TASK)
            .for_each(|(((motion, remainder), displacement), sources)| {
                let block = WholeBlock {
                    motion,
                    remainder,
                    displacement,
                };
                visit(block, sources);
            });
    }

    /// Mass and velocity of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn motion_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile<R>) {
        fill(simd, self.layout.reach(block), &self.motion, tile);
    }

    /// Volume fraction of the nodes in the tile of a block of points, and values that points do not
    /// use.
    #[inline(always)]
    pub fn volume_fraction_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile<R>) {
        fill(simd, self.layout.reach(block), &self.remainder, tile);
    }

    /// Fills in mass, velocity and mean strain rate of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn transfer_tiles<S: Simd>(&self, simd: S, block: usize, tiles: &mut TransferTiles<R>) {
        let reach = self.layout.reach(block);
        fill(simd, reach, &self.motion, &mut tiles.motion);
        for (tile, nodes) in tiles.strain_rate.iter_mut().zip(&self.strain_rate) {
            fill(simd, reach, nodes, tile);
        }
    }

    /// Mean compressive strain and displacement of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn displacement_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile<R>) {
        fill(simd, self.layout.reach(block), &self.displacement, tile);
    }

    /// Velocity [m/s] and displacement [m] of the nodes at a place in a block of
    /// points, Σ w v_i and Σ w u_i.
    pub fn motion_at(&self, block: usize, position: &[R; 3]) -> (Vec3, Vec3) {
        let (base, weight) = weights(position);
        let reach = self.layout.reach(block);
        let (mut velocity, mut displacement) = ([R::ZERO; 4], [R::ZERO; 4]);
        for a in 0..WIDTH {
            for b in 0..WIDTH {
                let across = weight[0][a] * weight[1][b];
                for c in 0..WIDTH {
                    let local = [base[0] + a, base[1] + b, base[2] + c];
                    let (octant, node) = within(local);
                    let block = reach[octant] as usize;
                    let w = across * weight[2][c];
                    add_weighted(&mut velocity, self.motion[block].node(node), w);
                    add_weighted(&mut displacement, self.displacement[block].node(node), w);
                }
            }
        }
        (vector(&velocity), vector(&displacement))
    }

    /// Nodes at a place in a block of points: place and weight of each.
    pub fn stencil_at(&self, block: usize, position: &[R; 3]) -> PointStencil {
        let (base, weight) = weights(position);
        let reach = self.layout.reach(block);
        std::array::from_fn(|n| {
            let [a, b, c] = [n / (WIDTH * WIDTH), n / WIDTH % WIDTH, n % WIDTH];
            let (octant, node) = within([base[0] + a, base[1] + b, base[2] + c]);
            let place = reach[octant] * BLOCK_NODES as u32 + node as u32;
            let weight = weight[0][a] * weight[1][b] * weight[2][c];
            (place, weight.to_f64())
        })
    }

    /// Bytes allocated for nodes.
    pub fn bytes(&self) -> usize {
        self.motion.capacity() * 5 * size_of::<NodeBlock<R>>() + self.layout.bytes()
    }
}

impl<R: Real> NodeAccess for Nodes<R> {
    #[inline]
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    #[inline]
    fn blocks(&self) -> &[BlockKey] {
        self.layout.node_blocks()
    }

    #[inline]
    fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        self.layout.place_of(index)
    }

    #[inline]
    fn mass(&self, place: usize) -> f64 {
        self.motion[place / BLOCK_NODES].node(place % BLOCK_NODES)[0].to_f64()
    }

    #[inline]
    fn velocity(&self, place: usize) -> Vec3 {
        let (block, node) = (place / BLOCK_NODES, place % BLOCK_NODES);
        vector(self.motion[block].node(node)) + vector(self.remainder[block].node(node))
    }

    #[inline]
    fn displacement(&self, place: usize, dt: f64) -> Vec3 {
        // The displacement already contains the unconstrained motion.
        vector(self.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES))
            - self.velocity(place) * dt
    }

    #[inline]
    fn volume_fraction(&self, place: usize) -> f64 {
        self.remainder[place / BLOCK_NODES].node(place % BLOCK_NODES)[0].to_f64()
    }

    #[inline]
    fn set_volume_fraction(&mut self, place: usize, volume_fraction: f64) {
        self.remainder[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = R::of(volume_fraction);
    }

    #[inline]
    fn strain_rate(&self, place: usize) -> Sym3 {
        let part = |part: &[NodeBlock<R>]| {
            let node = part[place / BLOCK_NODES].node(place % BLOCK_NODES);
            [0, 1, 2, 3].map(|k| node[k].to_f64())
        };
        let [[xx, yy, zz, xy], [xz, yz, ..]] = self.strain_rate.each_ref().map(|of| part(of));
        Sym3::from_components([xx, yy, zz, xy, xz, yz])
    }

    #[inline]
    fn set_strain_rate(&mut self, place: usize, strain_rate: &Sym3) {
        let [xx, yy, zz, xy, xz, yz] = strain_rate.components();
        let parts = [[xx, yy, zz, xy], [xz, yz, 0.0, 0.0]];
        for (of, part) in self.strain_rate.iter_mut().zip(parts) {
            let node = &mut of[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)..][..4];
            node.copy_from_slice(&part.map(R::of));
        }
    }

    #[inline]
    fn compressive_strain(&self, place: usize) -> f64 {
        let node = self.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES);
        node[0].to_f64()
    }

    #[inline]
    fn set_compressive_strain(&mut self, place: usize, strain: f64) {
        self.displacement[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = R::of(strain);
    }

    #[inline]
    fn set_velocity(&mut self, place: usize, velocity: &Vec3, dt: f64) {
        let (block, node) = (place / BLOCK_NODES, place % BLOCK_NODES);
        let moving = &mut self.motion[block].0[4 * node..4 * node + 4];
        let moved = &mut self.displacement[block].0[4 * node..4 * node + 4];
        let remainder = &mut self.remainder[block].0[4 * node..4 * node + 4];
        for k in 0..3 {
            let new = R::of(velocity[k]);
            moved[k + 1] += (new - moving[k + 1]) * R::of(dt);
            moving[k + 1] = new;
            remainder[k + 1] = R::of(velocity[k] - new.to_f64());
        }
    }
}

fn add_weighted<R: Real>(sum: &mut [R; 4], part: &[R], weight: R) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += weight * *part;
    }
}

fn vector<R: Real>(numbers: &[R]) -> Vec3 {
    Vec3::new(
        numbers[1].to_f64(),
        numbers[2].to_f64(),
        numbers[3].to_f64(),
    )
}

#[cfg(test)]
mod tests;
