//! Samples of a study's members.

use crate::outcome::{Finished, Member};
use crate::study::Ensemble;
use std::collections::BTreeMap;

/// Sample of a quantity: its value in every member that counts for probabilities.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
    /// Values, in the order of the members.
    pub values: Vec<f64>,
    /// Number of members without a known value.
    pub unknown: u64,
}

/// Sample of a body's resting places.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RestingPlaces {
    /// Places, downstream and across [m], in the order of the members.
    pub places_m: Vec<[f64; 2]>,
    /// Number of members whose run ended with the body still moving.
    pub moving: u64,
    /// Number of members without a known place, those with a moving body among them.
    pub unknown: u64,
}

impl Sample {
    /// Sample of a quantity, of a body or of the whole run.
    pub fn of(ensemble: &Ensemble, members: &[Member], name: &str, body: Option<usize>) -> Self {
        let known = by_index(members, |finished| finished.quantity(name, body));
        let (values, unknown) = draws(ensemble, &known);
        Self { values, unknown }
    }
}

impl RestingPlaces {
    /// Resting places of a body.
    pub fn of(ensemble: &Ensemble, members: &[Member], body: usize) -> Self {
        let known = by_index(members, |finished| {
            finished.bodies.get(body)?.resting_place()
        });
        let moves = by_index(members, |finished| {
            finished.bodies.get(body).filter(|body| body.moving)
        });
        let (places_m, unknown) = draws(ensemble, &known);
        Self {
            places_m,
            moving: draws(ensemble, &moves).0.len() as u64,
            unknown,
        }
    }
}

/// Something of each finished member that has it, by the member's index.
pub(super) fn by_index<'a, T>(
    members: &'a [Member],
    found: impl Fn(&'a Finished) -> Option<T>,
) -> BTreeMap<u64, T> {
    let of_one = |member: &'a Member| Some((member.index, found(member.finished()?)?));
    members.iter().filter_map(of_one).collect()
}

/// What is known of the members that are draws, and the number of draws without it.
fn draws<T: Clone>(ensemble: &Ensemble, known: &BTreeMap<u64, T>) -> (Vec<T>, u64) {
    let (design, inputs) = (&ensemble.study().design, ensemble.inputs());
    let draws = (0..ensemble.members()).filter(|index| design.is_draw(*index, inputs));
    let found: Vec<Option<&T>> = draws.map(|index| known.get(&index)).collect();
    let unknown = found.iter().filter(|one| one.is_none()).count();
    (
        found.into_iter().flatten().cloned().collect(),
        unknown as u64,
    )
}
