//! Integration of an island's motion over a sub-step of the flow: velocity Verlet
//! (docs/method.md, equations 15 and 20).

use super::balance::{self, Lengths};
use super::components::Island;
use super::member::Member;
use super::mover::Mover;
use super::pace::substeps;
use super::pair::IslandPair;
use super::strides::Strides;
use super::surroundings::Surroundings;
use super::touching::{evaluate_body_contacts, find_contacts};
use crate::contact::body_wall::evaluate_wall_contacts;
use crate::method::METHOD;
use crate::rigid::Load;

impl Island<'_> {
    /// Advances it by `dt`, unless it sleeps.
    pub(super) fn advance(&mut self, around: &Surroundings, dt: f64) {
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
pub(super) fn advance_together(
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
        if around.is_cancelled() {
            return;
        }
        let before = strides.before();
        let stride = strides.next(members, movers, contact_pairs, around);
        let h = f64::from(stride) * strides.shortest;
        half_kick(members, movers, contact_pairs, around, 0.5 * h);
        if let Some(before) = before.filter(|before| *before != h) {
            let lengths = Lengths { before, now: h };
            balance::correct_losses(members, movers, contact_pairs, lengths);
        }
        for mover in movers.iter_mut() {
            mover.follow(around.time, f64::from(strides.done) * strides.shortest);
        }
        for member in members.iter_mut() {
            member.drift(h);
        }
        find_contacts(members, movers, contact_pairs, h);
        for member in members.iter_mut() {
            member.taken = evaluate_wall_contacts(member.body, &around.walls, h);
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
