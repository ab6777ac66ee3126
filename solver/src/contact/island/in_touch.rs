//! Length of body sub-steps in touch: a contact with little energy at stake needs no short
//! ones (docs/method.md, equation 20b).

use super::pace::{LARGEST_TURN, longest, relative_speed};
use super::{IslandPair, Member, Mover, Side, Surroundings, body_of};
use crate::contact::body_body::reduced_mass;
use crate::contact::body_wall::overlaps;
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::rigid::Body;

/// Sub-steps are so many times longer at most than those of an impact that takes all of a
/// body's energy: a weak one has a dozen at least.
const MOST_LONGER: f64 = 4.0;
/// Share of the time to the next contact that is crossed at most.
const SHARE_OF_WAY: f64 = 0.5;

/// Share of a body's energy that damping may take in a kick before one of another length: what
/// it takes is known for a kick of the same.
const QUIET: f64 = 1e-6;

/// A contact, there or to come.
struct Coming {
    /// [m]; negative when apart.
    overlap: f64,
    /// [m/s].
    approach: f64,
    /// Mass that approaches, and the least that resists [kg].
    masses: [f64; 2],
    /// Energy that what this one makes is compared with [J].
    scale: f64,
}

/// Longest sub-step for the contacts of an island as they are, and for those about to
/// come [s].
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

/// True if damping takes next to nothing of any body.
pub(super) fn is_quiet(members: &[Member], around: &Surroundings) -> bool {
    members
        .iter()
        .all(|member| member.report.energy.pending <= QUIET * scale(member.body, &around.gravity))
}

/// The same for the contacts of one body with walls, and for its turn.
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
    each.fold(LARGEST_TURN / angular.norm(), f64::min)
}

/// The same of two bodies, as if their whole motion were towards each other: features that
/// do not touch yet are not looked for.
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

/// Energy of a body that contacts may make a small share of [J]: of its motion, and of a fall
/// by its own size.
fn scale(body: &Body, gravity: &Vec3) -> f64 {
    body.kinetic_energy() + body.mass * gravity.norm() * body.shape.bounding_radius()
}

impl Coming {
    /// Longest sub-step for it [s]: that of the impact which takes the energy it has and
    /// brings, or what leaves it still to come.
    fn longest(&self, law: &ContactLaw) -> f64 {
        let [mass, least_mass] = self.masses;
        let brought = 0.5 * mass * self.approach.max(0.0) * self.approach;
        let held = law.elastic_energy(self.overlap.max(0.0));
        let at_stake = brought + held;
        if at_stake <= 0.0 {
            return f64::INFINITY;
        }
        let deepest = (2.5 * at_stake / law.stiffness).powf(0.4);
        let longer = (self.scale / at_stake)
            .sqrt()
            .sqrt()
            .clamp(1.0, MOST_LONGER);
        let impact = longer * longest(law, deepest, least_mass);
        if self.overlap < 0.0 {
            impact.max(SHARE_OF_WAY * -self.overlap / self.approach)
        } else {
            impact
        }
    }
}
