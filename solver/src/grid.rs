//! The background grid: nodes in blocks of 4³, only where points are.
//!
//! The points of a block scatter into a tile of 6³ nodes of their own; the tiles are then added
//! to the nodes in a fixed order. This runs in parallel without locks and gives the same bits
//! for any number of threads.

use crate::kernel::{Lattice, PointStencil, Stencil, WIDTH};
use crate::math::{Sym3, Vec3};
use layout::{Layout, OCTANTS, there, within};
use rayon::prelude::*;
use std::ops::Range;

pub mod layout;

/// Cells along a block's edge.
pub const BLOCK: usize = 4;
/// Nodes of a block.
pub const BLOCK_NODES: usize = BLOCK * BLOCK * BLOCK;
/// Nodes along a tile's edge: a block's cells and the kernel's reach.
pub const TILE: usize = BLOCK + WIDTH - 1;
/// Nodes of a tile.
pub const TILE_NODES: usize = TILE * TILE * TILE;

/// Contributions of the points of one block to the nodes of its tile.
pub type Tile = [[f64; 4]; TILE_NODES];

/// Index of a block along x, y, z.
pub type BlockKey = [i32; 3];

/// One node of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Mass [kg].
    pub mass: f64,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Displacement since the transfer [m].
    pub displacement: Vec3,
    /// Force of stress and contact [N].
    pub force: Vec3,
    /// Nodal volume fraction at the transfer.
    pub volume_fraction: f64,
    /// Mean compressive volumetric strain min(φ, 0) of its points at the transfer.
    pub compressive_strain: f64,
    /// Mean strain rate of its points at the transfer [1/s].
    pub strain_rate: Sym3,
}

impl Node {
    /// A node without points.
    pub const EMPTY: Self = Self {
        mass: 0.0,
        velocity: Vec3::new(0.0, 0.0, 0.0),
        displacement: Vec3::new(0.0, 0.0, 0.0),
        force: Vec3::new(0.0, 0.0, 0.0),
        volume_fraction: 0.0,
        compressive_strain: 0.0,
        strain_rate: Sym3 {
            xx: 0.0,
            yy: 0.0,
            zz: 0.0,
            xy: 0.0,
            xz: 0.0,
            yz: 0.0,
        },
    };
}

/// A block that holds points.
#[derive(Debug, Clone, PartialEq)]
pub struct PointBlock {
    /// Its key.
    pub key: BlockKey,
    /// Its points, by their index in the sorted list.
    pub points: Range<usize>,
    /// The node blocks that its tile overlaps, in the order of the octants.
    reach: [u32; 8],
}

/// The grid of one step.
#[derive(Debug)]
pub struct Grid {
    lattice: Lattice,
    point_blocks: Vec<PointBlock>,
    layout: Layout,
    nodes: Vec<Node>,
    tiles: Vec<Tile>,
}

/// The block of a lowest node index, see [`Lattice::base`].
pub fn block_of(base: [i32; 3]) -> BlockKey {
    base.map(|index| index.div_euclid(BLOCK as i32))
}

/// Place of node (a, b, c) of a tile.
pub const fn in_tile(a: usize, b: usize, c: usize) -> usize {
    (a * TILE + b) * TILE + c
}

/// Place of node (a, b, c) of a block.
pub const fn in_block(a: usize, b: usize, c: usize) -> usize {
    (a * BLOCK + b) * BLOCK + c
}

impl PointBlock {
    /// Place in the tile of a stencil's lowest node.
    pub fn tile_base(&self, base: [i32; 3]) -> usize {
        let local = [0, 1, 2].map(|axis| (base[axis] - self.key[axis] * BLOCK as i32) as usize);
        in_tile(local[0], local[1], local[2])
    }
}

impl Grid {
    /// An empty grid.
    pub fn new(lattice: Lattice) -> Self {
        Self {
            lattice,
            point_blocks: Vec::new(),
            layout: Layout::default(),
            nodes: Vec::new(),
            tiles: Vec::new(),
        }
    }

