//! Points of one block, sorted by cell, and the block that a position lies in.

use super::migration::Leaving;
use crate::grid::{BLOCK, BlockKey};
use crate::mpm::chunk::{Chunk, Packed, put, take};
use crate::mpm::lanes::{MOST_LANES, Real};
use crate::mpm::prefetch::prefetch;
use crate::mpm::redistribution::Shifting;
use serde::{Deserialize, Serialize};

/// Cells of a block.
const CELLS: usize = BLOCK * BLOCK * BLOCK;
/// A block is re-sorted once its number of runs of points in the same cell exceeds that after
/// the last sort by more than one in so many of its points.
const DISORDER: u32 = 8;

/// Largest distance of a point from the origin, in blocks, so that the indices of its nodes
/// stay whole numbers: far outside of every channel.
const FARTHEST: i32 = i32::MAX / (4 * BLOCK as i32);

/// Summary of a block's points since they were last moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End<R> {
    /// Speed of the fastest [m/s].
    pub fastest: R,
    /// True if every number is a number.
    pub finite: bool,
    /// V ρ_c/m − 1 of the densest, at most 0.
    pub lowest_dilation: R,
    /// True if one may have left the block.
    pub left: bool,
}

impl<R: Real> Default for End<R> {
    fn default() -> Self {
        Self {
            fastest: R::ZERO,
            finite: true,
            lowest_dilation: R::ZERO,
            left: false,
        }
    }
}

/// The points of one block.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Block<R: Real> {
    /// Which block.
    pub key: BlockKey,
    pub(super) chunks: Vec<Box<Chunk<R>>>,
    pub(super) len: usize,
    /// Runs of points in the same cell, as of the last transfer and as of the
    /// last sort.
    pub(super) runs: u32,
    pub(super) sorted_runs: u32,
    /// Summary from the last pass.
    #[serde(skip)]
    pub(super) end: End<R>,
    #[serde(skip)]
    spread: Shifting,
}

impl<R: Real> Block<R> {
    /// Points in it.
    pub fn count(&self) -> usize {
        self.len
    }

    /// Its chunks, each with the number of its points.
    pub fn chunks(&self) -> impl Iterator<Item = (&Chunk<R>, usize)> {
        let len = self.len;
        let used = len.div_ceil(R::LANES);
        self.chunks[..used]
            .iter()
            .enumerate()
            .map(move |(place, chunk)| (&**chunk, (len - place * R::LANES).min(R::LANES)))
    }

    /// Its chunks, each with the number of its points.
    #[inline(always)]
    pub fn chunks_mut(&mut self) -> impl Iterator<Item = (&mut Chunk<R>, usize)> {
        let mut left = self.len;
        let mut chunks = self.chunks[..left.div_ceil(R::LANES)].iter_mut();
        std::iter::from_fn(move || {
            let chunk = chunks.next()?;
            if let Some(next) = chunks.as_slice().first() {
                prefetch(&**next);
            }
            let count = left.min(R::LANES);
            left -= count;
            Some((&mut **chunk, count))
        })
    }

    /// Asks for its first chunk, which is going to be needed.
    #[inline(always)]
    pub fn prefetch(&self) {
        if let Some(first) = self.chunks.first() {
            prefetch(&**first);
        }
    }

    /// One of its points.
    pub fn get(&self, slot: usize) -> Packed<R> {
        self.chunks[slot / R::LANES].get(slot % R::LANES)
    }

    /// Changes one of its points.
    pub fn set(&mut self, slot: usize, point: &Packed<R>) {
        self.chunks[slot / R::LANES].set(slot % R::LANES, point);
    }

    /// Position of one of its points [cells].
    pub fn position(&self, slot: usize) -> [R; 3] {
        take::<R, 3>(&self.chunks[slot / R::LANES].position, slot % R::LANES)
    }

    /// Velocity of one of its points [m/s].
    pub fn velocity(&self, slot: usize) -> [R; 3] {
        take::<R, 3>(&self.chunks[slot / R::LANES].velocity, slot % R::LANES)
    }

    /// Mass of one of its points [kg].
    pub fn mass(&self, slot: usize) -> R {
        self.chunks[slot / R::LANES].mass[slot % R::LANES]
    }

    /// Gives one of its points another position [cells], which may lie in
    /// another block until [`super::Blocks::settle`].
    pub fn shift(&mut self, slot: usize, position: &[R; 3]) {
        put::<R, 3>(
            &mut self.chunks[slot / R::LANES].position,
            slot % R::LANES,
            position,
        );
        self.end.left = true;
    }

    /// Knowledge of its points since they were last moved.
    pub fn end(&self) -> End<R> {
        self.end
    }

    /// Notes what a pass found of its points.
    pub fn note_end(&mut self, end: End<R>, spread: Shifting) {
        (self.end, self.spread) = (end, spread);
    }

    /// Changes of its points' sums by particle shifting.
    pub fn spread(&self) -> Shifting {
        self.spread
    }

    /// Stores the number of runs of points in the same cell from a pass.
    pub fn note_runs(&mut self, runs: u32) {
        self.runs = runs;
    }

    /// Makes room for so many points more.
    pub(super) fn reserve(&mut self, count: usize, pool: &mut Pool<R>) {
        let chunks = (self.len + count).div_ceil(R::LANES);
        while self.chunks.len() < chunks {
            self.chunks.push(pool.take());
        }
    }

