//! Points in blocks of 4³ cells: each block keeps its own, sorted by cell.
//!
//! After a step a point that has left its block migrates to the next one, and a block with too
//! much disorder re-sorts its points.

use super::chunk::{Chunk, Packed};
use super::lanes::Real;
use crate::grid::BlockKey;
use serde::{Deserialize, Serialize};

mod block;
mod memory_order;
mod migration;

use block::Pool;
pub use block::{Block, End, is_settled, settle};
use migration::Migration;

/// All blocks with points, sorted by key.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Blocks<R: Real> {
    occupied: Vec<Block<R>>,
    #[serde(skip)]
    pool: Pool<R>,
    #[serde(skip)]
    emptied: Vec<Block<R>>,
    #[serde(skip)]
    migration: Migration<R>,
}

/// Points that arrive at once when blocks are made.
pub const ARRIVING: usize = 1 << 14;

impl<R: Real> Blocks<R> {
    /// Points, each with its block.
    pub fn of(mut points: impl Iterator<Item = (BlockKey, Packed<R>)>) -> Self {
        let mut blocks = Self::default();
        // Not all at once, which would be one more copy of them; their order is the same.
        while blocks.take_in(points.by_ref().take(ARRIVING)) {}
        blocks.migration = Migration::default();
        for block in &mut blocks.occupied {
            block.runs = u32::MAX;
            block.tidy();
        }
        blocks.order_in_memory();
        blocks
    }

    /// Adds points, each with its block.
    pub fn add(&mut self, mut points: impl Iterator<Item = (BlockKey, Packed<R>)>) {
        while self.take_in(points.by_ref().take(ARRIVING)) {}
        for block in &mut self.occupied {
            block.tidy();
        }
    }

    /// The blocks.
    pub fn occupied(&self) -> &[Block<R>] {
        &self.occupied
    }

    /// The blocks.
    pub fn occupied_mut(&mut self) -> &mut [Block<R>] {
        &mut self.occupied
    }

    /// Points in all blocks.
    pub fn count(&self) -> usize {
        self.occupied.iter().map(Block::count).sum()
    }

    /// Migrates the points that left their blocks to others, and re-sorts blocks where needed.
    pub fn settle(&mut self) {
        self.migrate();
        self.keep_memory_order();
    }

    /// Removes the points for which `gone` is true, in blocks for which `search` is true.
    pub fn take_out(
        &mut self,
        search: impl Fn(&BlockKey) -> bool,
        mut gone: impl FnMut(&BlockKey, &Packed<R>) -> bool,
    ) {
        for block in self.occupied.iter_mut().filter(|block| search(&block.key)) {
            let mut slot = 0;
            while slot < block.len {
                if gone(&block.key, &block.get(slot)) {
                    block.swap_remove(slot);
                } else {
                    slot += 1;
                }
            }
            block.trim(&mut self.pool);
        }
        self.drop_empty();
    }

    fn drop_empty(&mut self) {
        let mut place = 0;
        while place < self.occupied.len() {
            if self.occupied[place].len == 0 {
                self.emptied.push(self.occupied.remove(place));
            } else {
                place += 1;
            }
        }
    }

    /// Bytes allocated for points.
    pub fn bytes(&self) -> usize {
        let of_block = |block: &Block<R>| {
            block.chunks.len() * size_of::<Chunk<R>>()
                + block.chunks.capacity() * size_of::<Box<Chunk<R>>>()
                + size_of::<Block<R>>()
        };
        let pool = self.pool.chunks.len() * size_of::<Chunk<R>>();
        let kept = self.occupied.iter().chain(&self.emptied).map(of_block);
        kept.sum::<usize>() + pool + self.migration.bytes()
    }
}

#[cfg(test)]
mod tests;
