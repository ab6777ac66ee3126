//! The nodes of the fast path: blocks of 4³, only where points are, in single
//! precision (docs/method.md, equations 8–10).

use super::passes::Part;
use super::rows::Tile;
use super::stencil::weights;
use crate::grid::layout::{Layout, OCTANTS, there, within};
use crate::grid::{BLOCK, BLOCK_NODES, BlockKey, TILE, in_block, in_tile};
use crate::kernel::{Lattice, PointStencil, WIDTH};
use crate::math::{Sym3, Vec3};
use crate::walls::NodeAccess;
use fearless_simd::{Level, dispatch, f32x4, f32x8, f32x16, prelude::*};
use rayon::prelude::*;

/// Four numbers of each node of a block.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub struct NodeBlock([f32; 4 * BLOCK_NODES]);

impl NodeBlock {
    const EMPTY: Self = Self([0.0; 4 * BLOCK_NODES]);

    fn node(&self, node: usize) -> &[f32] {
        &self.0[4 * node..4 * node + 4]
    }
}

/// All numbers of the nodes of a block; see [`Nodes`].
struct WholeBlock<'a> {
    motion: &'a mut NodeBlock,
    remainder: &'a mut NodeBlock,
    displacement: &'a mut NodeBlock,
}

/// A node lighter than this [kg] is empty: its values would be rounding errors, and their
/// effect on the points is negligible.
const LIGHTEST: f32 = 1e-30;
/// Blocks of nodes per task.
const TASK: usize = 16;
/// The grid of one step.
#[derive(Debug)]
pub struct Nodes {
    lattice: Lattice,
    layout: Layout,
    /// Mass [kg] and velocity [m/s].
    motion: Vec<NodeBlock>,
    /// Nodal volume fraction, and the Kahan compensation of the velocity since the transfer [m/s]:
    /// without it the same small change, added repeatedly, would be rounded the same way each time.
    remainder: Vec<NodeBlock>,
    /// Mean compressive strain at the transfer, and displacement since then [m].
    displacement: Vec<NodeBlock>,
    /// Mean strain rate at the transfer [1/s], part by part.
    strain_rate: [Vec<NodeBlock>; 2],
}

impl Nodes {
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

    /// Gathers mass and momentum from the tiles of the points: v = Σ p / Σ m.
    pub fn take_momentum(&mut self, tiles: &[Tile], level: Level) {
        self.for_each_block(|block, sources| {
            dispatch!(level, simd => take(simd, sources, tiles, block.motion));
            *block.remainder = NodeBlock::EMPTY;
            *block.displacement = NodeBlock::EMPTY;
        });
    }

    /// Gathers the residual momentum and the compressive strains from the tiles; `room` is the mass
    /// that fills a kernel, ρ_c h³ [kg].
    pub fn take_rest(&mut self, tiles: &[Tile], room: f32, level: Level) {
        self.for_each_block(|block, sources| {
            dispatch!(level, simd => {
                let mut rest = NodeBlock::EMPTY;
                add_up(simd, sources, tiles, &mut rest);
                take_rest(simd, &rest, room, block);
            });
        });
    }

