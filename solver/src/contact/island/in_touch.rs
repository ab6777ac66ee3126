//! Length of body sub-steps in contact: a contact with little energy at stake needs no short
//! ones (docs/method.md, equation 20b).

use super::member::Member;
use super::mover::Mover;
use super::pace::{longest, relative_speed};
use super::pair::{IslandPair, Side, body_of};
use super::surroundings::Surroundings;
use crate::contact::body_body::{ContactPair, reduced_mass};
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::Body;

/// Largest length of a sub-step over that of an impact which takes all of a body's energy; a
/// weak impact has at least a dozen.
const MOST_LONGER: f64 = 4.0;
/// Largest share of the time to the next contact that is crossed.
const SHARE_OF_WAY: f64 = 0.5;

/// Longest sub-step for the present contacts of an island and those about to begin [s], at most
/// this long [s].
pub(super) fn longest_in_touch(
    members: &[Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    around: &Surroundings,
    at_most: f64,
) -> f64 {
    let walls = members
        .iter()
        .map(|member| longest_on_walls(member, around, at_most));
    let island_pair = contact_pairs
        .iter()
        .map(|island_pair| longest_of_pair(members, movers, island_pair, &around.gravity, at_most));
    walls.chain(island_pair).fold(at_most, f64::min)
}

/// Longest sub-step for the contacts of one body with walls, and for its turning [s].
fn longest_on_walls(member: &Member, around: &Surroundings, at_most: f64) -> f64 {
    let body = &*member.body;
    let (linear, angular) = (body.velocity(), body.angular_velocity());
    let turn = METHOD.body_step.largest_turn / angular.norm();
    let radius = body.shape.bounding_radius();
    let fastest = linear.norm() + angular.norm() * radius;
    let within = radius + fastest * at_most / SHARE_OF_WAY;
    let mut hardest = 0.0;
    for plane in around.walls.planes {
        if plane.height(&body.state.position) >= within {
            continue;
        }
        for arm in body.turned_core() {
            let coming = Coming {
                overlap: body.shape.sphero_radius() - plane.height(&(body.state.position + arm)),
                approach: -(linear + angular.cross(arm)).dot(&plane.normal),
            };
            hardest = f64::max(hardest, coming.at_stake(&body.wall_law, body.mass, at_most));
        }
    }
    let mut longest = turn;
    if let Some(ground) = around.walls.terrain {
        let placed = body.placed();
        let known = body.near_ground.reach(&placed) - body.shape.sphero_radius();
        longest = longest.min(SHARE_OF_WAY * known.max(0.0) / fastest);
        for place in body.near_ground.places(&placed, ground) {
            let coming = Coming {
                overlap: body.shape.sphero_radius() - place.height,
                approach: -(linear + angular.cross(&place.arm)).dot(&place.normal),
            };
            hardest = f64::max(hardest, coming.at_stake(&body.wall_law, body.mass, at_most));
        }
    }
    if hardest == 0.0 {
        return longest;
    }
    let at_stake = AtStake {
        energy: hardest + pressed(&body.wall_law, pressing(member, &around.gravity)),
        scale: scale(body, &around.gravity),
        least_mass: body.least_effective_mass(),
    };
    longest.min(at_stake.longest(&body.wall_law))
}

/// Longest sub-step for two bodies [s]. Of features that do not touch yet all the motion counts as
/// approach.
fn longest_of_pair(
    members: &[Member],
    movers: &[Mover],
    island_pair: &IslandPair,
    gravity: &Vec3,
    at_most: f64,
) -> f64 {
    let both = island_pair.sides.map(|side| body_of(members, movers, side));
    let law = &island_pair.law;
    let mass = reduced_mass(both[0], both[1]);
    let IslandPair {
        contact_pair,
        separation,
        contacts,
        ..
    } = island_pair;
    // Of the others only how far they are is known.
    let others = Coming {
        overlap: if contact_pair.touches() {
            -separation.clearance(contacts)
        } else {
            -separation.at_least()
        },
        approach: relative_speed(both),
    };
    let touching = ContactPair::approaches(both, contacts).map(|(approach, overlap)| {
        let coming = Coming { overlap, approach };
        coming.at_stake(law, mass, at_most)
    });
    let hardest = touching.fold(others.at_stake(law, mass, at_most), f64::max);
    if hardest == 0.0 {
        return f64::INFINITY;
    }
    let (mut inverse, mut least, mut force) = (0.0, f64::INFINITY, 0.0);
    for side in island_pair.sides {
        if let Side::Member(place) = side {
            let member = &members[place];
            inverse += 1.0 / member.body.least_effective_mass();
            least = f64::min(least, scale(member.body, gravity));
            force += pressing(member, gravity);
        }
    }
    let at_stake = AtStake {
        energy: hardest + pressed(law, force),
        scale: least,
        least_mass: 1.0 / inverse,
    };
    at_stake.longest(law)
}

/// Energy scale of a body for the error of its contacts [J]: that of its motion, and of a fall
/// by its own size.
fn scale(body: &Body, gravity: &Vec3) -> f64 {
    body.kinetic_energy() + body.mass * gravity.norm() * body.shape.bounding_radius()
}

/// Force that presses the contacts of a body all the time [N]: that of the flow, and its weight.
fn pressing(member: &Member, gravity: &Vec3) -> f64 {
    member.flow.force.norm() + member.body.mass * gravity.norm()
}

/// Energy that a constant force stores in a contact, which it presses as deep as its work is
/// stored there [J].
fn pressed(law: &ContactLaw, force: f64) -> f64 {
    let deepest = (2.5 * force / law.stiffness).powf(2.0 / 3.0);
    force * deepest
}

/// A present or coming contact.
struct Coming {
    /// Overlap [m]; negative when apart.
    overlap: f64,
    /// Approach speed [m/s].
    approach: f64,
}

impl Coming {
    /// Energy stored in it and of its approach [J], the approaching mass being `mass`; 0 if it
    /// does not begin within `at_most` [s].
    fn at_stake(&self, law: &ContactLaw, mass: f64, at_most: f64) -> f64 {
        let is_far = || SHARE_OF_WAY * -self.overlap >= self.approach * at_most;
        if self.overlap <= 0.0 && is_far() {
            return 0.0;
        }
        // A rebound takes steps as short as the approach: an integration that is longer on the
        // way out makes energy in every impact.
        let moving = 0.5 * mass * self.approach * self.approach;
        moving + law.elastic_energy(self.overlap.max(0.0))
    }
}

/// Energy at stake in a contact.
struct AtStake {
    /// The energy [J].
    energy: f64,
    /// Energy that its integration error is compared with [J].
    scale: f64,
    /// Least resisting mass [kg].
    least_mass: f64,
}

impl AtStake {
    /// Longest sub-step [s]: that of the impact which takes the energy.
    fn longest(&self, law: &ContactLaw) -> f64 {
        let deepest = (2.5 * self.energy / law.stiffness).powf(0.4);
        let longer = (self.scale / self.energy)
            .sqrt()
            .sqrt()
            .clamp(1.0, MOST_LONGER);
        longer * longest(law, deepest, self.least_mass)
    }
}
