//! The channel's walls: planes for bodies, and constraints on grid nodes.
//!
//! The channel is convex: it lies above the floor and above the incline, and
//! between the upright walls. The upright walls lie on grid planes and act as
//! mirrors: a node and its images move as one, so a smooth wall reflects
//! exactly (docs/method.md, equation 28). Incline and floor stop inflow at the
//! nodes on and below them (equation 29).

use crate::grid::{BLOCK, BLOCK_NODES, BlockKey, Grid};
use crate::kernel::Lattice;
use crate::math::Vec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::iter::once;
use std::ops::Range;

/// Groups of nodes one task takes.
const TASK: usize = 128;
/// Half the kernel's width [node distances].
const REACH: f64 = 1.5;
/// A node with less than this share of its kernel in the channel does not say
/// how full it is.
const LEAST_ROOM: f64 = 0.02;

/// The nodes of a grid, by their places: block by block, within a block along z
/// first.
pub trait NodeAccess: Sync {
    /// Where the nodes lie.
    fn lattice(&self) -> &Lattice;
    /// The blocks of nodes.
    fn blocks(&self) -> &[BlockKey];
    /// Place of node (i, j, k), if its block is there.
    fn place_of(&self, index: [i32; 3]) -> Option<usize>;
    /// Mass [kg].
    fn mass(&self, place: usize) -> f64;
    /// Velocity [m/s].
    fn velocity(&self, place: usize) -> Vec3;
    /// Displacement at the start of the sub-step of `dt` [m].
    fn displacement(&self, place: usize, dt: f64) -> Vec3;
    /// Gives a node the velocity [m/s] with which it moves through the sub-step.
    fn set_velocity(&mut self, place: usize, velocity: &Vec3, dt: f64);
    /// Volume of points over room for them.
    fn fullness(&self, place: usize) -> f64;
    /// Changes it.
    fn set_fullness(&mut self, place: usize, fullness: f64);
}

impl NodeAccess for Grid {
    fn lattice(&self) -> &Lattice {
        self.lattice()
    }

    fn blocks(&self) -> &[BlockKey] {
        self.node_blocks()
    }

    fn place_of(&self, index: [i32; 3]) -> Option<usize> {
        self.place_of(index)
    }

    fn mass(&self, place: usize) -> f64 {
        self.nodes()[place].mass
    }

    fn velocity(&self, place: usize) -> Vec3 {
        self.nodes()[place].velocity
    }

    fn displacement(&self, place: usize, _: f64) -> Vec3 {
        self.nodes()[place].displacement
    }

    fn set_velocity(&mut self, place: usize, velocity: &Vec3, _: f64) {
        self.node_mut(place).velocity = *velocity;
    }

    fn fullness(&self, place: usize) -> f64 {
        self.nodes()[place].fullness
    }

    fn set_fullness(&mut self, place: usize, fullness: f64) {
        self.node_mut(place).fullness = fullness;
    }
}

/// A wall's surface; the channel lies on the side its normal points to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// What people call it.
    pub name: &'static str,
    /// Unit normal into the channel.
    pub normal: Vec3,
    /// normal · x of its points [m].
    pub offset: f64,
    /// Coulomb friction of the flow.
    pub flow_friction: f64,
}

impl Plane {
    /// Height of a place above the plane [m]; negative behind it.
    pub fn height(&self, x: &Vec3) -> f64 {
        self.normal.dot(x) - self.offset
    }
}

/// All walls of the channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Walls {
    /// Incline and floor: every place of the channel is above each of them.
    pub base: Vec<Plane>,
    /// The mirrors.
    pub upright: Upright,
}

/// The upright walls, on planes of nodes: ends at index 0 along x, sides at
/// index 0 and `cells_across` along y.
#[derive(Debug, Clone, PartialEq)]
pub struct Upright {
    /// What is at index 0 along x.
    pub ends: Ends,
    /// The side walls.
    pub sides: [Plane; 2],
    /// Cells between the side walls.
    pub cells_across: i32,
}

/// What bounds the flow along x.
#[derive(Debug, Clone, PartialEq)]
pub enum Ends {
    /// A wall at the back; the front is open.
    BackWall(Plane),
    /// None: what leaves after `cells` cells comes in at the back. Energy and
    /// angular momentum of such a flow can't be audited.
    Seam {
        /// Cells from end to end.
        cells: i32,
    },
}

/// Impulse that walls gave, linear [N s] and angular about the origin [N m s].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Impulse {
    /// Linear [N s].
    pub linear: Vec3,
    /// Angular about the origin [N m s].
    pub angular: Vec3,
}