    /// Gathers the mean of a part of the strain rates from the tiles: Σ m D / Σ m.
    pub fn take_strain_rates(&mut self, part: Part, tiles: &[Tile], level: Level) {
        self.strain_rate[part as usize]
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
    pub fn advance(&mut self, tiles: &[Tile], gravity: &Vec3, dt: f64, level: Level) {
        let fall = gravity.map(|g| (g * dt) as f32);
        let push = Push {
            fall: [0.0, fall.x, fall.y, fall.z],
            dt: dt as f32,
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
    fn for_each_block(&mut self, visit: impl Fn(WholeBlock, &[u32; 8]) + Sync) {
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
    pub fn motion_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile) {
        fill(simd, self.layout.reach(block), &self.motion, tile);
    }

    /// Volume fraction of the nodes in the tile of a block of points, and values that points do not
    /// use.
    #[inline(always)]
    pub fn fullness_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile) {
        fill(simd, self.layout.reach(block), &self.remainder, tile);
    }

    /// Part of the mean strain rate of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn strain_rate_tile<S: Simd>(&self, simd: S, block: usize, part: Part, tile: &mut Tile) {
        let strain_rate = &self.strain_rate[part as usize];
        fill(simd, self.layout.reach(block), strain_rate, tile);
    }

    /// Mean compressive strain and displacement of the nodes in the tile of a block of points.
    #[inline(always)]
    pub fn displacement_tile<S: Simd>(&self, simd: S, block: usize, tile: &mut Tile) {
        fill(simd, self.layout.reach(block), &self.displacement, tile);
    }

    /// Velocity [m/s] and displacement [m] of the nodes at a place in a block of
    /// points, Σ w v_i and Σ w u_i.
    pub fn motion_at(&self, block: usize, position: &[f32; 3]) -> (Vec3, Vec3) {
        let (base, weight) = weights(position);
        let reach = self.layout.reach(block);
        let (mut velocity, mut displacement) = ([0.0; 4], [0.0; 4]);
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

    /// Stencil at a place in a block of points: place and weight of each node.
    pub fn stencil_at(&self, block: usize, position: &[f32; 3]) -> PointStencil {
        let (base, weight) = weights(position);
        let reach = self.layout.reach(block);
        std::array::from_fn(|n| {
            let [a, b, c] = [n / (WIDTH * WIDTH), n / WIDTH % WIDTH, n % WIDTH];
            let (octant, node) = within([base[0] + a, base[1] + b, base[2] + c]);
            let place = reach[octant] * BLOCK_NODES as u32 + node as u32;
            let weight = weight[0][a] * weight[1][b] * weight[2][c];
            (place, f64::from(weight))
        })
    }

    /// Bytes allocated for nodes.
    pub fn bytes(&self) -> usize {
        self.motion.capacity() * 5 * size_of::<NodeBlock>() + self.layout.bytes()
    }
}

impl NodeAccess for Nodes {
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
        f64::from(self.motion[place / BLOCK_NODES].node(place % BLOCK_NODES)[0])
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
        f64::from(self.remainder[place / BLOCK_NODES].node(place % BLOCK_NODES)[0])
    }

    fn set_volume_fraction(&mut self, place: usize, volume_fraction: f64) {
        self.remainder[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = volume_fraction as f32;
    }

    fn strain_rate(&self, place: usize) -> Sym3 {
        let part = |part: &[NodeBlock]| {
            let node = part[place / BLOCK_NODES].node(place % BLOCK_NODES);
            [0, 1, 2, 3].map(|k| f64::from(node[k]))
        };
        let [[xx, yy, zz, xy], [xz, yz, ..]] = self.strain_rate.each_ref().map(|of| part(of));
        Sym3 {
            xx,
            yy,
            zz,
            xy,
            xz,
            yz,
        }
    }

    fn set_strain_rate(&mut self, place: usize, strain_rate: &Sym3) {
        let d = strain_rate;
        let parts = [[d.xx, d.yy, d.zz, d.xy], [d.xz, d.yz, 0.0, 0.0]];
        for (of, part) in self.strain_rate.iter_mut().zip(parts) {
            let node = &mut of[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)..][..4];
            node.copy_from_slice(&part.map(|value| value as f32));
        }
    }

    fn compressive_strain(&self, place: usize) -> f64 {
        let node = self.displacement[place / BLOCK_NODES].node(place % BLOCK_NODES);
        f64::from(node[0])
    }

    fn set_compressive_strain(&mut self, place: usize, strain: f64) {
        self.displacement[place / BLOCK_NODES].0[4 * (place % BLOCK_NODES)] = strain as f32;
    }

    fn set_velocity(&mut self, place: usize, velocity: &Vec3, dt: f64) {
        let (block, node) = (place / BLOCK_NODES, place % BLOCK_NODES);
        let moving = &mut self.motion[block].0[4 * node..4 * node + 4];
        let moved = &mut self.displacement[block].0[4 * node..4 * node + 4];
        let remainder = &mut self.remainder[block].0[4 * node..4 * node + 4];
        for k in 0..3 {
            let new = velocity[k] as f32;
            moved[k + 1] += (new - moving[k + 1]) * dt as f32;
            moving[k + 1] = new;
            remainder[k + 1] = (velocity[k] - f64::from(new)) as f32;
        }
    }
}

/// Increments of every node with mass in a sub-step.
struct Push {
    /// Δt g, after a zero [m/s].
    fall: [f32; 4],
    /// Length of the sub-step [s].
    dt: f32,
}

fn add_weighted(sum: &mut [f32; 4], part: &[f32], weight: f32) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += weight * part;
    }
}

