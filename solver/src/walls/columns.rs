//! Columns of nodes through the bed, with linear extrapolation of velocity behind it.
//!
//! A column is a row of nodes along the axis closest to the bed's normal. With a and b its
//! first two nodes in the channel, a node t node distances behind a moves with v_a + t (v_a −
//! v_b), and the bed acts on the velocity at its own position (docs/method.md, equations
//! 29–29c). The motion near the bed is therefore linear; nodes constrained one by one would let
//! it slip.

use super::Walls;
use super::boundary::{Boundary, ConstraintSet, ConstraintSets};
use super::constraint::{ConstrainedVelocity, constrain_to};
use super::vertical_walls::Meets;
use crate::bed::{BedAtNode, Surface, Way};
use crate::kernel::Lattice;
use crate::math::Vec3;
use rayon::prelude::*;
use std::ops::Range;

/// Spread of a column's masses along it [node distances²] below which they do not determine the
/// gradient of velocity.
const LEAST_SPREAD: f64 = 1e-6;
/// Columns per task.
const TASK: usize = 64;

/// A node's place in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ColumnNode {
    way: Way,
    /// The column's index along the other two axes.
    across: [i32; 2],
    /// Nodes behind the first in the channel; −1 for the second.
    depth: i32,
    set: u32,
}

impl ColumnNode {
    /// The same where its set follows so many others.
    pub(super) fn after(self, sets: u32) -> Self {
        Self {
            set: self.set + sets,
            ..self
        }
    }
}

/// A boundary column and its resistance.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct BoundaryColumn {
    column_nodes: Range<usize>,
    /// The bed at its intersection.
    surface: Surface,
    /// Inverse of the mass matrix of a and b [1/kg]: aa, ab, bb.
    mobility: [f64; 3],
    /// Shares of a and b in the velocity at the bed.
    at_base: [f64; 2],
}

/// Share of the first and the second node in the velocity of the node at `depth` behind.
fn shares(depth: f64) -> [f64; 2] {
    [1.0 + depth, -depth]
}

impl BoundaryColumn {
    /// The column of these column nodes, on a surface `gap` node distances behind the first node;
    /// `None` if nodes with mass are too few or a vertical wall holds one of them in its direction.
    fn new(
        all: &[ColumnNode],
        column_nodes: Range<usize>,
        sets: &[ConstraintSet],
        surface: Surface,
        gap: f64,
    ) -> Option<Self> {
        let set = |column_node: &ColumnNode| &sets[column_node.set as usize];
        let ColumnNode { way, .. } = all[column_nodes.start];
        let held = |column_node: &ColumnNode| matches!(set(column_node).back, Meets::On { .. });
        if way == Way::Horizontal && all[column_nodes.clone()].iter().any(held) {
            return None;
        }
        let (mut mass, mut first, mut second) = (0.0, 0.0, 0.0);
        for column_node in &all[column_nodes.clone()] {
            let (of, depth) = (set(column_node).mass, f64::from(column_node.depth));
            mass += of;
            first += of * depth;
            second += of * depth * depth;
        }
        let spread = second / mass - (first / mass).powi(2);
        if spread.is_nan() || spread < LEAST_SPREAD {
            return None;
        }
        // Σ m s sᵀ with the shares s = (1 + t, −t).
        let (aa, ab, bb) = (mass + 2.0 * first + second, -(first + second), second);
        let determinant = mass * mass * spread;
        Some(Self {
            column_nodes,
            surface,
            mobility: [bb, -ab, aa].map(|of| of / determinant),
            at_base: shares(gap),
        })
    }

    fn moved_by(&self, push: [Vec3; 2]) -> [Vec3; 2] {
        let [aa, ab, bb] = self.mobility;
        [push[0] * aa + push[1] * ab, push[0] * ab + push[1] * bb]
    }

    /// Velocities of its first two nodes that have the momentum of all nodes.
    fn fitted(
        &self,
        column_nodes: &[ColumnNode],
        sets: &[ConstraintSet],
        constrained: &[ConstrainedVelocity],
    ) -> [Vec3; 2] {
        let mut momentum = [Vec3::zeros(); 2];
        for column_node in column_nodes {
            let set = column_node.set as usize;
            let of = constrained[set].velocity * sets[set].mass;
            let shares = shares(f64::from(column_node.depth));
            for (sum, share) in momentum.iter_mut().zip(shares) {
                *sum += of * share;
            }
        }
        self.moved_by(momentum)
    }

