//! First-order indices from any random members.

use super::regression::Regression;
use crate::answers::Estimate;
use crate::moments;
use crate::study::Ensemble;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Fewest members behind an index.
const FEWEST: usize = 20;

/// First-order indices of a quantity from random members.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FirstOrderIndices {
    /// Indices of the inputs, in their order.
    pub inputs: Vec<FirstOrderIndex>,
    /// Members with the quantity.
    pub members: u64,
    /// Members left out because they lack it.
    pub members_left_out: u64,
}

/// First-order index of one input: the share of the variance that it explains alone. With
/// correlated inputs it has what they explain through it too.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FirstOrderIndex {
    /// Index, with shifted bootstrap percentiles.
    pub first_order: Estimate,
    /// Number of classes that the values were cut into.
    pub classes: u64,
}

impl FirstOrderIndices {
    /// Indices from the known members; none of too few or if the quantity does not vary.
    pub(super) fn of(ensemble: &Ensemble, known: &BTreeMap<u64, f64>) -> Option<Self> {
        let member =
            |(index, quantity): (&u64, &f64)| Some((ensemble.values(*index).ok()?, *quantity));
        let members: Vec<(Vec<Value>, f64)> = known.iter().filter_map(member).collect();
        let quantities: Vec<f64> = members.iter().map(|(_, quantity)| *quantity).collect();
        if members.len() < FEWEST || moments::variance(&quantities) <= 0.0 {
            return None;
        }
        let of_one = |input: usize| {
            let values: Vec<&Value> = members.iter().map(|(values, _)| &values[input]).collect();
            FirstOrderIndex::of(&numbered(&values), &quantities)
        };
        Some(Self {
            inputs: (0..ensemble.inputs()).map(of_one).collect(),
            members: members.len() as u64,
            members_left_out: ensemble.members() - members.len() as u64,
        })
    }
}

impl FirstOrderIndex {
    /// Index of an input: share of the variance that a regression on its values explains.
    fn of(values: &[f64], quantities: &[f64]) -> Self {
        let regression = Regression::on(values);
        let index = |drawn: &[usize]| regression.drawn(drawn).explained(quantities);
        Self {
            first_order: Estimate::shifted_percentile(values.len(), &index),
            classes: regression.classes() as u64,
        }
    }
}

/// Values as numbers: as they are, or if one is no number the place of the first equal one.
fn numbered(values: &[&Value]) -> Vec<f64> {
    let numbers: Option<Vec<f64>> = values.iter().map(|value| value.as_f64()).collect();
    let place = |value: &&Value| values.iter().position(|one| one == value);
    let places = || values.iter().map(|value| place(value).unwrap_or(0) as f64);
    numbers.unwrap_or_else(|| places().collect())
}
