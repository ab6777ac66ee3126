//! Discrete distributions: a choice among weighted values, and a list of equally likely numbers.

use crate::study::Violation;
use serde::{Deserialize, Serialize};
use serde_json::{Number, Value};

/// Choice among values with weights.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = ChoiceDistribution))]
#[serde(deny_unknown_fields)]
pub struct Choice {
    /// Values, at least one.
    pub values: Vec<WeightedValue>,
}

/// Value of a choice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct WeightedValue {
    /// Any JSON value that the scenario may have at the input's place.
    pub value: Value,
    /// Weight, positive; its share of the sum of the weights is the probability.
    pub weight: f64,
}

/// List of equally likely numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = ListDistribution))]
#[serde(deny_unknown_fields)]
pub struct List {
    /// Numbers, at least one.
    #[cfg_attr(feature = "schema", schema(value_type = Vec<f64>))]
    pub values: Vec<Number>,
}

impl Choice {
    /// Value up to which the weights of the list add up to more than the probability; null of no
    /// value, which is a violation.
    pub(super) fn quantile(&self, probability: f64) -> Value {
        let mut left = probability * self.weight();
        let exceeded = self.values.iter().find(|one| {
            left -= one.weight;
            left < 0.0
        });
        let found = exceeded.or(self.values.last());
        found.map_or(Value::Null, |one| one.value.clone())
    }

    pub(super) fn mean(&self) -> Option<f64> {
        let part = |one: &WeightedValue| Some(one.weight * one.value.as_f64()?);
        let sum = self.values.iter().map(part).sum::<Option<f64>>()?;
        Some(sum / self.weight())
    }

    fn weight(&self) -> f64 {
        self.values.iter().map(|one| one.weight).sum()
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        if self.values.is_empty() {
            return vec![no_values()];
        }
        let wrong = |(place, one): (usize, &WeightedValue)| {
            let right = one.weight > 0.0 && one.weight.is_finite();
            let pointer = format!("/values/{place}/weight");
            (!right).then(|| Violation::of(&pointer, one.weight, "x > 0"))
        };
        self.values.iter().enumerate().filter_map(wrong).collect()
    }
}

impl List {
    /// Number at the place ⌊u n⌋; null of no number, which is a violation.
    pub(super) fn quantile(&self, probability: f64) -> Value {
        let place = (probability * self.values.len() as f64) as usize;
        let found = self.values.get(place).or(self.values.last());
        found.map_or(Value::Null, |number| Value::Number(number.clone()))
    }

    pub(super) fn mean(&self) -> Option<f64> {
        let sum = self
            .values
            .iter()
            .map(Number::as_f64)
            .sum::<Option<f64>>()?;
        Some(sum / self.values.len() as f64)
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        if self.values.is_empty() {
            return vec![no_values()];
        }
        Vec::new()
    }
}

fn no_values() -> Violation {
    Violation::new("/values", "values is empty, allowed: at least one value")
}
