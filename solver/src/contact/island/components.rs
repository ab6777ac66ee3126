//! Division of the bodies into islands, with the fixed and prescribed bodies round them.

use super::member::Member;
use super::mover::Mover;
use super::pair::{IslandPair, Side};
use super::report::BodyReport;
use crate::contact::body_body::{ContactPair, Contacts, Separation, pair_law};
use crate::contact::dissipation::Taken;
use crate::contact::law::ContactLaw;
use crate::rigid::{Body, Load};

/// Free bodies that move together.
#[derive(Default)]
pub(super) struct Island<'a> {
    pub(super) members: Vec<Member<'a>>,
    /// Bodies with a prescribed motion near them.
    pub(super) movers: Vec<Mover>,
    pub(super) contact_pairs: Vec<IslandPair<'a>>,
}

/// Place of a body while the islands are made.
#[derive(Clone, Copy)]
enum Seat<'a> {
    /// In an island, at a place among its members.
    Island(usize, usize),
    /// Outside all islands: loads do not move it.
    Outside(&'a Body),
}

/// Divides the bodies into islands; the order depends on the bodies alone.
pub(super) fn islands<'a>(
    bodies: &'a mut [Body],
    reports: &'a mut [BodyReport],
    contact_pairs: Vec<ContactPair>,
    flow: impl Fn(usize) -> Load,
) -> Vec<Island<'a>> {
    let laws: Vec<ContactLaw> = contact_pairs
        .iter()
        .map(|contact_pair| {
            pair_law(
                &bodies[contact_pair.bodies[0]],
                &bodies[contact_pair.bodies[1]],
            )
        })
        .collect();
    let pairs: Vec<[usize; 2]> = contact_pairs.iter().map(|pair| pair.bodies).collect();
    let roots = roots(bodies, &pairs);
    let mut islands: Vec<Island> = Vec::new();
    let mut seats: Vec<Seat> = Vec::with_capacity(bodies.len());
    for (place, (body, report)) in bodies.iter_mut().zip(reports).enumerate() {
        *report = BodyReport::default();
        if !body.is_free() {
            body.turn_core_anew();
            seats.push(Seat::Outside(body));
            continue;
        }
        let island = match seats.get(roots[place]) {
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
    for (contact_pair, law) in contact_pairs.into_iter().zip(laws) {
        let inside = contact_pair
            .bodies
            .iter()
            .find_map(|&place| match seats[place] {
                Seat::Island(island, _) => Some(island),
                Seat::Outside(_) => None,
            });
        if let Some(island) = inside {
            let island = &mut islands[island];
            let sides = contact_pair
                .bodies
                .map(|place| island.side(place, seats[place]));
            island.contact_pairs.push(IslandPair {
                contact_pair,
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

/// Per body the first of its connected component.
fn roots(bodies: &[Body], pairs: &[[usize; 2]]) -> Vec<usize> {
    fn root_of(roots: &[usize], mut place: usize) -> usize {
        while roots[place] != place {
            place = roots[place];
        }
        place
    }
    let mut roots: Vec<usize> = (0..bodies.len()).collect();
    for pair in pairs {
        if pair.iter().all(|&place| bodies[place].is_free()) {
            let [a, b] = pair.map(|place| root_of(&roots, place));
            roots[a.max(b)] = a.min(b);
        }
    }
    (0..bodies.len())
        .map(|place| root_of(&roots, place))
        .collect()
}

impl<'a> Island<'a> {
    /// One of the two sides of a contact pair.
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
