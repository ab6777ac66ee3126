//! Nodes as plain numbers, for tests of walls and contacts.

use super::layout::Layout;
use super::{BLOCK_NODES, BlockKey, block_of, index_of};
use crate::kernel::Lattice;
use crate::math::{Sym3, Vec3};

/// One node.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Node {
    /// Mass [kg].
    pub mass: f64,
    /// Velocity [m/s].
    pub velocity: Vec3,
    /// Displacement since the transfer [m].
    pub displacement: Vec3,
    /// Nodal volume fraction.
    pub volume_fraction: f64,
    /// Mean compressive volumetric strain.
    pub compressive_strain: f64,
    /// Mean strain rate [1/s].
    pub strain_rate: Sym3,
}

/// A grid of such nodes.
#[derive(Debug)]
pub struct PlainGrid {
    /// Lattice of the nodes.
    pub lattice: Lattice,
    /// Blocks of the nodes.
    pub layout: Layout,
    /// Nodes, block by block.
    pub nodes: Vec<Node>,
}

impl PlainGrid {
    /// A grid of empty nodes around the blocks of these lowest nodes.
    pub fn around(lattice: Lattice, lowest: impl Iterator<Item = [i32; 3]>) -> Self {
        let mut keys: Vec<BlockKey> = lowest.map(block_of).collect();
        keys.sort_unstable();
        keys.dedup();
        let mut layout = Layout::default();
        layout.lay_around(keys.into_iter());
        let count = layout.node_blocks().len() * BLOCK_NODES;
        Self {
            lattice,
            layout,
            nodes: vec![Node::default(); count],
        }
    }

    /// Index (i, j, k) of the node at a place.
    pub fn index_of(&self, place: usize) -> [i32; 3] {
        let key = self.layout.node_blocks()[place / BLOCK_NODES];
        index_of(key, place % BLOCK_NODES)
    }

    /// The node of an index, whose block is there.
    pub fn node(&mut self, index: [i32; 3]) -> &mut Node {
        let place = self.layout.place_of(index).expect("its block is there");
        &mut self.nodes[place]
    }
}
