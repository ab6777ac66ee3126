//! Bodies divided into islands: which hang together, and what stands round them.

use super::mover::Mover;
use super::{BodyReport, Island, Member, Met, Side, is_free};
use crate::contact::body_body::{Contacts, Meeting, Separation, pair_law};
use crate::contact::dissipation::Taken;
use crate::contact::law::ContactLaw;
use crate::rigid::{Body, Load};

/// Place of a body when the islands are made.
#[derive(Clone, Copy)]
enum Seat<'a> {
    /// In an island, at a place among its members.
    Island(usize, usize),
    /// In none: loads do not move it.
    Outside(&'a Body),
}

/// Divides the bodies into islands; the order follows from the bodies alone.
pub(super) fn islands<'a>(
    bodies: &'a mut [Body],
    reports: &'a mut [BodyReport],
    meetings: Vec<Meeting>,
    flow: impl Fn(usize) -> Load,
) -> Vec<Island<'a>> {
    let laws: Vec<ContactLaw> = meetings
        .iter()
        .map(|meeting| pair_law(&bodies[meeting.bodies[0]], &bodies[meeting.bodies[1]]))
        .collect();
    let heads = heads(bodies, &meetings);
    let mut islands: Vec<Island> = Vec::new();
    let mut seats: Vec<Seat> = Vec::with_capacity(bodies.len());
    for (place, (body, report)) in bodies.iter_mut().zip(reports).enumerate() {
        *report = BodyReport::default();
        if !is_free(body) {
            seats.push(Seat::Outside(body));
            continue;
        }
        let island = match seats.get(heads[place]) {
            Some(Seat::Island(island, _)) => *island,
            _ => {
                islands.push(Island::default());
                islands.len() - 1
            }
        };
        let members = &mut islands[island].members;
        seats.push(Seat::Island(island, members.len()));
        members.push(Member::new(body, report, flow(place)));
    }
    for (meeting, law) in meetings.into_iter().zip(laws) {
        let inside = meeting.bodies.iter().find_map(|&place| match seats[place] {
            Seat::Island(island, _) => Some(island),
            Seat::Outside(_) => None,
        });
        if let Some(island) = inside {
            let island = &mut islands[island];
            let sides = meeting.bodies.map(|place| island.side(place, seats[place]));
            island.meetings.push(Met {
                meeting,
                law,
                sides,
                separation: Separation::default(),
                contacts: Contacts::default(),
                taken: Taken::default(),
            });
        }
    }
    islands
}

/// Per body the first of those it hangs together with.
fn heads(bodies: &[Body], meetings: &[Meeting]) -> Vec<usize> {
    fn head_of(heads: &[usize], mut place: usize) -> usize {
        while heads[place] != place {
            place = heads[place];
        }
        place
    }
    let mut heads: Vec<usize> = (0..bodies.len()).collect();
    for meeting in meetings {
        if meeting.bodies.iter().all(|&place| is_free(&bodies[place])) {
            let [a, b] = meeting.bodies.map(|place| head_of(&heads, place));
            heads[a.max(b)] = a.min(b);
        }
    }
    (0..bodies.len())
        .map(|place| head_of(&heads, place))
        .collect()
}

impl<'a> Island<'a> {
    /// One of the two sides of a meeting.
    fn side(&mut self, place: usize, seat: Seat<'a>) -> Side<'a> {
        match seat {
            Seat::Island(_, member) => Side::Member(member),
            Seat::Outside(body) if body.prescribed().is_none() => Side::Barrier(body),
            Seat::Outside(body) => {
                let known = self.movers.iter().position(|mover| mover.place == place);
                Side::Mover(known.unwrap_or_else(|| {
                    self.movers.push(Mover::new(place, body));
                    self.movers.len() - 1
                }))
            }
        }
    }
}