fn vector(numbers: &[f32]) -> Vec3 {
    Vec3::new(
        f64::from(numbers[1]),
        f64::from(numbers[2]),
        f64::from(numbers[3]),
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
fn fill<S: Simd>(simd: S, reach: &[u32; 8], blocks: &[NodeBlock], tile: &mut Tile) {
    for (octant, block) in OCTANTS.iter().zip(reach) {
        let nodes = &blocks[*block as usize].0;
        let ([along_x, along_y], start) = shared(*octant);
        for a in 0..along_x {
            for b in 0..along_y {
                let from = &nodes[4 * in_block(a, b, 0)..];
                let to = &mut tile.0[4 * (start + in_tile(a, b, 0))..];
                if octant[2] == 0 {
                    copy::<S, f32x16<S>>(simd, from, to);
                } else {
                    copy::<S, f32x8<S>>(simd, from, to);
                }
            }
        }
    }
}

#[inline(always)]
fn copy<S: Simd, V: SimdBase<S, Element = f32>>(simd: S, from: &[f32], to: &mut [f32]) {
    V::from_slice(simd, &from[..V::LEN]).store_slice(&mut to[..V::LEN]);
}

#[inline(always)]
fn add_up<S: Simd>(simd: S, sources: &[u32; 8], tiles: &[Tile], sums: &mut NodeBlock) {
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
                    add::<S, f32x16<S>>(simd, part, sum);
                } else {
                    add::<S, f32x8<S>>(simd, part, sum);
                }
            }
        }
    }
}

#[inline(always)]
fn add<S: Simd, V: SimdFloat<S, Element = f32>>(simd: S, part: &[f32], sum: &mut [f32]) {
    let part = V::from_slice(simd, &part[..V::LEN]);
    (V::from_slice(simd, &sum[..V::LEN]) + part).store_slice(&mut sum[..V::LEN]);
}

#[inline(always)]
fn take<S: Simd>(simd: S, sources: &[u32; 8], tiles: &[Tile], motion: &mut NodeBlock) {
    add_up(simd, sources, tiles, motion);
    for node in motion.0.chunks_exact_mut(4) {
        let mass = node[0];
        if mass > LIGHTEST {
            let velocity = f32x4::from_slice(simd, node) * f32x4::splat(simd, 1.0 / mass);
            velocity.store_slice(node);
            node[0] = mass;
        } else {
            f32x4::splat(simd, 0.0).store_slice(node);
        }
    }
}

/// Sums over nodes with mass, over their masses; zero elsewhere.
#[inline(always)]
fn per_mass<S: Simd>(simd: S, motion: &NodeBlock, sums: &mut NodeBlock) {
    for (sum, moving) in sums.0.chunks_exact_mut(4).zip(motion.0.chunks_exact(4)) {
        let mass = moving[0];
        let per_mass = if mass > 0.0 { 1.0 / mass } else { 0.0 };
        let mean = f32x4::from_slice(simd, sum) * f32x4::splat(simd, per_mass);
        mean.store_slice(sum);
    }
}

#[inline(always)]
fn take_rest<S: Simd>(simd: S, rest: &NodeBlock, room: f32, block: WholeBlock) {
    let WholeBlock {
        motion,
        remainder,
        displacement,
    } = block;
    for node in 0..BLOCK_NODES {
        let moving = &mut motion.0[4 * node..4 * node + 4];
        let given = &rest.0[4 * node..4 * node + 4];
        let mass = moving[0];
        remainder.0[4 * node] = (mass + given[0]) / room;
        if mass > 0.0 {
            let per_mass = f32x4::splat(simd, 1.0 / mass);
            displacement.0[4 * node] = given[0] / mass;
            let missing = f32x4::from_slice(simd, given);
            let velocity = missing.mul_add(per_mass, f32x4::from_slice(simd, moving));
            velocity.store_slice(moving);
            moving[0] = mass;
        }
    }
}

#[inline(always)]
fn advance<S: Simd>(simd: S, forces: &NodeBlock, push: &Push, block: WholeBlock) {
    let WholeBlock {
        motion,
        remainder,
        displacement,
    } = block;
    let fall = f32x4::from_slice(simd, &push.fall);
    let dt = f32x4::splat(simd, push.dt);
    for node in 0..BLOCK_NODES {
        let here = 4 * node..4 * node + 4;
        let moving = &mut motion.0[here.clone()];
        let mass = moving[0];
        if mass > 0.0 {
            let left = &mut remainder.0[here.clone()];
            let moved = &mut displacement.0[here.clone()];
            let (volume_fraction, compressive) = (left[0], moved[0]);
            let force = f32x4::from_slice(simd, &forces.0[here]);
            let before = f32x4::from_slice(simd, moving);
            let owed = fall + f32x4::from_slice(simd, left);
            // Kahan summation.
            let change = force.mul_add(f32x4::splat(simd, push.dt / mass), owed);
            let velocity = before + change;
            (change - (velocity - before)).store_slice(left);
            let displaced = velocity.mul_add(dt, f32x4::from_slice(simd, moved));
            displaced.store_slice(moved);
            velocity.store_slice(moving);
            (moving[0], left[0], moved[0]) = (mass, volume_fraction, compressive);
        }
    }
}
