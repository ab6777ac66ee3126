//! Nodes on which walls act, and their available volumes.

use super::Impulse;
use super::columns::{BoundaryColumn, ColumnNode};
use super::constraint::ConstrainedVelocity;
use super::nodes::NodeAccess;
use super::vertical_walls::Meets;
use crate::bed::{Bed, BedAtNode, MOST_SURFACES, Surface};
use crate::math::{Sym3, Vec3};
use crate::method::METHOD;
use std::ops::Range;

/// A node or one of its images: they move as one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Member {
    pub(super) place: u32,
    /// +1, or −1 where the image is mirrored, for x and y.
    pub(super) sign: [i8; 2],
}

impl Member {
    /// A velocity in the frame of the first member, in that of this one, and back.
    #[inline]
    pub(super) fn mirrored(&self, v: &Vec3) -> Vec3 {
        let [x, y] = self.sign.map(f64::from);
        Vec3::new(x * v.x, y * v.y, v.z)
    }
}

/// Action of the bed on a constraint set.
#[derive(Debug, Clone, Copy, PartialEq)]
enum BedAction {
    /// Not at all, or through a column.
    Elsewhere,
    /// It lies on or below the bed.
    Below,
    /// Through the surfaces at this place of the list.
    Alone(u32),
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ConstraintSet {
    members: Range<u32>,
    pub(super) back: Meets,
    pub(super) side: Meets,
    /// Action of the bed on it.
    bed: BedAction,
    /// Their mass together [kg].
    pub(super) mass: f64,
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
                Meets::On { inward } if velocity[axis] * f64::from(inward) < 0.0 => {
                    velocity[axis] = 0.0;
                }
                Meets::On { .. } | Meets::Near { .. } | Meets::Not => {}
            }
        }
    }
}

/// Nodes on which walls act.
#[derive(Debug, Default)]
pub(super) struct ConstraintSets {
    pub(super) members: Vec<Member>,
    pub(super) sets: Vec<ConstraintSet>,
    surfaces: Vec<[Option<Surface>; MOST_SURFACES]>,
    /// Other nodes whose kernel the bed cuts: their places, and the share of it in the
    /// channel.
    pub(super) cut: Vec<(u32, f64)>,
    /// Constraint sets near the bed, by columns.
    pub(super) column_nodes: Vec<ColumnNode>,
}

impl ConstraintSets {
    pub(super) fn clear(&mut self) {
        self.members.clear();
        self.sets.clear();
        self.surfaces.clear();
        self.cut.clear();
        self.column_nodes.clear();
    }

    /// Members of a set.
    #[inline]
    pub(super) fn members_of(&self, set: &ConstraintSet) -> &[Member] {
        &self.members[set.members.start as usize..set.members.end as usize]
    }

    /// Surfaces of the bed that act on a set alone.
    #[inline]
    pub(super) fn surfaces_of(&self, set: &ConstraintSet) -> impl Iterator<Item = &Surface> {
        let surfaces = match set.bed {
            BedAction::Alone(place) => Some(&self.surfaces[place as usize]),
            BedAction::Elsewhere | BedAction::Below => None,
        };
        surfaces.into_iter().flatten().flatten()
    }

    /// Adds a set of the members from `start` on.
    pub(super) fn push(
        &mut self,
        start: usize,
        [back, side]: [Meets; 2],
        bed: &BedAtNode,
        mass: f64,
    ) {
        self.sets.push(ConstraintSet {
            members: start as u32..self.members.len() as u32,
            back,
            side,
            bed: if bed.covers {
                BedAction::Below
            } else {
                BedAction::Elsewhere
            },
            mass,
            room: bed.share_above,
        });
    }

    /// Leaves the bed to the column of a set.
    pub(super) fn put_into_column(&mut self, set: u32) {
        self.sets[set as usize].bed = BedAction::Elsewhere;
    }

    /// Finds the surfaces that act on the sets below the bed that belong to no column.
    pub(super) fn find_surfaces(&mut self, bed: &dyn Bed, nodes: &impl NodeAccess) {
        let below = |set: &&mut ConstraintSet| set.bed == BedAction::Below;
        for set in self.sets.iter_mut().filter(below) {
            let master = self.members[set.members.start as usize];
            let index = nodes.index(master.place as usize);
            set.bed = BedAction::Alone(self.surfaces.len() as u32);
            self.surfaces
                .push(bed.surfaces_over(index, nodes.lattice()));
        }
    }

