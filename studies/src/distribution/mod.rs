//! Distributions of the inputs.

mod discrete;
mod lognormal;
mod normal;
mod triangular;
mod uniform;

pub use discrete::{Choice, List, WeightedValue};
pub use lognormal::Lognormal;
pub use normal::{Interval, Normal};
pub use triangular::Triangular;
pub use uniform::Uniform;

use crate::study::Violation;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Smallest probability a design produces, half a step of the Sobol' points, 2⁻²⁴; the largest is
/// one minus it. An unbounded distribution ends at these quantiles, 5.3 standard deviations from
/// the mean of a normal one.
pub const SMALLEST_PROBABILITY: f64 = 1.0 / (1_u64 << 24) as f64;

/// Distribution of one input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Every number of a range equally likely.
    Uniform(Uniform),
    /// Normal, perhaps truncated.
    Normal(Normal),
    /// Normal logarithm.
    Lognormal(Lognormal),
    /// Density a triangle.
    Triangular(Triangular),
    /// Any JSON values with weights.
    Choice(Choice),
    /// Numbers that are equally likely.
    List(List),
}

impl Distribution {
    /// Quantile at a probability 0 < u < 1, as the JSON value that the scenario gets.
    pub fn quantile(&self, probability: f64) -> Value {
        match self {
            Self::Uniform(uniform) => uniform.quantile(probability).into(),
            Self::Normal(normal) => normal.quantile(probability).into(),
            Self::Lognormal(lognormal) => lognormal.quantile(probability).into(),
            Self::Triangular(triangular) => triangular.quantile(probability).into(),
            Self::Choice(choice) => choice.quantile(probability),
            Self::List(list) => list.quantile(probability),
        }
    }

    /// Quantile at a probability 0 < u < 1 as a number; none where the value is no number.
    pub fn number(&self, probability: f64) -> Option<f64> {
        self.quantile(probability).as_f64()
    }

    /// Extreme values that a member can have, for validation: both ends of a bounded range, the
    /// quantiles at [`SMALLEST_PROBABILITY`] and one minus it of an unbounded one, every value of
    /// a choice or list.
    pub fn ends(&self) -> Vec<Value> {
        match self {
            Self::Choice(choice) => choice.values.iter().map(|one| one.value.clone()).collect(),
            Self::List(list) => list.values.iter().cloned().map(Value::Number).collect(),
            Self::Uniform(uniform) => vec![uniform.from.into(), uniform.to.into()],
            Self::Triangular(triangular) => vec![triangular.from.into(), triangular.to.into()],
            Self::Normal(Normal {
                truncate: Some(range),
                ..
            }) => vec![range.from.into(), range.to.into()],
            Self::Normal(_) | Self::Lognormal(_) => {
                let ends = [SMALLEST_PROBABILITY, 1.0 - SMALLEST_PROBABILITY];
                ends.map(|end| self.quantile(end)).to_vec()
            }
        }
    }

    /// Mean; none where a value is no number.
    pub fn mean(&self) -> Option<f64> {
        match self {
            Self::Uniform(uniform) => Some(0.5 * (uniform.from + uniform.to)),
            Self::Normal(normal) => Some(normal.mean()),
            Self::Lognormal(lognormal) => Some(lognormal.mean()),
            Self::Triangular(triangular) => Some(triangular.mean()),
            Self::Choice(choice) => choice.mean(),
            Self::List(list) => list.mean(),
        }
    }

    /// True if every value is a number, so that the input can be correlated with others.
    pub fn is_numeric(&self) -> bool {
        match self {
            Self::Choice(choice) => choice.values.iter().all(|one| one.value.is_number()),
            _ => true,
        }
    }

    /// All that is wrong with the distribution; each pointer begins at the distribution.
    pub fn violations(&self) -> Vec<Violation> {
        let (key, found) = match self {
            Self::Uniform(uniform) => ("uniform", uniform.violations()),
            Self::Normal(normal) => ("normal", normal.violations()),
            Self::Lognormal(lognormal) => ("lognormal", lognormal.violations()),
            Self::Triangular(triangular) => ("triangular", triangular.violations()),
            Self::Choice(choice) => ("choice", choice.violations()),
            Self::List(list) => ("list", list.violations()),
        };
        Violation::under(&format!("/{key}"), found)
    }
}
