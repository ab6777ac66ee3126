//! Body sub-steps: bodies that may touch within a sub-step of the flow form an island and move
//! together (docs/method.md, equations 15, 20 and 48).

use crate::contact::body_body::{ContactPair, Contacts, Separation};
use crate::contact::body_wall::evaluate_wall_contacts;
use crate::contact::dissipation::Taken;
use crate::contact::law::ContactLaw;
use crate::math::Vec3;
use crate::method::METHOD;
use crate::motion::Velocities;
use crate::rigid::{Body, Load};
use crate::walls::{Impulse, Plane};
use rayon::prelude::*;

mod balance;
mod components;
mod flight;
mod in_touch;
mod member;
mod mover;
mod neighbours;
mod pace;
mod strides;
mod touching;

pub use balance::EnergyReport;
use components::islands;
use mover::Mover;
use neighbours::{Reaches, restore, states};
use pace::substeps;
pub use pace::substeps_ahead;
#[cfg(test)]
use pace::substeps_alone;
use strides::Strides;
use touching::{evaluate_body_contacts, find_contacts};

/// Report of one flow sub-step of a body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BodyReport {
    /// Impulse of the walls, about the origin.
    pub wall: Impulse,
    /// Impulse of fixed and prescribed bodies, about the origin.
    pub barrier: Impulse,
    /// Impulse of gravity, about the origin.
    pub gravity: Impulse,
    /// Mean force and torque of the walls.
    pub wall_load: Load,
    /// Mean force and torque of all other bodies.
    pub body_load: Load,
    /// Work that a prescribed motion did on other bodies [J].
    pub work: f64,
    /// Balance of its energy.
    pub energy: EnergyReport,
    /// Body sub-steps.
    pub substeps: u32,
    /// Body sub-steps that contacts and spin require; none are taken if they are more than
    /// the method's number.
    pub substeps_asked: f64,
    /// Share of the time in body sub-steps that ended in contact with a wall or another body.
    pub supported_share: f64,
    /// Upper bound of the path of any of its places [m].
    pub travelled: f64,
    /// Its deepest overlap with a wall or another body, over its sphero radius
    /// or that of the other if smaller.
    pub deepest_overlap_ratio: f64,
}

impl BodyReport {
    /// Adds an overlap over a sphero radius.
    fn overlap(&mut self, ratio: f64) {
        self.deepest_overlap_ratio = self.deepest_overlap_ratio.max(ratio);
    }
}

/// External conditions of the bodies' motion.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// The walls.
    pub planes: &'a [Plane],
    /// Gravity [m/s²].
    pub gravity: Vec3,
    /// Simulated time at the start [s].
    pub time: f64,
}

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
    islands
        .par_iter_mut()
        .for_each(|island| island.advance(around, dt));
    let mut movers = Vec::new();
    for island in islands {
        contact_pairs.extend(
            island
                .contact_pairs
                .into_iter()
                .map(|island_pair| island_pair.contact_pair),
        );
        movers.extend(island.movers);
    }
    contact_pairs.sort_unstable_by_key(|contact_pair| contact_pair.bodies);
    movers
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
        if is_free(body) {
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
    let mut contact_pairs: Vec<ContactPair> =
        pairs.iter().map(|pair| ContactPair::new(*pair)).collect();
    let mut reports = vec![BodyReport::default(); bodies.len()];
    let at_rest = |_| Load::default();
    for mut island in islands(
        bodies,
        &mut reports,
        std::mem::take(&mut contact_pairs),
        at_rest,
    ) {
        let Island {
            members,
            movers,
            contact_pairs: island_pair,
        } = &mut island;
        find_contacts(members, movers, island_pair, 0.0);
        evaluate_body_contacts(members, movers, island_pair, 0.0);
        contact_pairs.extend(
            island
                .contact_pairs
                .into_iter()
                .map(|island_pair| island_pair.contact_pair),
        );
    }
    contact_pairs.sort_unstable_by_key(|contact_pair| contact_pair.bodies);
    contact_pairs
}

