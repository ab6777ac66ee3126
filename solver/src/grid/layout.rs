//! Layout of the blocks of nodes, and the blocks of points whose tiles overlap them.

use super::{BLOCK, BLOCK_NODES, BlockKey, block_of, in_block};

/// Index of a missing block.
const NONE: u32 = u32::MAX;
/// The eight blocks that a tile overlaps, in the order in which tiles are added.
pub const OCTANTS: [[usize; 3]; 8] = [
    [0, 0, 0],
    [0, 0, 1],
    [0, 1, 0],
    [0, 1, 1],
    [1, 0, 0],
    [1, 0, 1],
    [1, 1, 0],
    [1, 1, 1],
];

/// Blocks of nodes round blocks of points, both sorted.
#[derive(Debug, Default)]
pub struct Layout {
    /// Blocks of points, and the node blocks that their tiles overlap in the order of the octants.
    reach: Vec<(BlockKey, [u32; 8])>,
    node_blocks: Vec<BlockKey>,
    /// Per node block: the blocks of points whose tiles overlap it.
    sources: Vec<[u32; 8]>,
}

impl Layout {
    /// Lays blocks of nodes round these blocks of points, which are sorted.
    pub fn lay_around(&mut self, blocks: impl ExactSizeIterator<Item = BlockKey> + Clone) {
        let before = self.reach.iter().map(|block| block.0);
        if blocks.len() == before.len() && blocks.clone().eq(before) {
            return;
        }
        self.node_blocks.clear();
        for key in blocks.clone() {
            let around = OCTANTS.map(|octant| shifted(key, octant, 1));
            self.node_blocks.extend(around);
        }
        self.node_blocks.sort_unstable();
        self.node_blocks.dedup();
        let node_blocks = &self.node_blocks;
        self.reach.clear();
        self.reach.extend(blocks.map(|key| {
            let reached = OCTANTS.map(|octant| place(node_blocks, shifted(key, octant, 1), |k| *k));
            (key, reached)
        }));
        let reach = &self.reach;
        self.sources.clear();
        self.sources.extend(node_blocks.iter().map(|key| {
            OCTANTS.map(|octant| place(reach, shifted(*key, octant, -1), |block| block.0))
        }));
    }

    /// The blocks of nodes.
    pub fn node_blocks(&self) -> &[BlockKey] {
        &self.node_blocks
    }

    /// The node blocks that the tile of a block of points overlaps, in the order of the octants.
    pub fn reach(&self, block: usize) -> &[u32; 8] {
        &self.reach[block].1
    }

    /// Per node block, by octant: the blocks of points whose tiles overlap it; see [`there`].
    pub fn sources(&self) -> &[[u32; 8]] {
        &self.sources
    }

    /// Place of node (i, j, k), if its block is there.
    pub fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        let key = block_of(index);
        let block = there(place(&self.node_blocks, key, |k| *k))?;
        let local = [0, 1, 2].map(|axis| (index[axis] - key[axis] * BLOCK as i32) as usize);
        Some(block * BLOCK_NODES + in_block(local[0], local[1], local[2]))
    }

    /// Bytes allocated.
    pub fn bytes(&self) -> usize {
        self.reach.capacity() * size_of::<(BlockKey, [u32; 8])>()
            + self.node_blocks.capacity() * size_of::<BlockKey>()
            + self.sources.capacity() * size_of::<[u32; 8]>()
    }
}

/// A block's place among its kind, if there is such a block.
pub fn there(block: u32) -> Option<usize> {
    (block != NONE).then_some(block as usize)
}

/// Octant of a tile that contains a node, and the node's place in the block there.
pub fn within(local: [usize; 3]) -> (usize, usize) {
    let [a, b, c] = local.map(|along| along / BLOCK);
    let [i, j, k] = local.map(|along| along % BLOCK);
    (a * 4 + b * 2 + c, in_block(i, j, k))
}

fn shifted(key: BlockKey, octant: [usize; 3], sign: i32) -> BlockKey {
    [0, 1, 2].map(|axis| key[axis] + sign * octant[axis] as i32)
}

fn place<T>(sorted: &[T], key: BlockKey, key_of: impl Fn(&T) -> BlockKey) -> u32 {
    sorted
        .binary_search_by_key(&key, key_of)
        .map_or(NONE, |place| place as u32)
}
