//! Energy balance of the bodies of an island (docs/method.md, equation 38a).
//!
//! A kick changes the kinetic energy exactly by the work of its loads at the mean of the
//! velocities before and after it. The remainder after subtracting all known terms was
//! therefore made: by contacts, by turning, or by the finite length of the steps.

use super::member::Member;
use super::mover::Mover;
use super::pair::{IslandPair, Side, body_of};
use super::report::EnergyReport;
use crate::contact::body_body::Exchange;
use crate::contact::dissipation::Taken;
use crate::math::Vec3;
use crate::rigid::{Body, Load};

/// Begins the balance of a sub-step of the flow.
pub(super) fn begin(members: &mut [Member], contact_pairs: &[IslandPair]) {
    take_stock(members, contact_pairs);
    for member in members {
        let energy = &mut member.report.energy;
        energy.made = -energy.present;
    }
}

/// Lengths of a sub-step and of the one before [s]. The damping found between them acts in the
/// second half kick of the one, and in the first of the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lengths {
    pub(super) before: f64,
    pub(super) now: f64,
}

/// Corrects the dissipation counted for a sub-step as long as the one before, once the first half
/// kick of a sub-step of another length is done.
pub(super) fn correct_losses(
    members: &mut [Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    lengths: Lengths,
) {
    for member in &mut *members {
        let now = power_on_member(member);
        member.report.energy.dissipated += lengths.excess(&member.taken, now);
    }
    for island_pair in contact_pairs {
        let now = power_in_pair(members, movers, island_pair);
        let excess = lengths.excess(&island_pair.taken, now);
        halve(members, island_pair, excess, |energy| {
            &mut energy.dissipated
        });
    }
}

impl Lengths {
    /// Dissipation less what was counted [J]; `power` is that of the damping after the kick [W].
    /// Its velocities change evenly in the kick.
    fn excess(&self, taken: &Taken, power: f64) -> f64 {
        let Self { before, now } = *self;
        let change = (power - taken.power) * (now * now - before * before) / (4.0 * now);
        let work = 0.5 * taken.power * (before + now) + change;
        (-work).max(0.0) - (-taken.power * before).max(0.0)
    }
}

/// Ends the balance of a sub-step of the flow.
pub(super) fn end(members: &mut [Member], contact_pairs: &[IslandPair], gravity: &Vec3) {
    take_stock(members, contact_pairs);
    for member in members {
        let energy = &mut member.report.energy;
        let way = member.body.state.position - member.start;
        energy.gravity = member.body.mass * gravity.dot(&way);
        let brought = energy.flow + energy.gravity + energy.bodies - energy.dissipated;
        energy.made += energy.present - brought;
    }
}

/// Sums the kinetic energy of each body and the energy stored in its contacts.
fn take_stock(members: &mut [Member], contact_pairs: &[IslandPair]) {
    for member in &mut *members {
        let (body, report) = (&member.body, &mut member.report);
        report.energy.present = body.kinetic_energy() + body.state.wall_energy;
    }
    for island_pair in contact_pairs {
        halve(
            members,
            island_pair,
            island_pair.contact_pair.energy,
            |energy| &mut energy.present,
        );
    }
}

/// Adds the work of bodies on each other in a kick of `dt`.
pub(super) fn take_in_work(
    members: &mut [Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    dt: f64,
) {
    for island_pair in contact_pairs
        .iter()
        .filter(|island_pair| island_pair.contact_pair.touches())
    {
        let exchange = island_pair
            .contact_pair
            .exchange(island_pair.sides.map(|side| body_of(members, movers, side)));
        let work = |side: Side, load: &Load| match side {
            Side::Member(place) => dt * load.power(&members[place].mean),
            Side::Mover(place) => dt * load.power(&movers[place].body.velocities()),
            Side::Barrier(_) => 0.0,
        };
        let [first, second] = island_pair.sides;
        let (on_first, on_second) = (
            work(first, &exchange.on_first),
            work(second, &exchange.on_second),
        );
        let mut give = |place: usize, energy: f64| members[place].report.energy.bodies += energy;
        match [first, second] {
            [Side::Member(one), Side::Member(other)] => {
                let given = 0.5 * (on_first - on_second);
                give(one, given);
                give(other, -given);
            }
            [Side::Member(one), _] => give(one, -on_second),
            [_, Side::Member(other)] => give(other, -on_first),
            _ => {}
        }
    }
}

/// Adds the dissipation of contacts in a sub-step of `dt` that has ended: each body's
/// velocities are those in the middle of the kick by the damping found.
pub(super) fn take_in_losses(
    members: &mut [Member],
    movers: &[Mover],
    contact_pairs: &mut [IslandPair],
    dt: f64,
) {
    for member in &mut *members {
        member.taken.power = power_on_member(member);
        // None if damping gave energy, since that was made.
        let damped = (-member.taken.power * dt).max(0.0);
        let energy = &mut member.report.energy;
        energy.dissipated += member.taken.lost + damped;
        energy.pending = 0.5 * damped;
    }
    for island_pair in contact_pairs {
        island_pair.taken.power = power_in_pair(members, movers, island_pair);
        let damped = (-island_pair.taken.power * dt).max(0.0);
        halve(
            members,
            island_pair,
            island_pair.taken.lost + damped,
            |energy| &mut energy.dissipated,
        );
        halve(members, island_pair, 0.5 * damped, |energy| {
            &mut energy.pending
        });
    }
}

/// Power of the damping of walls on a body now [W].
fn power_on_member(member: &Member) -> f64 {
    let damping = &member.taken.damping;
    if *damping == Load::default() {
        return 0.0;
    }
    damping.power(&member.body.velocities())
}

/// Power of the damping in the contacts of two bodies now [W].
fn power_in_pair(members: &[Member], movers: &[Mover], island_pair: &IslandPair) -> f64 {
    let damping = &island_pair.taken.damping;
    if *damping == Load::default() {
        return 0.0;
    }
    let both = island_pair.sides.map(|side| body_of(members, movers, side));
    let exchange = Exchange::between(both, damping);
    let [first, second] = both.map(Body::velocities);
    exchange.on_first.power(&first) + exchange.on_second.power(&second)
}

/// Adds an energy of a contact pair to its free bodies: half to each of two.
fn halve(
    members: &mut [Member],
    island_pair: &IslandPair,
    energy: f64,
    of: fn(&mut EnergyReport) -> &mut f64,
) {
    let place = |side: Side| match side {
        Side::Member(place) => Some(place),
        Side::Barrier(_) | Side::Mover(_) => None,
    };
    let [first, second] = island_pair.sides.map(place);
    let share = if first.is_some() && second.is_some() {
        0.5
    } else {
        1.0
    };
    for place in [first, second].into_iter().flatten() {
        *of(&mut members[place].report.energy) += share * energy;
    }
}
