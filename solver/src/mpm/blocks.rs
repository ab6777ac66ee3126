//! Points in blocks of 4³ cells: each block keeps its own, sorted by cell.
//!
//! After a step a point that has left its block migrates to the next one, and a block with too
//! much disorder re-sorts its points.

use super::chunk::{Chunk, Packed};
use super::lanes::Real;
use crate::grid::BlockKey;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

mod block;
mod memory_order;

use block::Pool;
pub use block::{Block, End, settle};

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
    travelling: Vec<(BlockKey, Packed<R>)>,
    #[serde(skip)]
    born: Vec<BlockKey>,
}

/// Points that arrive at once when blocks are made.
pub const ARRIVING: usize = 1 << 16;

impl<R: Real> Blocks<R> {
    /// Points, each with its block.
    pub fn of(mut points: impl Iterator<Item = (BlockKey, Packed<R>)>) -> Self {
        let mut blocks = Self::default();
        // Not all at once, which would be one more copy of them; their order is the same.
        loop {
            blocks.travelling.extend(points.by_ref().take(ARRIVING));
            if blocks.travelling.is_empty() {
                break;
            }
            blocks.arrive();
        }
        blocks.travelling = Vec::new();
        for block in &mut blocks.occupied {
            block.runs = u32::MAX;
            block.tidy();
        }
        blocks.order_in_memory();
        blocks
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
        self.occupied
            .par_iter_mut()
            .for_each(Block::look_for_leaving);
        for block in self.occupied.iter_mut().filter(|block| block.left) {
            block.send_off(&mut self.travelling, &mut self.pool);
        }
        self.arrive();
        self.occupied.par_iter_mut().for_each(Block::tidy);
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
                    block.swap_remove(slot, &mut self.pool);
                } else {
                    slot += 1;
                }
            }
        }
        self.drop_empty();
    }

    /// Puts the migrating points into their blocks.
    fn arrive(&mut self) {
        self.born.clear();
        for (key, _) in &self.travelling {
            if self.find(key).is_err() {
                self.born.push(*key);
            }
        }
        self.born.sort_unstable();
        self.born.dedup();
        for key in &self.born {
            let mut block = self.emptied.pop().unwrap_or_default();
            block.key = *key;
            block.end = End::default();
            (block.runs, block.sorted_runs) = (0, 0);
            self.occupied.push(block);
        }
        if !self.born.is_empty() {
            self.occupied.sort_unstable_by_key(|block| block.key);
        }
        for place in 0..self.travelling.len() {
            let (key, point) = self.travelling[place];
            if let Ok(block) = self.find(&key) {
                self.occupied[block].push(&point, &mut self.pool);
            }
        }
        self.travelling.clear();
        self.drop_empty();
    }

    fn find(&self, key: &BlockKey) -> Result<usize, usize> {
        self.occupied.binary_search_by_key(key, |block| block.key)
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
        kept.sum::<usize>() + pool + self.travelling.capacity() * size_of::<(BlockKey, Packed<R>)>()
    }
}

#[cfg(test)]
mod tests;
