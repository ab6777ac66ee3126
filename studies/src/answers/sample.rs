//! Samples of a study's members.

use crate::moments;
use crate::multilevel::{Corrected, Known, LevelMeans};
use crate::outcome::{Finished, Member};
use crate::study::Ensemble;
use std::collections::BTreeMap;

/// Sample of a quantity: its value in every member that counts for probabilities, on the finest
/// level.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
    /// Values, in the order of the members.
    pub values: Vec<f64>,
    /// Number of members without a known value.
    pub unknown: u64,
    /// Errors that the members' number does not tell; none of a study on one level.
    pub levels: Option<LevelError>,
}

/// Errors of a quantity known from several levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelError {
    /// Number of independent draws on the finest level whose mean has the same sampling variance.
    pub draws: f64,
    /// Half width of what the cells of the finest level may shift the quantity by, in its unit.
    pub numerical: f64,
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
    /// Errors downstream and across that the members' number does not tell; none of a study on one
    /// level.
    pub levels: Option<[LevelError; 2]>,
}

impl Sample {
    /// Sample of a quantity, of a body or of the whole run.
    pub fn of(ensemble: &Ensemble, members: &[Member], name: &str, body: Option<usize>) -> Self {
        let known = Known::of_quantity(ensemble, members, (name, body));
        let corrected = Corrected::of(&known);
        Self {
            levels: level_errors(&known).map(|[error]| error),
            values: corrected
                .values
                .into_values()
                .map(|[value]| value)
                .collect(),
            unknown: corrected.unknown,
        }
    }
}

/// Smallest share of the members, and fewest, that have a value exactly which the size of the cells
/// does not shift: it is one that a quantity can't be below or above, or yes or no.
const LEAST_SHARE: f64 = 0.02;
const FEWEST: usize = 5;

impl Sample {
    /// Values in ascending order, shifted but for those that many members have exactly, such as the
    /// depth 0 of bodies on the surface.
    pub(super) fn shifted(&self, by: f64) -> Vec<f64> {
        let least = FEWEST.max((LEAST_SHARE * self.values.len() as f64).ceil() as usize);
        let mut values = moments::sorted(&self.values);
        for equal in values.chunk_by_mut(|one, other| one == other) {
            if equal.len() < least {
                for value in equal {
                    *value += by;
                }
            }
        }
        values
    }
}

impl RestingPlaces {
    /// Resting places of a body.
    pub fn of(ensemble: &Ensemble, members: &[Member], body: usize) -> Self {
        let known = Known::of(ensemble, members, |finished| {
            finished.bodies.get(body)?.resting_place()
        });
        let corrected = Corrected::of(&known);
        Self {
            levels: level_errors(&known),
            places_m: corrected.values.into_values().collect(),
            moving: moving(ensemble, members, (body, known.finest())),
            unknown: corrected.unknown,
        }
    }
}

/// A quantity on the finest level by the index of the draw.
pub(super) fn on_finest_level(
    ensemble: &Ensemble,
    members: &[Member],
    quantity: (&str, Option<usize>),
) -> BTreeMap<u64, f64> {
    let corrected = Corrected::of(&Known::of_quantity(ensemble, members, quantity));
    let values = corrected.values.into_iter();
    values.map(|(index, [value])| (index, value)).collect()
}

/// Number of draws whose finest run up to a level ended with the body still moving.
fn moving(ensemble: &Ensemble, members: &[Member], (body, finest): (usize, usize)) -> u64 {
    let known = Known::of(ensemble, members, |finished| {
        let is_moving = finished.bodies.get(body)?.moving;
        is_moving.then_some([1.0])
    });
    let draws = known.draws().iter();
    let moves = draws.filter(|index| matches!(known.best(**index, finest), Some((_, Some(_)))));
    moves.count() as u64
}

/// Errors along each axis; none of a study on one level, or of too few pairs.
fn level_errors<const D: usize>(known: &Known<D>) -> Option<[LevelError; D]> {
    if known.finest() == 0 {
        return None;
    }
    let means = LevelMeans::of(known)?;
    Some(std::array::from_fn(|axis| LevelError {
        draws: means.draws(axis),
        numerical: means.error(axis).numerical.unwrap_or(0.0),
    }))
}

/// Something of each finished member that has it on level 0, by the member's index.
pub(super) fn by_index<'a, T>(
    members: &'a [Member],
    found: impl Fn(&'a Finished) -> Option<T>,
) -> BTreeMap<u64, T> {
    let coarsest = members.iter().filter(|member| member.level == 0);
    let of_one = |member: &'a Member| Some((member.index, found(member.finished()?)?));
    coarsest.filter_map(of_one).collect()
}
