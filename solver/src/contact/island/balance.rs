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

/// Scales the pending dissipation: the next sub-step is so many times longer than the one
/// before, and so is the kick in which the damping found there acts.
pub(super) fn stretch(members: &mut [Member], longer: f64) {
    for member in members {
        let energy = &mut member.report.energy;
        energy.dissipated += energy.pending * (longer - 1.0);
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
    contact_pairs: &[IslandPair],
    dt: f64,
) {
    for member in &mut *members {
        let power = |damping: &Load| damping.power(&member.body.velocities());
        let damped = damped(&member.taken, power, dt);
        let energy = &mut member.report.energy;
        energy.dissipated += member.taken.lost + damped;
        energy.pending = 0.5 * damped;
    }
    for island_pair in contact_pairs {
        let both = island_pair.sides.map(|side| body_of(members, movers, side));
        let power = |damping: &Load| {
            let exchange = Exchange::between(both, damping);
            let [first, second] = both.map(Body::velocities);
            exchange.on_first.power(&first) + exchange.on_second.power(&second)
        };
        let damped = damped(&island_pair.taken, power, dt);
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

/// Energy dissipated by damping: none if damping gave energy, since that was made.
fn damped(taken: &Taken, power: impl Fn(&Load) -> f64, dt: f64) -> f64 {
    if taken.damping == Load::default() {
        0.0
    } else {
        (-power(&taken.damping) * dt).max(0.0)
    }
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
