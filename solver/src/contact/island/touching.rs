//! Contacts of the bodies of an island, found and updated in a sub-step.

use super::member::Member;
use super::mover::Mover;
use super::pair::{IslandPair, Side, body_of};
use crate::rigid::{Body, Load, approach_bound};

/// All moving bodies of an island.
fn moving<'a>(
    members: &'a mut [Member],
    movers: &'a mut [Mover],
) -> impl Iterator<Item = &'a mut Body> {
    let members = members.iter_mut().map(|member| &mut *member.body);
    members.chain(movers.iter_mut().map(|mover| &mut mover.body))
}

/// Finds the contacts of bodies after a drift of `dt`, and counts the touching bodies of each.
pub(super) fn find_contacts(
    members: &mut [Member],
    movers: &mut [Mover],
    contact_pairs: &mut [IslandPair],
    dt: f64,
) {
    for body in moving(members, movers) {
        body.state.touching_bodies = 0;
        if !contact_pairs.is_empty() {
            body.turn_core();
        }
    }
    for island_pair in contact_pairs {
        let [first, second] = island_pair.sides.map(|side| body_of(members, movers, side));
        let approach = dt * approach_bound(first, second);
        if island_pair.separation.outlasts(approach) {
            island_pair.contacts.clear();
            continue;
        }
        island_pair.contact_pair.find(
            [first, second],
            &island_pair.law,
            &mut island_pair.separation,
            &mut island_pair.contacts,
        );
        if island_pair.contact_pair.touches() {
            let smaller = f64::min(first.shape.sphero_radius(), second.shape.sphero_radius());
            let ratio = island_pair.contact_pair.deepest / smaller;
            for side in island_pair.sides {
                match side {
                    Side::Member(place) => {
                        members[place].body.state.touching_bodies += 1;
                        members[place].report.overlap(ratio);
                    }
                    Side::Mover(place) => movers[place].body.state.touching_bodies += 1,
                    Side::Barrier(_) => {}
                }
            }
        }
    }
}

/// Updates the loads of bodies on each other after a drift of `dt`.
pub(super) fn evaluate_body_contacts(
    members: &mut [Member],
    movers: &mut [Mover],
    contact_pairs: &mut [IslandPair],
    dt: f64,
) {
    for body in moving(members, movers) {
        body.state.body_load = Load::default();
        body.state.barrier_load = Load::default();
    }
    for island_pair in contact_pairs {
        let both = island_pair.sides.map(|side| body_of(members, movers, side));
        island_pair.taken =
            island_pair
                .contact_pair
                .touch(both, &island_pair.law, &mut island_pair.contacts, dt);
        if island_pair.contact_pair.touches() {
            let exchange = island_pair.contact_pair.exchange(both);
            let [one, other] = island_pair.sides;
            take(members, movers, [one, other], &exchange.on_first);
            take(members, movers, [other, one], &exchange.on_second);
        }
    }
}

/// Adds the load of the second side on the first.
fn take(members: &mut [Member], movers: &mut [Mover], [to, from]: [Side; 2], load: &Load) {
    let state = match to {
        Side::Member(place) => &mut members[place].body.state,
        Side::Mover(place) => &mut movers[place].body.state,
        Side::Barrier(_) => return,
    };
    match from {
        Side::Member(_) => state.body_load.add(load),
        Side::Barrier(_) | Side::Mover(_) => state.barrier_load.add(load),
    }
}
