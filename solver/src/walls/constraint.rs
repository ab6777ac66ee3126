//! Constraints of walls on the motion of nodes.

use super::boundary::{Boundary, ConstraintSet, Member};
use super::nodes::NodeAccess;
use super::vertical_walls::{Meets, VerticalWalls};
use super::{Impulse, Walls};
use crate::bed::Surface;
use crate::math::Vec3;
use rayon::prelude::*;

/// Constraint sets per task.
const TASK: usize = 128;

/// Length of a sub-step, in the terms of the walls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPace {
    /// Length of the sub-step [s].
    pub dt: f64,
    /// Sub-steps in which sound crosses a cell.
    pub crossing: f64,
}

/// State of a constraint set before the forces of a sub-step.
#[derive(Debug, Clone, Copy)]
struct Before {
    /// Momentum along x and y [N s].
    momentum: [f64; 2],
    /// Sub-steps in which sound crosses a cell. Material under a pressure p may expand off a wall
    /// at up to p/(ρ c) without separating: as long as p could stop it within that time.
    crossing: f64,
}

/// Constrained velocity of a constraint set at walls.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ConstrainedVelocity {
    /// Velocity in the frame of the first member [m/s].
    pub(super) velocity: Vec3,
    /// True along x and y if the constraint set separates from the wall across: its images move
    /// along with it instead of mirrored.
    leaves: [bool; 2],
    /// Momentum of the constraint set along x and y after it, unreflected, on the grid [N s].
    left: [f64; 2],
    /// True if the velocity has changed.
    changed: bool,
}

impl Walls {
    /// Applies the constraints of the first sub-step, without the impulse of walls: nodes and their
    /// images move as one, and columns of nodes linearly. The momentum that this removes is
    /// returned by the residual transfer, so it is no impulse.
    pub fn reflect(&self, boundary: &mut Boundary, nodes: &mut impl NodeAccess) {
        self.propose(boundary, nodes, None);
        self.line_up(boundary, false);
        for (answer, set) in boundary.constrained.iter().zip(&boundary.sets.sets) {
            for member in boundary.sets.members_of(set) {
                nodes.set_velocity(member.place as usize, &answer.velocity_of(member), 0.0);
            }
        }
    }

    /// Constrains node velocities at the walls for a sub-step: mirrors at the vertical walls, no
    /// inflow and free separation at the bed, Coulomb friction at both. Returns the impulse on the
    /// flow.
    pub fn constrain(
        &self,
        boundary: &mut Boundary,
        nodes: &mut impl NodeAccess,
        pace: WallPace,
    ) -> Impulse {
        self.propose(boundary, nodes, Some(pace));
        self.line_up(boundary, true);
        Self::give(boundary, nodes, pace.dt)
    }

    /// Joins nodes and their images again after a residual transfer, which scatters to each of them
    /// separately: bodies use the flow's motion before the first sub-step's
    /// [`constrain`](Self::constrain). Returns the impulse.
    pub fn join(&self, boundary: &mut Boundary, nodes: &mut impl NodeAccess) -> Impulse {
        self.propose(boundary, nodes, None);
        Self::give(boundary, nodes, 0.0)
    }

    /// Sets the constraint sets to their constrained velocities.
    fn give(boundary: &mut Boundary, nodes: &mut impl NodeAccess, dt: f64) -> Impulse {
        let Boundary {
            sets,
            constrained,
            impulses,
            ..
        } = boundary;
        let seen: &_ = nodes;
        constrained
            .par_chunks_mut(TASK)
            .zip(sets.sets.par_chunks(TASK))
            .map(|(answers, alike)| {
                let mut given = Impulse::default();
                for (answer, set) in answers.iter_mut().zip(alike) {
                    answer.account_for(sets.members_of(set), seen, dt, &mut given);
                }
                given
            })
            .collect_into_vec(impulses);
        for (answer, set) in constrained.iter().zip(&sets.sets) {
            if !answer.changed {
                continue;
            }
            for member in sets.members_of(set) {
                nodes.set_velocity(member.place as usize, &answer.velocity_of(member), dt);
            }
        }
        let sum = |sum: Impulse, part: &Impulse| sum.plus(part);
        impulses.iter().fold(Impulse::default(), sum)
    }

    /// Computes for every constraint set its motion without its column; within a sub-step, which
    /// has a `pace`, with the planes of the bed that act on it alone.
    fn propose(&self, boundary: &mut Boundary, nodes: &impl NodeAccess, pace: Option<WallPace>) {
        let Boundary {
            sets, constrained, ..
        } = boundary;
        constrained
            .par_iter_mut()
            .zip(&sets.sets)
            .with_min_len(TASK)
            .for_each(|(answer, set)| {
                let members = sets.members_of(set);
                let before = pace.map(|pace| Before {
                    momentum: answer.left,
                    crossing: pace.crossing,
                });
                let mut motion = self.joint_motion(set, members, nodes, before);
                if pace.is_some() {
                    for surface in sets.surfaces_of(set) {
                        constrain_to(surface, &mut motion.velocity);
                    }
                }
                (answer.velocity, answer.leaves) = (motion.velocity, motion.leaves);
            });
    }

