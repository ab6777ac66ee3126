//! Order of the chunks in memory.
//!
//! A pass visits block after block. With chunks in that order in memory the processor has the next
//! ones ready when they are needed; at 200,000 points, in no order, the same pass takes more than
//! twice as long (docs/performance.md). Blocks hand chunks to each other as the flow moves, so the
//! order is restored from time to time. No number of a point depends on it.

use super::Blocks;
use crate::mpm::chunk::Chunk;
use crate::mpm::lanes::Real;

/// Chunks are put in order when more than one in so many has changed its block.
const SCATTERED: usize = 4;

impl<R: Real> Blocks<R> {
    /// Puts the chunks in order if too many have changed their blocks.
    pub(super) fn keep_memory_order(&mut self) {
        let chunks: usize = self.occupied.iter().map(|block| block.chunks.len()).sum();
        if self.pool.taken > chunks / SCATTERED {
            self.order_in_memory();
        }
    }

    /// Puts the chunks in order.
    pub(super) fn order_in_memory(&mut self) {
        self.pool.taken = 0;
        let mut chunks: Vec<Box<Chunk<R>>> = Vec::new();
        for block in &mut self.occupied {
            chunks.append(&mut block.chunks);
        }
        order_by_address(&mut chunks);
        let mut chunks = chunks.into_iter();
        for block in &mut self.occupied {
            let used = block.len.div_ceil(R::LANES);
            block.chunks.extend(chunks.by_ref().take(used));
        }
    }
}

/// Orders allocations by address, while their contents keep their places.
fn order_by_address<T>(list: &mut [Box<T>]) {
    let address = |place: usize| std::ptr::from_ref(&*list[place]).addr();
    let mut by_address: Vec<usize> = (0..list.len()).collect();
    by_address.sort_unstable_by_key(|place| address(*place));
    let mut rank = vec![0; list.len()];
    for (place, of) in by_address.iter().enumerate() {
        rank[*of] = place;
    }
    for place in 0..list.len() {
        while rank[place] != place {
            let home = rank[place];
            let (low, high) = list.split_at_mut(place.max(home));
            let (one, other) = (&mut low[place.min(home)], &mut high[0]);
            std::mem::swap(one, other);
            std::mem::swap(&mut **one, &mut **other);
            rank.swap(place, home);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn allocations_are_ordered_and_contents_keep_their_places() {
        let mut list: Vec<Box<u64>> = (0..100).map(Box::new).collect();
        // Out of order in memory: every seventh comes next.
        let mut shuffled = Vec::new();
        for start in 0..7 {
            shuffled.extend((start..100).step_by(7));
        }
        let mut boxes: Vec<Option<Box<u64>>> = list.drain(..).map(Some).collect();
        let mut list: Vec<Box<u64>> = shuffled
            .iter()
            .filter_map(|place| boxes[*place].take())
            .collect();
        let contents: Vec<u64> = list.iter().map(|content| **content).collect();
        order_by_address(&mut list);
        assert!(list.is_sorted_by_key(|content| std::ptr::from_ref(&**content).addr()));
        assert!(list.iter().map(|content| **content).eq(contents));
    }
}