/// Marks the bodies that the walls alone hold at the start: at rest, with loads that balance up
/// to this share of their weight.
pub fn hold(bodies: &mut [Body], gravity: &Vec3) {
    const BALANCED: f64 = 1e-6;
    for body in bodies.iter_mut().filter(|body| is_free(body)) {
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

fn is_free(body: &Body) -> bool {
    body.is_free()
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

/// Free bodies that move together.
#[derive(Default)]
struct Island<'a> {
    members: Vec<Member<'a>>,
    /// Bodies with a prescribed motion near them.
    movers: Vec<Mover>,
    contact_pairs: Vec<IslandPair<'a>>,
}

/// A free body of an island.
struct Member<'a> {
    body: &'a mut Body,
    report: &'a mut BodyReport,
    flow: Load,
    /// Position of its centre at the start of the flow's sub-step [m].
    start: Vec3,
    /// Mean velocities in the last half kick in which flow or bodies acted on it.
    mean: Velocities,
    /// Damping and losses of its contacts with walls in the last sub-step.
    taken: Taken,
    /// Shortest sub-steps over which it was in contact.
    supported: u32,
}

/// Two bodies of which at least one is a member.
struct IslandPair<'a> {
    contact_pair: ContactPair,
    law: ContactLaw,
    sides: [Side<'a>; 2],
    separation: Separation,
    /// Their contacts after the last drift.
    contacts: Contacts,
    /// Damping and losses of their contacts in the last sub-step.
    taken: Taken,
}

#[derive(Clone, Copy)]
enum Side<'a> {
    /// A member, by its place in the island.
    Member(usize),
    /// A fixed body.
    Barrier(&'a Body),
    /// A body with a prescribed motion, by its place among the island's.
    Mover(usize),
}

impl Island<'_> {
    fn advance(&mut self, around: &Surroundings, dt: f64) {
        let Self {
            members,
            movers,
            contact_pairs,
        } = self;
        if sleeps(members, movers, contact_pairs) {
            members.iter_mut().for_each(Member::sleep);
        } else {
            advance_together(members, movers, contact_pairs, around, dt);
        }
    }
}

/// True if an island sleeps: nothing has moved for a while and nothing from outside is near.
/// Contacts, momentum and all else stay as they are until another body comes near or a point
/// touches.
fn sleeps(members: &[Member], movers: &[Mover], contact_pairs: &[IslandPair]) -> bool {
    movers.iter().all(Mover::stands)
        && match members {
            [alone] => contact_pairs.is_empty() && alone.is_in_equilibrium(),
            many => many.iter().all(|member| {
                member.flow == Load::default() && member.body.state.still_for >= METHOD.sleep.after
            }),
        }
}

/// Velocity Verlet in sub-steps as short as the most demanding member requires, if possible; a
/// body with a non-finite speed requires no number of them. While nothing touches, or contacts
/// are weak, one sub-step is as long as several of these.
fn advance_together(
    members: &mut [Member],
    movers: &mut [Mover],
    contact_pairs: &mut [IslandPair],
    around: &Surroundings,
    dt: f64,
) {
    let asked = substeps(members, movers, contact_pairs, around, dt);
    for member in members.iter_mut() {
        member.report.substeps_asked = asked;
    }
    if asked.is_nan() || asked > METHOD.body_step.most {
        return;
    }
    let mut strides = Strides::new(dt / asked, asked as u32);
    balance::begin(members, contact_pairs);
    while strides.are_left() {
        let (stride, longer) = strides.next(members, movers, contact_pairs, around);
        balance::stretch(members, longer);
        let h = f64::from(stride) * strides.shortest;
        half_kick(members, movers, contact_pairs, around, 0.5 * h);
        for mover in movers.iter_mut() {
            mover.follow(around.time, f64::from(strides.done) * strides.shortest);
        }
        for member in members.iter_mut() {
            member.drift(h);
        }
        find_contacts(members, movers, contact_pairs, h);
        for member in members.iter_mut() {
            member.taken = evaluate_wall_contacts(member.body, around.planes, h);
        }
        evaluate_body_contacts(members, movers, contact_pairs, h);
        for mover in movers.iter_mut() {
            mover.take_in(h);
        }
        half_kick(members, movers, contact_pairs, around, 0.5 * h);
        balance::take_in_losses(members, movers, contact_pairs, h);
        for member in members.iter_mut() {
            member.count_substep(stride);
        }
    }
    balance::end(members, contact_pairs, &around.gravity);
    for member in members {
        let report = &mut *member.report;
        report.supported_share = f64::from(member.supported) / asked;
        for load in [&mut report.wall_load, &mut report.body_load] {
            load.force /= dt;
            load.torque /= dt;
        }
        member.watch_rest(dt);
    }
}

fn half_kick(
    members: &mut [Member],
    movers: &[Mover],
    contact_pairs: &[IslandPair],
    around: &Surroundings,
    dt: f64,
) {
    for member in members.iter_mut() {
        member.half_kick(&around.gravity, dt);
    }
    balance::take_in_work(members, movers, contact_pairs, dt);
}

fn body_of<'a>(members: &'a [Member], movers: &'a [Mover], side: Side<'a>) -> &'a Body {
    match side {
        Side::Member(place) => members[place].body,
        Side::Barrier(body) => body,
        Side::Mover(place) => &movers[place].body,
    }
}

#[cfg(test)]
mod tests;
