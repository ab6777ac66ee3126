//! Migration of points between blocks.
//!
//! Blocks send off and take in side by side. Those that arrive in a block come in the order of the
//! blocks that they left, so that the bits do not depend on the number of threads.

use super::{Block, Blocks, End};
use crate::grid::BlockKey;
use crate::mpm::chunk::Packed;
use crate::mpm::lanes::Real;
use rayon::prelude::*;

/// Blocks that send their points off together.
const TASK: usize = 8;

/// A point that leaves its block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Leaving<R> {
    pub(super) to: BlockKey,
    pub(super) point: Packed<R>,
}

/// Points that leave some blocks, in the order of these.
#[derive(Debug, Clone, PartialEq, Default)]
struct Group<R: Real> {
    leaving: Vec<Leaving<R>>,
    /// Places of the blocks in which they arrive.
    to: Vec<u32>,
}

/// Place of a point among those that leave.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arrival {
    group: u32,
    place: u32,
}

/// Points between two blocks.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Migration<R: Real> {
    groups: Vec<Group<R>>,
    /// All that leave, block after block in which they arrive.
    arrivals: Vec<Arrival>,
    /// End of each block's arrivals.
    ends: Vec<usize>,
    /// Blocks to which the first points come.
    born: Vec<BlockKey>,
}

impl<R: Real> Migration<R> {
    /// Bytes allocated.
    pub(super) fn bytes(&self) -> usize {
        let leaving = self.groups.iter().map(|group| group.leaving.capacity());
        leaving.sum::<usize>() * (size_of::<Leaving<R>>() + size_of::<u32>())
            + self.arrivals.capacity() * size_of::<Arrival>()
            + self.ends.capacity() * size_of::<usize>()
    }
}

impl<R: Real> Blocks<R> {
    /// Takes points in from elsewhere; false if there are none.
    pub(super) fn take_in(&mut self, points: impl Iterator<Item = (BlockKey, Packed<R>)>) -> bool {
        self.migration.groups.resize_with(1, Group::default);
        let leaving = &mut self.migration.groups[0].leaving;
        leaving.extend(points.map(|(to, point)| Leaving { to, point }));
        let any = !leaving.is_empty();
        self.arrive();
        any
    }

    /// Moves the points that left their blocks to others.
    pub(super) fn migrate(&mut self) {
        let groups = &mut self.migration.groups;
        groups.resize_with(self.occupied.len().div_ceil(TASK), Group::default);
        self.occupied
            .par_chunks_mut(TASK)
            .zip(groups)
            .for_each(|(blocks, group)| {
                for block in blocks {
                    block.send_off(&mut group.leaving);
                }
            });
        self.arrive();
    }

    /// Puts the points that leave into their blocks.
    fn arrive(&mut self) {
        if !self.find_destinations() {
            self.bear();
            self.find_destinations();
        }
        self.list_arrivals();
        let Migration {
            groups,
            arrivals,
            ends,
            ..
        } = &self.migration;
        self.occupied
            .par_iter_mut()
            .enumerate()
            .for_each(|(place, block)| {
                let start = place.checked_sub(1).map_or(0, |before| ends[before]);
                for Arrival { group, place } in &arrivals[start..ends[place]] {
                    block.push(&groups[*group as usize].leaving[*place as usize].point);
                }
                block.tidy();
            });
        for group in &mut self.migration.groups {
            group.leaving.clear();
        }
        for block in &mut self.occupied {
            block.trim(&mut self.pool);
        }
        self.drop_empty();
    }

    /// Finds the blocks in which the points arrive; false if one of these is still to be made.
    fn find_destinations(&mut self) -> bool {
        let blocks = &self.occupied;
        let find = |leaving: &Leaving<R>| {
            let place = blocks.binary_search_by_key(&leaving.to, |block| block.key);
            place.map_or(NOWHERE, |place| place as u32)
        };
        self.migration
            .groups
            .par_iter_mut()
            .map(|group| {
                group.to.clear();
                group.to.extend(group.leaving.iter().map(find));
                !group.to.contains(&NOWHERE)
            })
            .reduce(|| true, |one, other| one && other)
    }

    /// Makes the blocks to which the first points come.
    fn bear(&mut self) {
        let Migration { groups, born, .. } = &mut self.migration;
        born.clear();
        for group in groups {
            let each = group.leaving.iter().zip(&group.to);
            let unknown = each.filter(|(_, to)| **to == NOWHERE);
            born.extend(unknown.map(|(leaving, _)| leaving.to));
        }
        born.sort_unstable();
        born.dedup();
        for key in &*born {
            let mut block: Block<R> = self.emptied.pop().unwrap_or_default();
            block.key = *key;
            block.end = End::default();
            (block.runs, block.sorted_runs) = (0, 0);
            self.occupied.push(block);
        }
        self.occupied.sort_unstable_by_key(|block| block.key);
    }

    /// Lists the arrivals of each block, and makes room for them.
    fn list_arrivals(&mut self) {
        let Migration {
            groups,
            arrivals,
            ends,
            ..
        } = &mut self.migration;
        ends.clear();
        ends.resize(self.occupied.len(), 0);
        for to in groups.iter().flat_map(|group| &group.to) {
            ends[*to as usize] += 1;
        }
        let mut start = 0;
        for (end, block) in ends.iter_mut().zip(&mut self.occupied) {
            block.reserve(*end, &mut self.pool);
            start += std::mem::replace(end, start);
        }
        let nowhere = Arrival { group: 0, place: 0 };
        arrivals.clear();
        arrivals.resize(start, nowhere);
        for (group, from) in (0..).zip(groups) {
            for (place, to) in (0..).zip(&from.to) {
                // Where the block's next one belongs: its end after the last.
                let end = &mut ends[*to as usize];
                arrivals[*end] = Arrival { group, place };
                *end += 1;
            }
        }
    }
}

/// Place of a block that is not there.
const NOWHERE: u32 = u32::MAX;