    /// Adds those of other blocks of nodes.
    pub(super) fn append(&mut self, others: &Self) {
        let (sets, members) = (self.sets.len() as u32, self.members.len() as u32);
        self.members.extend_from_slice(&others.members);
        self.cut.extend_from_slice(&others.cut);
        self.sets
            .extend(others.sets.iter().map(|set| ConstraintSet {
                members: set.members.start + members..set.members.end + members,
                ..set.clone()
            }));
        let column_nodes = others.column_nodes.iter();
        self.column_nodes
            .extend(column_nodes.map(|node| node.after(sets)));
    }

    fn bytes(&self) -> usize {
        self.members.capacity() * size_of::<Member>()
            + self.sets.capacity() * size_of::<ConstraintSet>()
            + self.surfaces.capacity() * size_of::<[Option<Surface>; MOST_SURFACES]>()
            + self.cut.capacity() * size_of::<(u32, f64)>()
            + self.column_nodes.capacity() * size_of::<ColumnNode>()
    }
}

/// The nodes of one step on which walls act.
#[derive(Debug, Default)]
pub struct Boundary {
    pub(super) sets: ConstraintSets,
    /// The same by the tasks that found them.
    pub(super) found: Vec<ConstraintSets>,
    /// Column nodes that may make a column.
    pub(super) possible: Vec<Range<usize>>,
    /// The columns that they make.
    pub(super) made: Vec<Option<BoundaryColumn>>,
    pub(super) columns: Vec<BoundaryColumn>,
    /// Velocities of the first two nodes of each column of a kind.
    pub(super) ends: Vec<[Vec3; 2]>,
    /// Changes of each constraint set by a sub-step.
    pub(super) constrained: Vec<ConstrainedVelocity>,
    /// Impulses on them, task by task.
    pub(super) impulses: Vec<Impulse>,
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
        // All are held twice: as they were found, and in one list.
        let of_node = 2 * (size_of::<ConstraintSet>() + size_of::<Member>())
            + size_of::<ConstrainedVelocity>();
        let of_column =
            2 * size_of::<BoundaryColumn>() + size_of::<Range<usize>>() + size_of::<[Vec3; 2]>();
        self.nodes * of_node as f64
            + self.images * 2.0 * size_of::<Member>() as f64
            + self.columns * of_column as f64
            + self.column_nodes * 2.0 * size_of::<ColumnNode>() as f64
    }
}

impl Boundary {
    /// Bytes allocated.
    pub fn bytes(&self) -> usize {
        let found: usize = self.found.iter().map(ConstraintSets::bytes).sum();
        self.sets.bytes()
            + found
            + self.possible.capacity() * size_of::<Range<usize>>()
            + self.made.capacity() * size_of::<Option<BoundaryColumn>>()
            + self.columns.capacity() * size_of::<BoundaryColumn>()
            + self.ends.capacity() * size_of::<[Vec3; 2]>()
            + self.constrained.capacity() * size_of::<ConstrainedVelocity>()
    }

    /// Raises the volume fraction of nodes with less available volume at walls: the same volume of
    /// points fills more of it. A node and its images share it, and the mean compressive strain.
    pub fn exclude_volume(&self, nodes: &mut impl NodeAccess) {
        for (place, room) in &self.sets.cut {
            let place = *place as usize;
            nodes.set_volume_fraction(place, filled(nodes.volume_fraction(place), *room));
        }
        for set in &self.sets.sets {
            let members = self.sets.members_of(set);
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
        let sets = self.sets.sets.iter();
        sets.map(|set| self.sets.members_of(set))
            .filter(|members| members.len() > 1)
            .map(|members| members.iter().map(|member| member.place as usize))
    }

    /// Adds the strain rates of a node's images to its mean; on a wall, the mirror of itself.
    pub fn smooth_strain_rates(&self, nodes: &mut impl NodeAccess) {
        let mirrors = |set: &&ConstraintSet| set.is_at_vertical_wall() || set.members.len() > 1;
        for set in self.sets.sets.iter().filter(mirrors) {
            let members = self.sets.members_of(set);
            let of_member = |member: &Member| {
                let place = member.place as usize;
                let seen = nodes
                    .strain_rate(place)
                    .mirrored(member.sign.map(f64::from));
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
                nodes.set_strain_rate(
                    member.place as usize,
                    &mean.mirrored(member.sign.map(f64::from)),
                );
            }
        }
    }

    /// Sets the volume fraction of every image to that of its node in the channel: a difference
    /// between the two sides of a wall would shift points through it.
    pub fn fill_ghost_nodes(&self, nodes: &mut impl NodeAccess) {
        for set in &self.sets.sets {
            let [master, images @ ..] = self.sets.members_of(set) else {
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