    /// Their velocities after the constraint at the bed: no inflow, and friction there.
    fn stopped(&self, ends: [Vec3; 2]) -> [Vec3; 2] {
        let [a, b] = self.at_base;
        let arriving = ends[0] * a + ends[1] * b;
        let mut left = arriving;
        constrain_to(&self.surface, &mut left);
        if left == arriving {
            return ends;
        }
        // An impulse at the bed moves both, and the velocity there by the sum.
        let [one, other] = self.moved_by([Vec3::repeat(a), Vec3::repeat(b)]);
        let change = (left - arriving) / (a * one.x + b * other.x);
        [ends[0] + change * one.x, ends[1] + change * other.x]
    }
}

impl Walls {
    /// The columns that contain a node, in the channel at their ends or behind.
    pub(super) fn column_nodes_of(
        index: [i32; 3],
        set: u32,
        bed: &BedAtNode,
    ) -> impl Iterator<Item = ColumnNode> {
        let is_below_floor = bed.vertical.is_some_and(|floor| index[2] < floor.first);
        bed.intersections().filter_map(move |(way, intersection)| {
            let across = match way {
                Way::Horizontal => [index[1], index[2]],
                Way::Vertical => [index[0], index[1]],
            };
            let depth = intersection.first - index[way.axis()];
            let here = way == Way::Vertical || !is_below_floor;
            ((-1..=intersection.deepest).contains(&depth) && here).then_some(ColumnNode {
                way,
                across,
                depth,
                set,
            })
        })
    }

    /// Makes columns of the column nodes.
    pub(super) fn make_columns(&self, boundary: &mut Boundary, lattice: &Lattice) {
        let Boundary {
            sets,
            columns,
            possible,
            made,
            ..
        } = boundary;
        sets.column_nodes.par_sort_unstable();
        let alike = |one: &ColumnNode, other: &ColumnNode| {
            (one.way, one.across) == (other.way, other.across)
        };
        possible.clear();
        let mut start = 0;
        for of_column in sets.column_nodes.chunk_by(alike) {
            possible.push(start..start + of_column.len());
            start += of_column.len();
        }
        let known = &*sets;
        possible
            .par_iter()
            .with_min_len(TASK)
            .map(|nodes| self.column(known, nodes.clone(), lattice))
            .collect_into_vec(made);
        columns.clear();
        columns.extend(made.drain(..).flatten());
        for column in &*columns {
            for place in column.column_nodes.clone() {
                sets.put_into_column(sets.column_nodes[place].set);
            }
        }
    }

    /// The column of these nodes, if they make one.
    fn column(
        &self,
        sets: &ConstraintSets,
        nodes: Range<usize>,
        lattice: &Lattice,
    ) -> Option<BoundaryColumn> {
        let ColumnNode { way, across, .. } = sets.column_nodes[nodes.start];
        let gap = self.bed.intersection(way, across, lattice)?.gap;
        let surface = self.bed.surface_in(way, across, lattice)?;
        BoundaryColumn::new(&sets.column_nodes, nodes, &sets.sets, surface, gap)
    }

    /// Sets the velocities of the nodes of every column by linear extrapolation, with the
    /// constraint at the bed if it `acts`.
    pub(super) fn line_up(&self, boundary: &mut Boundary, acts: bool) {
        let Boundary {
            sets: ConstraintSets {
                sets, column_nodes, ..
            },
            columns,
            constrained,
            ends,
            ..
        } = boundary;
        // A node can belong to a horizontal and a vertical column.
        let way = |column: &BoundaryColumn| column_nodes[column.column_nodes.start].way;
        for alike in columns.chunk_by(|a, b| way(a) == way(b)) {
            alike
                .par_iter()
                .with_min_len(TASK)
                .map(|column| {
                    let ends = column.fitted(
                        &column_nodes[column.column_nodes.clone()],
                        sets,
                        constrained,
                    );
                    if acts { column.stopped(ends) } else { ends }
                })
                .collect_into_vec(ends);
            for (column, [a, b]) in alike.iter().zip(ends.iter()) {
                for column_node in &column_nodes[column.column_nodes.clone()] {
                    let shares = shares(f64::from(column_node.depth));
                    let mut velocity = a * shares[0] + b * shares[1];
                    sets[column_node.set as usize].keep_out_of_walls(&mut velocity);
                    constrained[column_node.set as usize].velocity = velocity;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
