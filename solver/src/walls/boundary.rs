//! Nodes on which walls act, and their available volumes.

use super::Walls;
use super::columns::{BoundaryColumn, ColumnNode};
use super::constraint::ConstrainedVelocity;
use super::nodes::NodeAccess;
use super::vertical_walls::{Ends, Meets};
use crate::bed::Surface;
use crate::grid::{BLOCK, BLOCK_NODES};
use crate::kernel::{Lattice, REACH};
use crate::math::{Sym3, Vec3};
use crate::method::METHOD;
use std::ops::Range;

/// A node or one of its images: they move as one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Member {
    pub(super) place: u32,
    /// +1, or −1 where the image is mirrored, for x and y.
    pub(super) sign: [f64; 2],
    /// Position at the transfer [m].
    pub(super) resting: Vec3,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ConstraintSet {
    pub(super) members: Range<usize>,
    pub(super) back: Meets,
    pub(super) side: Meets,
    /// Their mass together [kg].
    pub(super) mass: f64,
    /// Surfaces of the bed that act on it alone: where it is on or below the bed, unless it belongs
    /// to a column.
    pub(super) surfaces: [Option<Surface>; 2],
    /// Share of the kernels above the bed.
    room: f64,
}

impl ConstraintSet {
    pub(super) fn is_at_vertical_wall(&self) -> bool {
        self.back != Meets::Not || self.side != Meets::Not
    }

    /// Stops a velocity into a wall on which the constraint set lies.
    pub(super) fn keep_out_of_walls(&self, velocity: &mut Vec3) {
        for (axis, meets) in [(0, self.back), (1, self.side)] {
            match meets {
                Meets::On { inward } if velocity[axis] * inward < 0.0 => velocity[axis] = 0.0,
                Meets::On { .. } | Meets::Near { .. } | Meets::Not => {}
            }
        }
    }
}

/// The nodes of one step on which walls act.
#[derive(Debug, Default)]
pub struct Boundary {
    pub(super) members: Vec<Member>,
    pub(super) sets: Vec<ConstraintSet>,
    /// Other nodes whose kernel the bed cuts: their places, and the share of it in the
    /// channel.
    cut: Vec<(u32, f64)>,
    /// Constraint sets near the bed, by columns.
    pub(super) column_nodes: Vec<ColumnNode>,
    pub(super) columns: Vec<BoundaryColumn>,
    /// Velocities of the first two nodes of each column of a kind.
    pub(super) ends: Vec<[Vec3; 2]>,
    /// Changes of each constraint set by a sub-step.
    pub(super) constrained: Vec<ConstrainedVelocity>,
}

/// Numbers of nodes on which walls act, by what is held for them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BoundaryCounts {
    /// Nodes, without images.
    pub nodes: f64,
    /// Images of nodes.
    pub images: f64,
    /// Columns through the bed.
    pub columns: f64,
    /// Nodes in those columns.
    pub column_nodes: f64,
}

impl BoundaryCounts {
    /// Bytes held for so many.
    pub fn bytes(&self) -> f64 {
        let of_node =
            size_of::<ConstraintSet>() + size_of::<ConstrainedVelocity>() + size_of::<Member>();
        let of_column = size_of::<BoundaryColumn>() + size_of::<[Vec3; 2]>();
        self.nodes * of_node as f64
            + self.images * size_of::<Member>() as f64
            + self.columns * of_column as f64
            + self.column_nodes * size_of::<ColumnNode>() as f64
    }
}

impl Boundary {
    /// Bytes allocated.
    pub fn bytes(&self) -> usize {
        self.members.capacity() * size_of::<Member>()
            + self.sets.capacity() * size_of::<ConstraintSet>()
            + self.cut.capacity() * size_of::<(u32, f64)>()
            + self.column_nodes.capacity() * size_of::<ColumnNode>()
            + self.columns.capacity() * size_of::<BoundaryColumn>()
            + self.ends.capacity() * size_of::<[Vec3; 2]>()
            + self.constrained.capacity() * size_of::<ConstrainedVelocity>()
    }