    /// Lattice of the nodes.
    pub fn lattice(&self) -> &Lattice {
        &self.lattice
    }

    /// The blocks that hold points.
    pub fn point_blocks(&self) -> &[PointBlock] {
        &self.point_blocks
    }

    /// The blocks of nodes, sorted.
    pub fn node_blocks(&self) -> &[BlockKey] {
        self.layout.node_blocks()
    }

    /// All nodes, block after block.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// Bytes allocated.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>()
            + self.tiles.capacity() * size_of::<Tile>()
            + self.point_blocks.capacity() * size_of::<PointBlock>()
            + self.layout.bytes()
    }

    /// A node by its place.
    pub fn node_mut(&mut self, place: usize) -> &mut Node {
        &mut self.nodes[place]
    }

    /// Empties the grid and lays blocks round the occupied ones, which are sorted and come with the
    /// range of their points.
    pub fn reset_around(&mut self, occupied: &[(BlockKey, Range<usize>)]) {
        self.layout.lay_around(occupied.iter().map(|(key, _)| *key));
        let count = self.layout.node_blocks().len();
        self.nodes.clear();
        self.nodes.resize(count * BLOCK_NODES, Node::EMPTY);
        self.tiles.resize(occupied.len(), [[0.0; 4]; TILE_NODES]);
        let blocks = occupied.iter().enumerate();
        self.point_blocks.clear();
        self.point_blocks
            .extend(blocks.map(|(place, (key, points))| PointBlock {
                key: *key,
                points: points.clone(),
                reach: *self.layout.reach(place),
            }));
    }

    /// Node index (i, j, k) of a node's place.
    pub fn index_of(&self, place: usize) -> [i32; 3] {
        let key = self.layout.node_blocks()[place / BLOCK_NODES];
        let local = place % BLOCK_NODES;
        let (a, b, c) = (
            local / (BLOCK * BLOCK),
            local / BLOCK % BLOCK,
            local % BLOCK,
        );
        [
            key[0] * BLOCK as i32 + a as i32,
            key[1] * BLOCK as i32 + b as i32,
            key[2] * BLOCK as i32 + c as i32,
        ]
    }

    /// Place of node (i, j, k), if its block is there.
    pub fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        self.layout.place_of(index)
    }

    /// Fills the tile of every block of points, then sums the tiles and gives each node its sum.
    pub fn scatter(
        &mut self,
        fill: impl Fn(&PointBlock, &mut Tile) + Sync,
        take: impl Fn(&mut Node, [f64; 4]) + Sync,
    ) {
        self.tiles
            .par_iter_mut()
            .zip(&self.point_blocks)
            .for_each(|(tile, block)| {
                *tile = [[0.0; 4]; TILE_NODES];
                fill(block, tile);
            });
        let tiles = &self.tiles;
        self.nodes
            .par_chunks_mut(BLOCK_NODES)
            .zip(self.layout.sources())
            .for_each(|(nodes, sources)| {
                let sums = added_up(sources, tiles);
                for (node, sum) in nodes.iter_mut().zip(sums) {
                    take(node, sum);
                }
            });
    }

    /// A quantity of the nodes of a block of points, as a tile.
    pub fn tile_of(&self, block: &PointBlock, quantity: impl Fn(&Node) -> [f64; 4]) -> Tile {
        let mut tile = [[0.0; 4]; TILE_NODES];
        for (octant, reached) in OCTANTS.iter().zip(block.reach) {
            let nodes = &self.nodes[reached as usize * BLOCK_NODES..][..BLOCK_NODES];
            for_overlap(*octant, |in_tile, in_block| {
                tile[in_tile] = quantity(&nodes[in_block]);
            });
        }
        tile
    }

    /// The nodes of a stencil in one block of points, in the order (a, b, c).
    fn stencil_nodes(
        &self,
        block: &PointBlock,
        base: [i32; 3],
    ) -> impl Iterator<Item = (usize, usize, usize, &Node)> {
        let local = [0, 1, 2].map(|axis| (base[axis] - block.key[axis] * BLOCK as i32) as usize);
        let triples =
            (0..WIDTH * WIDTH * WIDTH).map(|n| (n / (WIDTH * WIDTH), n / WIDTH % WIDTH, n % WIDTH));
        triples.map(move |(a, b, c)| {
            let t = [local[0] + a, local[1] + b, local[2] + c];
            let (octant, node) = within(t);
            let place = block.reach[octant] as usize * BLOCK_NODES + node;
            (a, b, c, &self.nodes[place])
        })
    }

    /// Velocity [m/s] and displacement [m] of the grid at a point's transfer
    /// position: Σ w v_i and Σ w u_i.
    pub fn motion_at(&self, block: &PointBlock, stencil: &Stencil) -> (Vec3, Vec3) {
        let mut velocity = Vec3::zeros();
        let mut displacement = Vec3::zeros();
        for (a, b, c, node) in self.stencil_nodes(block, stencil.base) {
            let weight = stencil.weight[0][a] * stencil.weight[1][b] * stencil.weight[2][c];
            velocity += node.velocity * weight;
            displacement += node.displacement * weight;
        }
        (velocity, displacement)
    }

    /// Stencil at a point's transfer position: place and weight of each node.
    pub fn stencil_at(&self, block: &PointBlock, stencil: &Stencil) -> PointStencil {
        let local =
            [0, 1, 2].map(|axis| (stencil.base[axis] - block.key[axis] * BLOCK as i32) as usize);
        std::array::from_fn(|n| {
            let [a, b, c] = [n / (WIDTH * WIDTH), n / WIDTH % WIDTH, n % WIDTH];
            let (octant, node) = within([local[0] + a, local[1] + b, local[2] + c]);
            let place = block.reach[octant] * BLOCK_NODES as u32 + node as u32;
            let weight = stencil.weight[0][a] * stencil.weight[1][b] * stencil.weight[2][c];
            (place, weight)
        })
    }

    /// v ← v + Δt (f/m + g) at every node with mass.
    pub fn advance_momentum(&mut self, gravity: Vec3, dt: f64) {
        self.nodes.par_chunks_mut(BLOCK_NODES).for_each(|nodes| {
            for node in nodes.iter_mut().filter(|node| node.mass > 0.0) {
                node.velocity += (node.force / node.mass + gravity) * dt;
            }
        });
    }

    /// u ← u + Δt v at every node.
    pub fn displace(&mut self, dt: f64) {
        self.nodes.par_chunks_mut(BLOCK_NODES).for_each(|nodes| {
            for node in nodes {
                node.displacement += node.velocity * dt;
            }
        });
    }
}

/// Runs over the nodes that a tile shares with the block in one octant of it,
/// as (place in the tile, place in the block).
fn for_overlap(octant: [usize; 3], mut visit: impl FnMut(usize, usize)) {
    let extent = octant.map(|high| if high == 0 { BLOCK } else { TILE - BLOCK });
    let start = octant.map(|high| high * BLOCK);
    for a in 0..extent[0] {
        for b in 0..extent[1] {
            for c in 0..extent[2] {
                visit(
                    in_tile(start[0] + a, start[1] + b, start[2] + c),
                    in_block(a, b, c),
                );
            }
        }
    }
}

fn added_up(sources: &[u32; 8], tiles: &[Tile]) -> [[f64; 4]; BLOCK_NODES] {
    let mut sums = [[0.0; 4]; BLOCK_NODES];
    for (octant, source) in OCTANTS.iter().zip(sources) {
        let Some(source) = there(*source) else {
            continue;
        };
        let tile = &tiles[source];
        for_overlap(*octant, |in_tile, in_block| {
            for (sum, part) in sums[in_block].iter_mut().zip(tile[in_tile]) {
                *sum += part;
            }
        });
    }
    sums
}

#[cfg(test)]
mod tests;
