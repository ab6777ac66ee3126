//! Uniform distribution.

use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Uniform distribution over a range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = UniformDistribution))]
#[serde(deny_unknown_fields)]
pub struct Uniform {
    /// Smallest value, in the unit of the input.
    pub from: f64,
    /// Largest value, above `from`.
    pub to: f64,
}

impl Uniform {
    /// Quantile from + u (to − from).
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        let value = self.from + probability * (self.to - self.from);
        value.clamp(self.from, self.to)
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        range_violations(self.from, self.to)
    }
}

/// Violations of a range from..to, which needs finite ends, the second above the first, and a
/// finite length.
pub(super) fn range_violations(from: f64, to: f64) -> Vec<Violation> {
    if !from.is_finite() {
        return vec![Violation::of("/from", from, "a finite number")];
    }
    if to > from && (to - from).is_finite() {
        return Vec::new();
    }
    vec![Violation::of(
        "/to",
        to,
        format!("from < x, with from = {from}"),
    )]
}