impl Impulse {
    /// Adds an impulse `linear` that acts at `x`.
    pub fn add_at(&mut self, x: &Vec3, linear: &Vec3) {
        self.linear += linear;
        self.angular += x.cross(linear);
    }
}

/// A node with its images: they move as one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Member {
    place: u32,
    /// +1, or −1 where the image is mirrored, for x and y.
    sign: [f64; 2],
    /// Where it lies at the transfer [m].
    resting: Vec3,
}

#[derive(Debug, Clone, PartialEq)]
struct Group {
    members: Range<usize>,
    back: Meets,
    side: Meets,
    /// Which base planes it is on or below, as bits.
    below: u8,
    /// Share of the kernels that lies above the base planes.
    room: f64,
}

impl Group {
    fn is_upright(&self) -> bool {
        self.back != Meets::Not || self.side != Meets::Not
    }
}

/// How a group of nodes meets an upright wall; `inward` is the sign of the
/// wall's normal along its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Meets {
    Not,
    /// One node away, so that its image is behind the wall.
    Near {
        inward: f64,
    },
    /// On the wall's plane: it has no normal velocity.
    On {
        inward: f64,
    },
}

impl Meets {
    /// Share of the kernel on the channel's side, images counted with it.
    fn room(self) -> f64 {
        match self {
            Meets::On { .. } => 0.5,
            Meets::Not | Meets::Near { .. } => 1.0,
        }
    }
}

/// The nodes of one step that walls act on.
#[derive(Debug, Default)]
pub struct Boundary {
    members: Vec<Member>,
    groups: Vec<Group>,
    /// Other nodes whose kernel a base plane cuts: their places, and the share
    /// of it that lies in the channel.
    cut: Vec<(u32, f64)>,
    /// What a sub-step does to each group.
    answers: Vec<Answer>,
}

/// What walls do to a group.
#[derive(Debug, Clone, Copy, Default)]
struct Answer {
    /// Velocity in the frame of the first member [m/s]; `None` if it stays.
    velocity: Option<Vec3>,
    /// Impulse given.
    impulse: Impulse,
}

impl Boundary {
    /// Where walls leave less room, the same volume of points fills more of it;
    /// a node and its images share theirs.
    pub fn leave_less_room(&self, nodes: &mut impl NodeAccess) {
        for (place, room) in &self.cut {
            let place = *place as usize;
            nodes.set_fullness(place, filled(nodes.fullness(place), *room));
        }
        for group in &self.groups {
            let members = &self.members[group.members.clone()];
            let of_member = |member: &Member| nodes.fullness(member.place as usize);
            let inside = group.back.room() * group.side.room();
            let sum: f64 = members.iter().map(of_member).sum();
            let fullness = filled(sum / inside, group.room);
            for member in members {
                nodes.set_fullness(member.place as usize, fullness);
            }
        }
    }
}

/// Fullness of a share of the room, what fills all of it to `fullness`.
pub fn filled(fullness: f64, room: f64) -> f64 {
    if room > LEAST_ROOM {
        fullness / room
    } else {
        // Too few points see such a node to say.
        0.0
    }
}

/// Share of the kernel above a plane `height` node distances below its node.
pub fn share_above(height: f64) -> f64 {
    let beyond = (REACH - height.abs()).max(0.0);
    let below = if height.abs() < 0.5 {
        0.5 - 0.75 * height.abs() + height.abs().powi(3) / 3.0
    } else {
        beyond.powi(3) / 6.0
    };
    if height > 0.0 { 1.0 - below } else { below }
}

impl Walls {
    /// Every plane a body can touch.
    pub fn planes(&self) -> impl Iterator<Item = &Plane> {
        let back = match &self.upright.ends {
            Ends::BackWall(plane) => Some(plane),
            Ends::Seam { .. } => None,
        };
        self.base.iter().chain(back).chain(&self.upright.sides)
    }

