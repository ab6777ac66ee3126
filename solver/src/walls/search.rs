//! Search for the nodes on which walls act.

use super::Walls;
use super::boundary::{Boundary, ConstraintSets, Member};
use super::constraint::ConstrainedVelocity;
use super::nodes::NodeAccess;
use super::vertical_walls::Meets;
use crate::grid::{BLOCK, BLOCK_NODES, first_node};
use crate::kernel::{Lattice, REACH};
use rayon::prelude::*;

/// Blocks of nodes per task.
const TASK: usize = 16;
/// Node distances within which the bed acts on a node: on the second one above it, or by a kernel
/// that it cuts.
const BED_REACH: f64 = 2.0;

impl Walls {
    /// Finds the nodes on which walls act.
    pub fn find_boundary(&self, nodes: &impl NodeAccess, boundary: &mut Boundary) {
        let blocks = nodes.blocks();
        boundary
            .found
            .resize_with(blocks.len().div_ceil(TASK), ConstraintSets::default);
        boundary
            .found
            .par_iter_mut()
            .zip(blocks.par_chunks(TASK))
            .enumerate()
            .for_each(|(task, (found, blocks))| {
                found.clear();
                for (place, key) in blocks.iter().enumerate() {
                    if self.may_act_in(nodes.lattice(), *key) {
                        self.search_block(nodes, TASK * task + place, found);
                    }
                }
            });
        boundary.sets.clear();
        for found in &boundary.found {
            boundary.sets.append(found);
        }
        self.make_columns(boundary, nodes.lattice());
        boundary.sets.find_surfaces(&*self.bed, nodes);
        boundary
            .constrained
            .resize(boundary.sets.sets.len(), ConstrainedVelocity::default());
    }

    /// True if walls may act on a node of a block.
    fn may_act_in(&self, lattice: &Lattice, block: [i32; 3]) -> bool {
        let first = first_node(block);
        let last = first.map(|along| along + BLOCK as i32 - 1);
        let vertical_walls = (self.vertical_walls.as_ref())
            .is_some_and(|vertical_walls| vertical_walls.may_act_between(first, last));
        // The kernel's reach along a diagonal.
        let margin = REACH * lattice.spacing.norm();
        vertical_walls || self.bed.is_near_block(block, lattice, margin)
    }

    fn search_block(&self, nodes: &impl NodeAccess, block: usize, found: &mut ConstraintSets) {
        let margin = BED_REACH * nodes.lattice().spacing.max();
        for local in 0..BLOCK_NODES {
            let place = block * BLOCK_NODES + local;
            let index = nodes.index(place);
            let vertical_walls = self.vertical_walls.as_ref();
            let images = vertical_walls.is_some_and(|walls| walls.has_images(index));
            // An empty node counts if its images may not be empty.
            if nodes.mass(place) <= 0.0 && !images {
                continue;
            }
            let meets = vertical_walls.map_or([Meets::Not; 2], |walls| walls.meets(index));
            let is_master = vertical_walls.is_none_or(|walls| walls.master(index, nodes) == index);
            let near_bed = || self.bed.is_near_node(index, nodes.lattice(), margin);
            let acts = images || meets != [Meets::Not; 2] || near_bed();
            if acts && is_master {
                self.add_set(nodes, place, index, meets, found);
            }
        }
    }

    fn add_set(
        &self,
        nodes: &impl NodeAccess,
        place: usize,
        index: [i32; 3],
        meets: [Meets; 2],
        found: &mut ConstraintSets,
    ) {
        let start = found.members.len();
        found.members.push(Member {
            place: place as u32,
            sign: [1, 1],
        });
        if let Some(vertical_walls) = &self.vertical_walls {
            vertical_walls.for_each_image(index, |image, sign| match nodes.place_of(image) {
                Some(place) if nodes.mass(place) > 0.0 => found.members.push(Member {
                    place: place as u32,
                    sign,
                }),
                _ => {}
            });
        }
        let bed = self.bed.at_node(index, nodes.lattice());
        let alone = found.members.len() == start + 1;
        let set = found.sets.len() as u32;
        let known = found.column_nodes.len();
        found
            .column_nodes
            .extend(Self::column_nodes_of(index, set, &bed));
        let of_column = found.column_nodes.len() > known;
        let free = meets == [Meets::Not; 2] && !bed.covers && !of_column;
        let plain = alone && free;
        let empty = alone && nodes.mass(place) <= 0.0;
        if plain || empty {
            found.members.truncate(start);
            found.column_nodes.truncate(known);
        }
        if plain && bed.share_above < 1.0 {
            found.cut.push((place as u32, bed.share_above));
        }
        if plain || empty {
            return;
        }
        let of_member = |member: &Member| nodes.mass(member.place as usize);
        let mass = found.members[start..].iter().map(of_member).sum();
        found.push(start, meets, &bed, mass);
    }
}
