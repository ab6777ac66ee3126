//! Nodes of the grid, in blocks of 4³, only where points are, and their update (docs/method.md,
//! equations 8–10).

use super::lanes::{NODE_NUMBERS, ROW, Real, Row};
use super::p2g::Components;
use super::rows::Tile;
use super::stencil::weights;
use crate::grid::layout::{Layout, OCTANTS, there, within};
use crate::grid::{BLOCK, BLOCK_NODES, BlockKey, TILE, in_block, in_tile};
use crate::kernel::{Lattice, PointStencil, WIDTH};
use crate::math::{Sym3, Vec3};
use crate::walls::NodeAccess;
use fearless_simd::{Level, dispatch, prelude::*};
use rayon::prelude::*;

/// Four numbers of each node of a block.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct NodeBlock<R>([R; NODE_NUMBERS * BLOCK_NODES]);

impl<R: Real> NodeBlock<R> {
    const EMPTY: Self = Self([R::ZERO; NODE_NUMBERS * BLOCK_NODES]);

    fn node(&self, node: usize) -> &[R] {
        &self.0[4 * node..4 * node + 4]
    }
}

/// All numbers of the nodes of a block; see [`Nodes`].
struct WholeBlock<'a, R> {
    motion: &'a mut NodeBlock<R>,
    remainder: &'a mut NodeBlock<R>,
    displacement: &'a mut NodeBlock<R>,
}

/// A node lighter than this [kg] is empty: its numbers would be rounding, and
/// the points hardly see it.
const LIGHTEST: f64 = 1e-30;
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
        self.motion.resize(count, NodeBlock::EMPTY);
        self.remainder.resize(count, NodeBlock::EMPTY);
        self.displacement.resize(count, NodeBlock::EMPTY);
        for part in &mut self.strain_rate {
            part.resize(count, NodeBlock::EMPTY);
        }
    }

    /// Takes mass and momentum from the tiles of the points: v = Σ p / Σ m.
    pub fn take_momentum(&mut self, tiles: &[Tile<R>], level: Level) {
        self.for_each_block(|block, sources| {
            dispatch!(level, simd => take(simd, sources, tiles, block.motion));
            *block.remainder = NodeBlock::EMPTY;
            *block.displacement = NodeBlock::EMPTY;
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

    /// Takes the mean of a part of the strain rates from the tiles: Σ m D / Σ m.
    pub fn take_strain_rates(&mut self, components: Components, tiles: &[Tile<R>], level: Level) {
        self.strain_rate[components as usize]
            .par_iter_mut()
            .zip(&self.motion)
            .zip(self.layout.sources())
            .with_min_len(TASK)
            .for_each(|((strain_rate, motion), sources)| {
                dispatch!(level, simd => {
                    add_up(simd, sources, tiles, strain_rate);
                    per_mass(simd, motion, strain_rate);
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

    /// Part of the mean strain rate of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn strain_rate_tile<S: Simd>(
        &self,
        simd: S,
        block: usize,
        components: Components,
        tile: &mut Tile<R>,
    ) {
        let strain_rate = &self.strain_rate[components as usize];
        fill(simd, self.layout.reach(block), strain_rate, tile);
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
    fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    fn blocks(&self) -> &[BlockKey] {
        self.layout.node_blocks()
    }

    fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        self.layout.place_of(index)
    }

    fn mass(&self, place: usize) -> f64 {
        self.motion[place / BLOCK_NODES].node(place % BLOCK_NODES)[0].to_f64()
    }

    fn velocity(&self, place: usize) -> Vec3 {
        let (block, node) = (place / BLOCK_NODES, place % BLOCK_NODES);
        vector(self.motion[block].node(node)) + vector(self.remainder[block].node(node))
    }

    fn displacement(&self, place: usize, dt: f64) -> Vec3 {
        // The displacement already contains the unconstrained motion.
        vector(self.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES))
            - self.velocity(place) * dt
    }

    fn volume_fraction(&self, place: usize) -> f64 {
        self.remainder[place / BLOCK_NODES].node(place % BLOCK_NODES)[0].to_f64()
    }

    fn set_volume_fraction(&mut self, place: usize, volume_fraction: f64) {
        self.remainder[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = R::of(volume_fraction);
    }

    fn strain_rate(&self, place: usize) -> Sym3 {
        let part = |part: &[NodeBlock<R>]| {
            let node = part[place / BLOCK_NODES].node(place % BLOCK_NODES);
            [0, 1, 2, 3].map(|k| node[k].to_f64())
        };
        let [[xx, yy, zz, xy], [xz, yz, ..]] = self.strain_rate.each_ref().map(|of| part(of));
        Sym3::from_components([xx, yy, zz, xy, xz, yz])
    }

    fn set_strain_rate(&mut self, place: usize, strain_rate: &Sym3) {
        let [xx, yy, zz, xy, xz, yz] = strain_rate.components();
        let parts = [[xx, yy, zz, xy], [xz, yz, 0.0, 0.0]];
        for (of, part) in self.strain_rate.iter_mut().zip(parts) {
            let node = &mut of[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)..][..4];
            node.copy_from_slice(&part.map(R::of));
        }
    }

    fn compressive_strain(&self, place: usize) -> f64 {
        let node = self.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES);
        node[0].to_f64()
    }

    fn set_compressive_strain(&mut self, place: usize, strain: f64) {
        self.displacement[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = R::of(strain);
    }

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

/// Changes that a sub-step adds to every node with mass.
struct Push<R> {
    /// Δt g, after a zero [m/s].
    fall: [R; 4],
    /// [s].
    dt: R,
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
fn fill<S: Simd, R: Real>(simd: S, reach: &[u32; 8], blocks: &[NodeBlock<R>], tile: &mut Tile<R>) {
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
fn add_up<S: Simd, R: Real>(
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
fn take<S: Simd, R: Real>(
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
fn per_mass<S: Simd, R: Real>(simd: S, motion: &NodeBlock<R>, sums: &mut NodeBlock<R>) {
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
fn take_residual<S: Simd, R: Real>(
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
fn advance<S: Simd, R: Real>(simd: S, forces: &NodeBlock<R>, push: &Push<R>, block: WholeBlock<R>) {
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

#[cfg(test)]
mod tests;