    /// Raises the volume fraction of nodes with less available volume at walls: the same volume of
    /// points fills more of it. A node and its images share it, and the mean compressive strain.
    pub fn exclude_volume(&self, nodes: &mut impl NodeAccess) {
        for (place, room) in &self.cut {
            let place = *place as usize;
            nodes.set_volume_fraction(place, filled(nodes.volume_fraction(place), *room));
        }
        for set in &self.sets {
            let members = &self.members[set.members.clone()];
            let of_member = |member: &Member| nodes.volume_fraction(member.place as usize);
            let inside = set.back.room() * set.side.room();
            let sum: f64 = members.iter().map(of_member).sum();
            let volume_fraction = filled(sum / inside, set.room);
            for member in members {
                nodes.set_volume_fraction(member.place as usize, volume_fraction);
            }
            smooth_compressive_strain(members, nodes);
        }
    }

    /// Places of the nodes of every constraint set that has ghost nodes.
    pub fn ghost_sets(&self) -> impl Iterator<Item = impl Iterator<Item = usize> + Clone> {
        self.sets
            .iter()
            .filter(|set| set.members.len() > 1)
            .map(|set| {
                let members = self.members[set.members.clone()].iter();
                members.map(|member| member.place as usize)
            })
    }

    /// Adds the strain rates of a node's images to its mean; on a wall, the mirror of itself.
    pub fn smooth_strain_rates(&self, nodes: &mut impl NodeAccess) {
        let mirrors = |set: &&ConstraintSet| set.is_at_vertical_wall() || set.members.len() > 1;
        for set in self.sets.iter().filter(mirrors) {
            let members = &self.members[set.members.clone()];
            let of_member = |member: &Member| {
                let place = member.place as usize;
                let seen = nodes.strain_rate(place).mirrored(member.sign);
                seen.times(nodes.mass(place) / set.mass)
            };
            let sum = |sum: Sym3, part: Sym3| sum.plus(&part);
            let mut mean = members.iter().map(of_member).fold(Sym3::default(), sum);
            if matches!(set.back, Meets::On { .. }) {
                (mean.xy, mean.xz) = (0.0, 0.0);
            }
            if matches!(set.side, Meets::On { .. }) {
                (mean.xy, mean.yz) = (0.0, 0.0);
            }
            for member in members {
                nodes.set_strain_rate(member.place as usize, &mean.mirrored(member.sign));
            }
        }
    }

    /// Sets the volume fraction of every image to that of its node in the channel: a difference
    /// between the two sides of a wall would shift points through it.
    pub fn fill_ghost_nodes(&self, nodes: &mut impl NodeAccess) {
        for set in &self.sets {
            let [master, images @ ..] = &self.members[set.members.clone()] else {
                continue;
            };
            let volume_fraction = nodes.volume_fraction(master.place as usize);
            for image in images {
                nodes.set_volume_fraction(image.place as usize, volume_fraction);
            }
        }
    }
}

/// Sets the compressive strain of a node and its images to the mean over the points round all
/// of them.
fn smooth_compressive_strain(members: &[Member], nodes: &mut impl NodeAccess) {
    if members.len() < 2 {
        return;
    }
    let (mut mass, mut sum) = (0.0, 0.0);
    for member in members {
        let place = member.place as usize;
        mass += nodes.mass(place);
        sum += nodes.mass(place) * nodes.compressive_strain(place);
    }
    if mass > 0.0 {
        for member in members {
            nodes.set_compressive_strain(member.place as usize, sum / mass);
        }
    }
}

/// Volume fraction in an available share `room` of the kernel, for `volume_fraction` of the
/// whole.
pub fn filled(volume_fraction: f64, room: f64) -> f64 {
    if room > METHOD.boundary.least_available_volume {
        volume_fraction / room
    } else {
        // The stencils of too few points contain such a node.
        0.0
    }
}

