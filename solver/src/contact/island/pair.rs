//! Contact pair of an island, and the bodies at its two sides.

use super::member::Member;
use super::mover::Mover;
use crate::contact::body_body::{ContactPair, Contacts, Separation};
use crate::contact::dissipation::Taken;
use crate::contact::law::ContactLaw;
use crate::rigid::Body;

/// Two bodies of which at least one is a member.
pub(super) struct IslandPair<'a> {
    pub(super) contact_pair: ContactPair,
    pub(super) law: ContactLaw,
    pub(super) sides: [Side<'a>; 2],
    pub(super) separation: Separation,
    /// Their contacts after the last drift.
    pub(super) contacts: Contacts,
    /// Damping and losses of their contacts in the last sub-step.
    pub(super) taken: Taken,
}

#[derive(Clone, Copy)]
pub(super) enum Side<'a> {
    /// A member, by its place in the island.
    Member(usize),
    /// A fixed body.
    Barrier(&'a Body),
    /// A body with a prescribed motion, by its place among the island's.
    Mover(usize),
}

/// Body at a side of a contact pair.
pub(super) fn body_of<'a>(members: &'a [Member], movers: &'a [Mover], side: Side<'a>) -> &'a Body {
    match side {
        Side::Member(place) => members[place].body,
        Side::Barrier(body) => body,
        Side::Mover(place) => &movers[place].body,
    }
}