    /// Finds the nodes that walls act on.
    pub fn find_boundary(&self, nodes: &impl NodeAccess, boundary: &mut Boundary) {
        boundary.members.clear();
        boundary.groups.clear();
        boundary.cut.clear();
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
                // An empty node counts where its images may not be empty.
                let counts = nodes.mass(place) > 0.0 || self.upright.has_images(index);
                if counts && self.upright.leader(index, nodes) == index {
                    self.add_group(nodes, place, index, boundary);
                }
            }
        }
        boundary
            .answers
            .resize(boundary.groups.len(), Answer::default());
    }

    /// Whether walls may act on a node of the block that starts at `first`.
    fn may_act_in(&self, lattice: &Lattice, first: [i32; 3]) -> bool {
        let last = first.map(|along| along + BLOCK as i32 - 1);
        let ends = match self.upright.ends {
            Ends::BackWall(_) => first[0] <= 1,
            Ends::Seam { cells } => first[0] <= 1 || last[0] >= cells - 1,
        };
        let upright = ends || first[1] <= 1 || last[1] >= self.upright.cells_across - 1;
        let (low, high) = (lattice.position(first), lattice.position(last));
        // The lowest of a box's corners above a plane.
        let lowest =
            |plane: &Plane| {
                let corner = plane
                    .normal
                    .zip_zip_map(&low, &high, |n, low, high| if n > 0.0 { low } else { high });
                plane.height(&corner)
            };
        // The kernel's reach along a diagonal.
        let margin = REACH * lattice.spacing.norm();
        upright || self.base.iter().any(|plane| lowest(plane) <= margin)
    }

    fn add_group(
        &self,
        nodes: &impl NodeAccess,
        place: usize,
        index: [i32; 3],
        boundary: &mut Boundary,
    ) {
        let resting = nodes.lattice().position(index);
        let below = self.below(&resting);
        let start = boundary.members.len();
        boundary.members.push(Member {
            place: place as u32,
            sign: [1.0, 1.0],
            resting,
        });
        self.upright
            .for_each_image(index, |image, sign| match nodes.place_of(image) {
                Some(place) if nodes.mass(place) > 0.0 => boundary.members.push(Member {
                    place: place as u32,
                    sign,
                    resting: nodes.lattice().position(image),
                }),
                _ => {}
            });
        let back = self.upright.meets_back(index);
        let side = self.upright.meets_side(index);
        let alone = boundary.members.len() == start + 1;
        let plain = alone && below == 0 && back == Meets::Not && side == Meets::Not;
        let empty = alone && nodes.mass(place) <= 0.0;
        if plain || empty {
            boundary.members.truncate(start);
        }
        let room = self.room(&resting, &nodes.lattice().spacing);
        if plain && room < 1.0 {
            boundary.cut.push((place as u32, room));
        }
        if plain || empty {
            return;
        }
        boundary.groups.push(Group {
            members: start..boundary.members.len(),
            back,
            side,
            below,
            room,
        });
    }

    /// Share of the kernel of a node at `x` that lies above the base planes.
    fn room(&self, x: &Vec3, spacing: &Vec3) -> f64 {
        let share = |plane: &Plane| {
            // The kernel is as wide along a slant as along its axes.
            let width = plane.normal.component_mul(spacing).norm();
            share_above(plane.height(x) / width)
        };
        self.base.iter().map(share).product()
    }

    fn below(&self, x: &Vec3) -> u8 {
        // A node that lies on the plane but for rounding belongs to it.
        let rounding = 1e-9 * (1.0 + x.norm());
        self.base
            .iter()
            .enumerate()
            .filter(|(_, plane)| plane.height(x) <= rounding)
            .fold(0, |bits, (which, _)| bits | 1 << which)
    }

    /// Makes nodes and their images move as one, as they will in the first
    /// sub-step. What it takes from the nodes' momentum the rest of the transfer
    /// gives back, so it is no impulse.
    pub fn reflect(&self, boundary: &Boundary, nodes: &mut impl NodeAccess) {
        for group in &boundary.groups {
            let members = &boundary.members[group.members.clone()];
            if members.len() == 1 && !group.is_upright() {
                continue;
            }
            let velocity = self.between_uprights(group, members, nodes);
            for member in members {
                let velocity = mirrored(&velocity, member.sign);
                nodes.set_velocity(member.place as usize, &velocity, 0.0);
            }
        }
    }

    /// Makes node velocities obey the walls for a sub-step of `dt` [s]: mirrors
    /// at the upright ones, no inflow and free separation at the base, Coulomb
    /// friction at both. Returns the impulse given to the flow.
    pub fn constrain(
        &self,
        boundary: &mut Boundary,
        nodes: &mut impl NodeAccess,
        dt: f64,
    ) -> Impulse {
        let Boundary {
            members,
            groups,
            answers,
            ..
        } = boundary;
        let seen: &_ = nodes;
        answers
            .par_iter_mut()
            .zip(&*groups)
            .with_min_len(TASK)
            .for_each(|(answer, group)| {
                *answer = self.answer(group, &members[group.members.clone()], seen, dt);
            });
        let mut given = Impulse::default();
        for (answer, group) in answers.iter().zip(groups) {
            let Some(velocity) = answer.velocity else {
                continue;
            };
            given.linear += answer.impulse.linear;
            given.angular += answer.impulse.angular;
            for member in &members[group.members.clone()] {
                let velocity = mirrored(&velocity, member.sign);
                nodes.set_velocity(member.place as usize, &velocity, dt);
            }
        }
        given
    }

    fn answer(
        &self,
        group: &Group,
        members: &[Member],
        nodes: &impl NodeAccess,
        dt: f64,
    ) -> Answer {
        let velocity = self.velocity_of(group, members, nodes);
        if let [only] = members
            && velocity == nodes.velocity(only.place as usize)
        {
            return Answer::default();
        }
        let mut impulse = Impulse::default();
        for member in members {
            let place = member.place as usize;
            let change = mirrored(&velocity, member.sign) - nodes.velocity(place);
            let present = member.resting + nodes.displacement(place, dt);
            impulse.add_at(&present, &(change * nodes.mass(place)));
        }
        Answer {
            velocity: Some(velocity),
            impulse,
        }
    }

    /// Common velocity of a group in the frame of its first member.
    fn velocity_of(&self, group: &Group, members: &[Member], nodes: &impl NodeAccess) -> Vec3 {
        let mut velocity = match members {
            [only] if !group.is_upright() => nodes.velocity(only.place as usize),
            _ => self.between_uprights(group, members, nodes),
        };
        let against_back_wall = matches!(group.back, Meets::On { .. });
        for (which, plane) in self.base.iter().enumerate() {
            if group.below & 1 << which != 0 {
                constrain_to(plane, against_back_wall, &mut velocity);
            }
        }
        velocity
    }

    /// Common velocity of a group that meets an upright wall, but for the base.
    fn between_uprights(&self, group: &Group, members: &[Member], nodes: &impl NodeAccess) -> Vec3 {
        let folded = Folded::of(members, nodes);
        let mut velocity = folded.momentum / folded.mass;
        for (axis, meets) in [(0, group.back), (1, group.side)] {
            let inward = match meets {
                Meets::Not => continue,
                Meets::Near { inward } => inward,
                Meets::On { inward } => {
                    velocity[axis] = 0.0;
                    inward
                }
            };
            let friction = self.upright.friction(axis);
            let after = velocity[axis] * folded.signed_mass[axis];
            let pressed = (after - folded.unfolded[axis]) * inward;
            if friction > 0.0 && pressed > 0.0 {
                rub(axis, friction * pressed / folded.mass, &mut velocity);
            }
        }
        velocity
    }
}