impl Walls {
    /// Finds the nodes on which walls act.
    pub fn find_boundary(&self, nodes: &impl NodeAccess, boundary: &mut Boundary) {
        boundary.members.clear();
        boundary.sets.clear();
        boundary.cut.clear();
        boundary.column_nodes.clear();
        for (block, key) in nodes.blocks().iter().enumerate() {
            let first = key.map(|k| k * BLOCK as i32);
            if !self.may_act_in(nodes.lattice(), first) {
                continue;
            }
            for local in 0..BLOCK_NODES {
                let along = [
                    local / (BLOCK * BLOCK),
                    local / BLOCK % BLOCK,
                    local % BLOCK,
                ];
                let index = [0, 1, 2].map(|axis| first[axis] + along[axis] as i32);
                let place = block * BLOCK_NODES + local;
                // An empty node counts if its images may not be empty.
                let counts = nodes.mass(place) > 0.0 || self.vertical_walls.has_images(index);
                if counts && self.vertical_walls.master(index, nodes) == index {
                    self.add_set(nodes, place, index, boundary);
                }
            }
        }
        self.make_columns(boundary, nodes.lattice());
        boundary
            .constrained
            .resize(boundary.sets.len(), ConstrainedVelocity::default());
    }

    /// True if walls may act on a node of the block that starts at `first`.
    fn may_act_in(&self, lattice: &Lattice, first: [i32; 3]) -> bool {
        let last = first.map(|along| along + BLOCK as i32 - 1);
        let ends = match self.vertical_walls.ends {
            Ends::Back(_) => first[0] <= 1,
            Ends::Seam { cells } => first[0] <= 1 || last[0] >= cells - 1,
        };
        let vertical_walls =
            ends || first[1] <= 1 || 2 * last[1] >= self.vertical_walls.halves_across - 2;
        let (low, high) = (lattice.position(first), lattice.position(last));
        // The kernel's reach along a diagonal.
        let margin = REACH * lattice.spacing.norm();
        vertical_walls || self.bed.is_near(&low, &high, margin)
    }

    fn add_set(
        &self,
        nodes: &impl NodeAccess,
        place: usize,
        index: [i32; 3],
        boundary: &mut Boundary,
    ) {
        let resting = nodes.lattice().position(index);
        let start = boundary.members.len();
        boundary.members.push(Member {
            place: place as u32,
            sign: [1.0, 1.0],
            resting,
        });
        self.vertical_walls
            .for_each_image(index, |image, sign| match nodes.place_of(image) {
                Some(place) if nodes.mass(place) > 0.0 => boundary.members.push(Member {
                    place: place as u32,
                    sign,
                    resting: nodes.lattice().position(image),
                }),
                _ => {}
            });
        let back = self.vertical_walls.meets_back(index);
        let side = self.vertical_walls.meets_side(index);
        let surfaces = self.bed.surfaces_over(index, nodes.lattice());
        let alone = boundary.members.len() == start + 1;
        let set = boundary.sets.len() as u32;
        let known = boundary.column_nodes.len();
        let column_nodes = self.column_nodes_of(index, set, nodes.lattice());
        boundary.column_nodes.extend(column_nodes);
        let of_column = boundary.column_nodes.len() > known;
        let vertical_walls = back != Meets::Not || side != Meets::Not;
        let plain = alone && surfaces == [None; 2] && !vertical_walls && !of_column;
        let empty = alone && nodes.mass(place) <= 0.0;
        if plain || empty {
            boundary.members.truncate(start);
            boundary.column_nodes.truncate(known);
        }
        let room = self.bed.share_above(&resting, &nodes.lattice().spacing);
        if plain && room < 1.0 {
            boundary.cut.push((place as u32, room));
        }
        if plain || empty {
            return;
        }
        let members = start..boundary.members.len();
        let of_member = |member: &Member| nodes.mass(member.place as usize);
        let mass = boundary.members[members.clone()]
            .iter()
            .map(of_member)
            .sum();
        boundary.sets.push(ConstraintSet {
            members,
            mass,
            back,
            side,
            surfaces,
            room,
        });
    }
}
