//! Length of body sub-steps in contact: a contact with little energy at stake needs no short
//! ones (docs/method.md, equation 20b).

use super::member::Member;
use super::mover::Mover;
use super::pace::{longest, relative_speed};
use super::pair::{IslandPair, Side, body_of};
use super::surroundings::Surroundings;
use crate::contact::body_body::reduced_mass;
use crate::contact::body_wall::overlaps;
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::rigid::Body;

/// Largest length of a sub-step over that of an impact which takes all of a body's energy; a
/// weak impact has at least a dozen.
const MOST_LONGER: f64 = 4.0;
/// Largest share of the time to the next contact that is crossed.
const SHARE_OF_WAY: f64 = 0.5;

/// Share of a body's energy that damping may dissipate in a kick before one of another length:
/// the dissipation is known for a kick of the same length.
const QUIET: f64 = 1e-6;

/// A present or coming contact.
struct Coming {
    /// Overlap [m]; negative when apart.
    overlap: f64,
    /// Approach speed [m/s].
    approach: f64,
    /// Approaching mass, and least resisting mass [kg].
    masses: [f64; 2],
    /// Energy that the integration error of this contact is compared with [J].
    scale: f64,
}

/// Longest sub-step for the present contacts of an island and those about to begin [s].
pub(super) fn longest_in_touch(
    members: &[Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    around: &Surroundings,
) -> f64 {
    let walls = members
        .iter()
        .map(|member| longest_on_walls(member.body, around));
    let island_pair = contact_pairs
        .iter()
        .map(|island_pair| longest_of_pair(members, movers, island_pair, &around.gravity));
    walls.chain(island_pair).fold(f64::INFINITY, f64::min)
}

/// True if damping dissipates next to nothing of any body's energy.
pub(super) fn is_quiet(members: &[Member], around: &Surroundings) -> bool {
    members
        .iter()
        .all(|member| member.report.energy.pending <= QUIET * scale(member.body, &around.gravity))
}

/// Longest sub-step for the contacts of one body with walls, and for its turning [s].
fn longest_on_walls(body: &Body, around: &Surroundings) -> f64 {
    let (linear, angular) = (body.velocity(), body.angular_velocity());
    let masses = [body.mass, body.least_effective_mass()];
    let scale = scale(body, &around.gravity);
    let each = overlaps(body, around.planes).map(|pair| {
        let coming = Coming {
            overlap: pair.overlap,
            approach: -(linear + angular.cross(&pair.arm)).dot(&pair.normal),
            masses,
            scale,
        };
        coming.longest(&body.wall_law)
    });
    each.fold(METHOD.body_step.largest_turn / angular.norm(), f64::min)
}

/// Longest sub-step for two bodies [s], as if their whole motion were an approach: features
/// that do not touch yet are not searched for.
fn longest_of_pair(
    members: &[Member],
    movers: &[Mover],
    island_pair: &IslandPair,
    gravity: &Vec3,
) -> f64 {
    let both = island_pair.sides.map(|side| body_of(members, movers, side));
    let free = |side: Side| matches!(side, Side::Member(_));
    let free = island_pair
        .sides
        .into_iter()
        .zip(both)
        .filter(|(side, _)| free(*side));
    let (mut inverse, mut least) = (0.0, f64::INFINITY);
    for (_, body) in free {
        inverse += 1.0 / body.least_effective_mass();
        least = f64::min(least, scale(body, gravity));
    }
    let overlap = if island_pair.contact_pair.touches() {
        island_pair.contact_pair.deepest
    } else {
        -island_pair.separation.at_least()
    };
    let coming = Coming {
        overlap,
        approach: relative_speed(both),
        masses: [reduced_mass(both[0], both[1]), 1.0 / inverse],
        scale: least,
    };
    coming.longest(&island_pair.law)
}

/// Energy scale of a body for the error of its contacts [J]: that of its motion, and of a fall
/// by its own size.
fn scale(body: &Body, gravity: &Vec3) -> f64 {
    body.kinetic_energy() + body.mass * gravity.norm() * body.shape.bounding_radius()
}

impl Coming {
    /// Longest sub-step for it [s]: that of the impact which takes its stored and kinetic
    /// energy, or the one that does not pass a coming contact.
    fn longest(&self, law: &ContactLaw) -> f64 {
        let [mass, least_mass] = self.masses;
        let touches = self.overlap > 0.0;
        // A rebound takes steps as short as the approach: an integration that is longer on the
        // way out makes energy in every impact.
        let speed = if touches {
            self.approach.abs()
        } else {
            self.approach.max(0.0)
        };
        let at_stake = 0.5 * mass * speed * speed + law.elastic_energy(self.overlap.max(0.0));
        if at_stake <= 0.0 {
            return f64::INFINITY;
        }
        let deepest = (2.5 * at_stake / law.stiffness).powf(0.4);
        let longer = (self.scale / at_stake)
            .sqrt()
            .sqrt()
            .clamp(1.0, MOST_LONGER);
        let impact = longer * longest(law, deepest, least_mass);
        if !touches {
            impact.max(SHARE_OF_WAY * -self.overlap / self.approach)
        } else {
            impact
        }
    }
}