/// What a node and its images carry together.
struct Folded {
    mass: f64,
    /// Momentum, the images' mirrored back.
    momentum: Vec3,
    /// Momentum as it lies on the grid.
    unfolded: Vec3,
    /// Mass less mass of images, for x and y.
    signed_mass: [f64; 2],
}

impl Folded {
    fn of(members: &[Member], nodes: &impl NodeAccess) -> Self {
        let mut folded = Self {
            mass: 0.0,
            momentum: Vec3::zeros(),
            unfolded: Vec3::zeros(),
            signed_mass: [0.0; 2],
        };
        for member in members {
            let place = member.place as usize;
            let (mass, velocity) = (nodes.mass(place), nodes.velocity(place));
            folded.mass += mass;
            folded.momentum += mirrored(&velocity, member.sign) * mass;
            folded.unfolded += velocity * mass;
            for axis in 0..2 {
                folded.signed_mass[axis] += member.sign[axis] * mass;
            }
        }
        folded
    }
}

/// Coulomb friction of an upright wall: takes at most `largest_loss` of the
/// speed along it.
fn rub(axis: usize, largest_loss: f64, velocity: &mut Vec3) {
    let normal = velocity[axis];
    velocity[axis] = 0.0;
    *velocity *= kept_by_friction(largest_loss, velocity.norm());
    velocity[axis] = normal;
}

/// No inflow through a base plane, and friction on what was stopped.
fn constrain_to(plane: &Plane, against_back_wall: bool, velocity: &mut Vec3) {
    // On the back wall only the vertical is left to move in, so the incline
    // acts along it there.
    let normal = if against_back_wall {
        Vec3::z()
    } else {
        plane.normal
    };
    let inflow = -velocity.dot(&normal);
    if inflow <= 0.0 {
        return;
    }
    let tangential = *velocity + normal * inflow;
    *velocity = tangential * kept_by_friction(plane.flow_friction * inflow, tangential.norm());
}