    /// Common motion of a constraint set in the frame of its first member, without the bed.
    /// `before` is given if the forces of a sub-step have acted.
    #[inline]
    fn joint_motion(
        &self,
        set: &ConstraintSet,
        members: &[Member],
        nodes: &impl NodeAccess,
        before: Option<Before>,
    ) -> Motion {
        match (&self.vertical_walls, members) {
            (Some(walls), [_, _, ..]) => between_vertical_walls(walls, set, members, nodes, before),
            (Some(walls), _) if set.is_at_vertical_wall() => {
                between_vertical_walls(walls, set, members, nodes, before)
            }
            _ => Motion {
                velocity: nodes.velocity(members[0].place as usize),
                leaves: [false; 2],
            },
        }
    }
}

/// Common motion of a constraint set at a vertical wall, without the bed.
fn between_vertical_walls(
    vertical_walls: &VerticalWalls,
    set: &ConstraintSet,
    members: &[Member],
    nodes: &impl NodeAccess,
    before: Option<Before>,
) -> Motion {
    let folded = Folded::of(members, nodes);
    let mut velocity = folded.momentum / folded.mass;
    let mut leaves = [false; 2];
    for (axis, meets) in [(0, set.back), (1, set.side)] {
        let (Meets::Near { inward } | Meets::On { inward }) = meets else {
            continue;
        };
        let sign = f64::from(inward);
        let momentum = folded.unfolded[axis] * sign;
        let pressed = before.map_or(0.0, |before| {
            let lost = (before.momentum[axis] * sign - momentum).max(0.0);
            lost * before.crossing * meets.share_of_pressure()
        });
        leaves[axis] = momentum > pressed && vertical_walls.lets_go(axis, inward);
        if leaves[axis] {
            velocity[axis] = folded.unfolded[axis] / folded.mass;
            continue;
        }
        if let Meets::On { .. } = meets {
            velocity[axis] = 0.0;
        }
        let friction = vertical_walls.friction(axis, inward);
        let after = velocity[axis] * folded.signed_mass[axis];
        let pressed = (after - folded.unfolded[axis]) * sign;
        if friction > 0.0 && pressed > 0.0 {
            apply_friction(axis, friction * pressed / folded.mass, &mut velocity);
        }
    }
    Motion { velocity, leaves }
}

/// Motion of a constraint set in the frame of its first member.
struct Motion {
    /// Velocity [m/s].
    velocity: Vec3,
    /// True along x and y if the constraint set separates from the wall across.
    leaves: [bool; 2],
}

impl ConstrainedVelocity {
    /// Velocity of one of the constraint set [m/s].
    #[inline]
    fn velocity_of(&self, member: &Member) -> Vec3 {
        let mut velocity = member.mirrored(&self.velocity);
        for axis in 0..2 {
            if self.leaves[axis] {
                velocity[axis] = self.velocity[axis];
            }
        }
        velocity
    }

    /// Adds the impulse of the change of velocity.
    #[inline]
    fn account_for(
        &mut self,
        members: &[Member],
        nodes: &impl NodeAccess,
        dt: f64,
        given: &mut Impulse,
    ) {
        self.changed = false;
        self.left = [0.0; 2];
        for member in members {
            let place = member.place as usize;
            let velocity = self.velocity_of(member);
            let mass = nodes.mass(place);
            for axis in 0..2 {
                self.left[axis] += velocity[axis] * mass;
            }
            let change = velocity - nodes.velocity(place);
            if change != Vec3::zeros() {
                self.changed = true;
                let present = nodes.position(place) + nodes.displacement(place, dt);
                given.add_at(&present, &(change * mass));
            }
        }
    }
}

/// Total mass and momentum of a node and its images.
struct Folded {
    mass: f64,
    /// Momentum, the images' mirrored back.
    momentum: Vec3,
    /// Momentum without reflection, on the grid.
    unfolded: Vec3,
    /// Mass less mass of images, for x and y.
    signed_mass: [f64; 2],
}

impl Folded {
    #[inline]
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
            folded.momentum += member.mirrored(&velocity) * mass;
            folded.unfolded += velocity * mass;
            for axis in 0..2 {
                folded.signed_mass[axis] += f64::from(member.sign[axis]) * mass;
            }
        }
        folded
    }
}

/// Coulomb friction of a vertical wall: takes at most `largest_loss` of the speed along it.
fn apply_friction(axis: usize, largest_loss: f64, velocity: &mut Vec3) {
    let normal = velocity[axis];
    velocity[axis] = 0.0;
    *velocity *= kept_by_friction(largest_loss, velocity.norm());
    velocity[axis] = normal;
}

/// Stops inflow through a surface, and applies friction by the stopped momentum.
pub(super) fn constrain_to(surface: &Surface, velocity: &mut Vec3) {
    let inflow = -velocity.dot(&surface.normal);
    if inflow <= 0.0 {
        return;
    }
    let tangential = *velocity + surface.normal * inflow;
    *velocity = tangential * kept_by_friction(surface.friction * inflow, tangential.norm());
}

/// Share of a tangential speed that remains after Coulomb friction.
fn kept_by_friction(largest_loss: f64, speed: f64) -> f64 {
    if speed > largest_loss {
        1.0 - largest_loss / speed
    } else {
        0.0
    }
}