    /// Takes a point in, for which there is room.
    pub(super) fn push(&mut self, point: &Packed<R>) {
        self.len += 1;
        self.set(self.len - 1, point);
    }

    /// Takes a point out, whose place the last one takes.
    pub(super) fn swap_remove(&mut self, slot: usize) {
        let last = self.len - 1;
        let moved = self.get(last);
        self.set(slot, &moved);
        self.set(last, &Packed::none());
        self.len = last;
    }

    /// Returns the chunks without points to the pool.
    pub(super) fn trim(&mut self, pool: &mut Pool<R>) {
        let used = self.len.div_ceil(R::LANES);
        pool.chunks.extend(self.chunks.drain(used..));
    }

    fn swap(&mut self, one: usize, other: usize) {
        let (a, b) = (self.get(one), self.get(other));
        self.set(one, &b);
        self.set(other, &a);
    }

    /// Takes out what has left the block.
    pub(super) fn send_off(&mut self, leaving: &mut Vec<Leaving<R>>) {
        if !self.end.left {
            return;
        }
        self.end.left = false;
        let mut place = 0;
        while place * R::LANES < self.len {
            let Some(lane) = unsettled(&self.chunks[place]) else {
                place += 1;
                continue;
            };
            let slot = place * R::LANES + lane;
            let mut point = self.get(slot);
            let to = settle(&self.key, &mut point.position);
            leaving.push(Leaving { to, point });
            // The last point comes here, and is checked in turn.
            self.swap_remove(slot);
        }
    }

    /// Re-sorts the points by cell if there is too much disorder.
    pub(super) fn tidy(&mut self) {
        let most = self.sorted_runs + self.len as u32 / DISORDER;
        if self.runs <= most {
            return;
        }
        let mut counts = [0u16; CELLS];
        for (chunk, count) in self.chunks() {
            for lane in 0..count {
                counts[cell_of(chunk, lane)] += 1;
            }
        }
        self.sort(&counts);
        self.sorted_runs = counts.iter().filter(|count| **count > 0).count() as u32;
        self.runs = self.sorted_runs;
    }

    /// Swaps every point into the range of its cell. Few swaps where few points changed cell; the
    /// order within a cell is irrelevant, but depends on the state alone.
    fn sort(&mut self, counts: &[u16; CELLS]) {
        let mut next = [0usize; CELLS];
        let mut end = [0usize; CELLS];
        let mut sum = 0;
        for place in 0..CELLS {
            next[place] = sum;
            sum += usize::from(counts[place]);
            end[place] = sum;
        }
        for place in 0..CELLS {
            while next[place] < end[place] {
                let slot = next[place];
                let home = cell_of(&self.chunks[slot / R::LANES], slot % R::LANES);
                if home != place {
                    self.swap(slot, next[home]);
                }
                next[home] += 1;
            }
        }
    }
}

/// Lane of a point that has left its block, if there is one.
fn unsettled<R: Real>(chunk: &Chunk<R>) -> Option<usize> {
    let mut settled = [true; MOST_LANES];
    for of in &chunk.position {
        for lane in 0..R::LANES {
            settled[lane] &= is_settled(of[lane]);
        }
    }
    settled.iter().position(|settled| !settled)
}

/// Chunks without points, kept for blocks that will need them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Pool<R: Real> {
    pub(super) chunks: Vec<Box<Chunk<R>>>,
    /// Chunks taken since they were last put in order.
    pub(super) taken: usize,
}

impl<R: Real> Pool<R> {
    fn take(&mut self) -> Box<Chunk<R>> {
        self.taken += 1;
        self.chunks
            .pop()
            .unwrap_or_else(|| Box::new(Chunk::empty()))
    }
}

/// True if a coordinate belongs to the block [cells].
pub fn is_settled<R: Real>(x: R) -> bool {
    x >= R::of(0.5) && x < R::of(BLOCK as f64 + 0.5)
}

/// Place of a settled point's cell.
pub(super) fn cell_of<R: Real>(chunk: &Chunk<R>, lane: usize) -> usize {
    // A position that is not a number is in the first cell.
    let along = |axis: usize| {
        let cells = chunk.position[axis][lane] - R::of(0.5);
        (cells.to_f64() as usize).min(BLOCK - 1)
    };
    (along(0) * BLOCK + along(1)) * BLOCK + along(2)
}

/// Brings a position relative to `key`'s block into the block it lies in, which
/// is returned. A position that is not a number stays where it is.
pub fn settle<R: Real>(key: &BlockKey, position: &mut [R; 3]) -> BlockKey {
    let (half, size) = (R::of(0.5), R::of(BLOCK as f64));
    let rim = size + half;
    let mut settled = *key;
    for (along, x) in settled.iter_mut().zip(position) {
        if !x.is_finite() {
            continue;
        }
        let blocks = ((*x - half) / size).floor();
        *along = along
            .saturating_add(blocks.to_f64() as i32)
            .clamp(-FARTHEST, FARTHEST);
        *x -= blocks * size;
        // Rounding may have pushed it over a rim.
        if *x < half {
            *along = along.saturating_sub(1);
            *x += size;
            if *x >= rim {
                *x = rim.below();
            }
        } else if *x >= rim {
            *along = along.saturating_add(1);
            *x -= size;
        }
    }
    settled
}