/// Share of a tangential speed that Coulomb friction leaves.
fn kept_by_friction(largest_loss: f64, speed: f64) -> f64 {
    if speed > largest_loss {
        1.0 - largest_loss / speed
    } else {
        0.0
    }
}

fn mirrored(v: &Vec3, sign: [f64; 2]) -> Vec3 {
    Vec3::new(sign[0] * v.x, sign[1] * v.y, v.z)
}

impl Upright {
    /// The node in the channel that a node is the image of (itself, mostly);
    /// across a seam the first that has a block.
    fn leader(&self, [i, j, k]: [i32; 3], nodes: &impl NodeAccess) -> [i32; 3] {
        let across = self.cells_across;
        let j = j.abs();
        let j = if j > across { 2 * across - j } else { j };
        let i = match self.ends {
            Ends::BackWall(_) => i.abs(),
            Ends::Seam { cells } => {
                let there = |i: &i32| nodes.place_of([*i, j, k]).is_some();
                let first = i.rem_euclid(cells);
                let mut alike = once(first).chain(across_seam(first, cells));
                alike.find(there).unwrap_or(first)
            }
        };
        [i, j, k]
    }

    /// Whether a node has images that the kernel can reach.
    fn has_images(&self, [i, j, _]: [i32; 3]) -> bool {
        let along = match self.ends {
            Ends::BackWall(_) => i == 1,
            Ends::Seam { cells } => across_seam(i, cells).next().is_some(),
        };
        along || j == 1 || j == self.cells_across - 1
    }

    /// Visits the images that the kernel can reach, one node behind a wall.
    fn for_each_image(&self, [i, j, k]: [i32; 3], mut visit: impl FnMut([i32; 3], [f64; 2])) {
        let across = self.cells_across;
        let (mirror, period) = match self.ends {
            Ends::BackWall(_) => ((i == 1).then_some((-i, -1.0)), None),
            Ends::Seam { cells } => (None, Some(cells)),
        };
        let repeats = period.into_iter().flat_map(|cells| across_seam(i, cells));
        let along_x = once((i, 1.0))
            .chain(mirror)
            .chain(repeats.map(|i| (i, 1.0)));
        let along_y = [
            Some((j, 1.0)),
            (j == 1).then_some((-j, -1.0)),
            (j == across - 1).then_some((2 * across - j, -1.0)),
        ];
        for (x, (i, sign_x)) in along_x.enumerate() {
            for (y, &(j, sign_y)) in along_y.iter().flatten().enumerate() {
                if x + y > 0 {
                    visit([i, j, k], [sign_x, sign_y]);
                }
            }
        }
    }

    fn meets_back(&self, [i, ..]: [i32; 3]) -> Meets {
        match self.ends {
            Ends::BackWall(_) => meets(i, 1.0),
            Ends::Seam { .. } => Meets::Not,
        }
    }

    fn meets_side(&self, [_, j, _]: [i32; 3]) -> Meets {
        let from_far_side = self.cells_across - j;
        if from_far_side < j {
            meets(from_far_side, -1.0)
        } else {
            meets(j, 1.0)
        }
    }

    /// Whether what leaves comes in again.
    pub fn has_seam(&self) -> bool {
        matches!(self.ends, Ends::Seam { .. })
    }

    /// By how many cells a place `along` cells from the back is moved so that it
    /// lies between the ends of a seam.
    pub fn shift_across_seam(&self, along: f64) -> Option<i32> {
        let Ends::Seam { cells } = self.ends else {
            return None;
        };
        let outside = (along / f64::from(cells)).floor();
        (outside != 0.0).then_some(-(outside as i32) * cells)
    }

    /// Friction of the walls across an axis.
    fn friction(&self, axis: usize) -> f64 {
        match (&self.ends, axis) {
            (Ends::BackWall(plane), 0) => plane.flow_friction,
            (Ends::Seam { .. }, 0) => 0.0,
            _ => self.sides[0].flow_friction,
        }
    }
}

/// The other nodes along x that are the same across a seam of `cells` cells and
/// within the kernel's reach.
fn across_seam(i: i32, cells: i32) -> impl Iterator<Item = i32> {
    let first = i.rem_euclid(cells) - cells;
    let alike = (0..4).map(move |period| first + period * cells);
    alike.filter(move |alike| *alike != i && (-1..=cells + 1).contains(alike))
}

/// How a node `distance` nodes from a wall meets it.
fn meets(distance: i32, inward: f64) -> Meets {
    match distance {
        0 => Meets::On { inward },
        1 => Meets::Near { inward },
        _ => Meets::Not,
    }
}

#[cfg(test)]
mod tests;
