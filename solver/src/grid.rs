//! Numbering of the background grid: nodes in blocks of 4³, only where points are.
//!
//! The points of a block scatter into a tile of 6³ nodes of their own; the
//! tiles are then added to the nodes in a fixed order. So the work runs in
//! parallel without locks and gives the same bits for any number of threads.

use crate::kernel::WIDTH;
use std::ops::Range;

pub mod layout;

/// Cells along a block's edge.
pub const BLOCK: usize = 4;
/// Positions that the points of a block have within a step [cells from its first node]: they start
/// half a cell beyond it, and go one cell at most.
pub const POSITIONS_IN_STEP: Range<f64> = -0.5..BLOCK as f64 + 1.5;
/// Nodes of a block.
pub const BLOCK_NODES: usize = BLOCK * BLOCK * BLOCK;
/// Nodes along a tile's edge: a block's cells and the kernel's reach.
pub const TILE: usize = BLOCK + WIDTH - 1;
/// Nodes of a tile.
pub const TILE_NODES: usize = TILE * TILE * TILE;

/// Index of a block along x, y, z.
pub type BlockKey = [i32; 3];

/// The block of a lowest node index, see [`crate::kernel::Lattice::base`].
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

/// Number of blocks' values in a list for one more of room when it grows: doubled, it would hold far
/// more than it ever needs.
const ROOM: usize = 16;

/// Resizes a list with one value of each block.
pub fn resize_list<T: Clone>(list: &mut Vec<T>, count: usize, value: T) {
    if count > list.capacity() {
        list.reserve_exact(count + count / ROOM - list.len());
    }
    list.resize(count, value);
}

/// Index (i, j, k) of the first node of a block.
#[inline]
pub fn first_node(key: BlockKey) -> [i32; 3] {
    key.map(|along| along * BLOCK as i32)
}

/// Node index (i, j, k) of node `local` of a block.
#[inline]
pub fn index_of(key: BlockKey, local: usize) -> [i32; 3] {
    let first = first_node(key);
    let along = [
        local / (BLOCK * BLOCK),
        local / BLOCK % BLOCK,
        local % BLOCK,
    ];
    [0, 1, 2].map(|axis| first[axis] + along[axis] as i32)
}

#[cfg(test)]
pub mod fixture;
#[cfg(test)]
mod tests;
