//! Body sub-steps: bodies that may touch within a sub-step of the flow form an island and move
//! together (docs/method.md, equations 15, 20 and 48).

use crate::contact::body_body::ContactPair;
use crate::math::Vec3;
use crate::rigid::{Body, Load};
use rayon::prelude::*;

mod balance;
mod components;
mod flight;
mod in_touch;
mod integration;
mod member;
mod mover;
mod neighbours;
mod pace;
mod pair;
mod report;
mod strides;
mod surroundings;
mod touching;

use components::{Island, islands};
use integration::advance_together;
use member::Member;
use mover::Mover;
use neighbours::{Reaches, restore, states};
pub use pace::{substeps_ahead, substeps_at_rest};
pub use report::{BodyReport, EnergyReport};
pub use surroundings::Surroundings;
use touching::{evaluate_body_contacts, find_contacts};

/// Advances all bodies by `dt` under a constant load of the flow each (force, and torque about
/// the centre at the start), gravity, walls and each other. `contact_pairs` are the contact
/// histories of the pairs that may touch, in order. If a body that was struck travelled so far
/// that it may have met another one unseen, all is computed again with that pair.
pub fn advance(
    bodies: &mut [Body],
    contact_pairs: &mut Vec<ContactPair>,
    reports: &mut [BodyReport],
    flow: impl Fn(usize) -> Load + Sync,
    around: &Surroundings,
    dt: f64,
) {
    let acceleration =
        |place: usize| bodies[place].largest_acceleration(&around.gravity, &flow(place));
    let mut reaches = Reaches::within(bodies, acceleration, dt);
    reaches.extend_to_struck(bodies);
    let mut pairs = reaches.pairs(bodies);
    let start = (bodies.len() > 1).then(|| (states(bodies), contact_pairs.clone()));
    let movers = loop {
        renew(contact_pairs, &pairs);
        let movers = advance_islands(bodies, contact_pairs, reports, &flow, around, dt);
        let Some((at_start, histories)) = &start else {
            break movers;
        };
        if !reaches.extend_to_travelled(reports) {
            break movers;
        }
        let end = states(bodies);
        restore(bodies, at_start);
        let further = reaches.pairs(bodies);
        if further.len() == pairs.len() {
            restore(bodies, &end);
            break movers;
        }
        pairs = further;
        contact_pairs.clone_from(histories);
    };
    follow_motions(bodies, around.time, dt);
    for mover in movers {
        let place = mover.place;
        mover.hand_over(&mut bodies[place], &mut reports[place], dt);
    }
}

/// Advances the islands that these pairs make of the bodies; returns the bodies with a prescribed
/// motion near them.
fn advance_islands(
    bodies: &mut [Body],
    contact_pairs: &mut Vec<ContactPair>,
    reports: &mut [BodyReport],
    flow: &(impl Fn(usize) -> Load + Sync),
    around: &Surroundings,
    dt: f64,
) -> Vec<Mover> {
    if contact_pairs.is_empty() {
        advance_apart(bodies, reports, flow, around, dt);
        return Vec::new();
    }
    let mut islands = islands(bodies, reports, std::mem::take(contact_pairs), flow);
    // One by one: those awake cost a thousand times what those asleep do, and may all come first.
    islands
        .par_iter_mut()
        .with_max_len(1)
        .for_each(|island| island.advance(around, dt));
    let (histories, movers) = dissolved(islands);
    *contact_pairs = histories;
    movers
}

/// Contact histories of all islands, in order, and the bodies with a prescribed motion near them.
fn dissolved(islands: Vec<Island>) -> (Vec<ContactPair>, Vec<Mover>) {
    let (mut histories, mut movers) = (Vec::new(), Vec::new());
    for island in islands {
        let of_island = island.contact_pairs.into_iter();
        histories.extend(of_island.map(|island_pair| island_pair.contact_pair));
        movers.extend(island.movers);
    }
    histories.sort_unstable_by_key(|contact_pair| contact_pair.bodies);
    (histories, movers)
}

/// Moves the bodies whose motion is prescribed.
fn follow_motions(bodies: &mut [Body], time: f64, dt: f64) {
    for body in bodies.iter_mut().filter(|body| body.prescribed().is_some()) {
        body.state.touching_bodies = 0;
        body.follow(time, time + dt);
    }
}

/// Advances bodies none of which is near another: each is an island, with no allocations.
fn advance_apart(
    bodies: &mut [Body],
    reports: &mut [BodyReport],
    flow: impl Fn(usize) -> Load + Sync,
    around: &Surroundings,
    dt: f64,
) {
    let pairs = bodies.par_iter_mut().zip(reports).enumerate();
    pairs.for_each(|(place, (body, report))| {
        *report = BodyReport::default();
        if body.is_free() {
            let mut alone = Member::new(body, report, flow(place));
            if alone.is_in_equilibrium() {
                alone.sleep();
            } else {
                advance_together(
                    std::slice::from_mut(&mut alone),
                    &mut [],
                    &mut [],
                    around,
                    dt,
                );
            }
        }
    });
}

/// Finds the contacts at the start, before anything moved.
pub fn meet(bodies: &mut [Body]) -> Vec<ContactPair> {
    let pairs = Reaches::within(bodies, |_| 0.0, 0.0).pairs(bodies);
    let contact_pairs = pairs.into_iter().map(ContactPair::new).collect();
    let mut reports = vec![BodyReport::default(); bodies.len()];
    let mut islands = islands(bodies, &mut reports, contact_pairs, |_| Load::default());
    for Island {
        members,
        movers,
        contact_pairs,
    } in &mut islands
    {
        find_contacts(members, movers, contact_pairs, 0.0);
        evaluate_body_contacts(members, movers, contact_pairs, 0.0);
    }
    dissolved(islands).0
}

/// Marks the bodies that the walls alone hold at the start: at rest, with loads that balance up
/// to this share of their weight.
pub fn hold(bodies: &mut [Body], gravity: &Vec3) {
    const BALANCED: f64 = 1e-6;
    for body in bodies.iter_mut().filter(|body| body.is_free()) {
        let weight = body.mass * gravity.norm();
        let (force, torque) = (body.state.wall_load.force, body.state.wall_load.torque);
        let off = (force + gravity * body.mass).norm();
        let turned = torque.norm() / body.shape.bounding_radius();
        let touched = body.state.touching_bodies > 0;
        if body.largest_speed() == 0.0 && off.max(turned) <= BALANCED * weight && !touched {
            body.state.still_for = f64::INFINITY;
        }
    }
}

/// Keeps the histories of the pairs that are still near, and begins those of the others. Both
/// lists are in order.
fn renew(contact_pairs: &mut Vec<ContactPair>, pairs: &[[usize; 2]]) {
    let mut before = std::mem::take(contact_pairs).into_iter().peekable();
    contact_pairs.extend(pairs.iter().map(|&pair| {
        while before
            .next_if(|contact_pair| contact_pair.bodies < pair)
            .is_some()
        {}
        before
            .next_if(|contact_pair| contact_pair.bodies == pair)
            .unwrap_or_else(|| ContactPair::new(pair))
    }));
}

#[cfg(test)]
mod tests;
