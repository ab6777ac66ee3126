//! Triangular distribution.

use super::uniform::range_violations;
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Triangular distribution: a density that rises to the mode and falls from it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = TriangularDistribution))]
#[serde(deny_unknown_fields)]
pub struct Triangular {
    /// Smallest value, in the unit of the input.
    pub from: f64,
    /// Most likely value, within the range.
    pub mode: f64,
    /// Largest value, above `from`.
    pub to: f64,
}

impl Triangular {
    /// Quantile: from + √(u (to − from)(mode − from)) up to the mode, and the mirror image of it
    /// beyond.
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        let (length, rise) = (self.to - self.from, self.mode - self.from);
        let value = if probability * length <= rise {
            self.from + (probability * length * rise).sqrt()
        } else {
            self.to - ((1.0 - probability) * length * (self.to - self.mode)).sqrt()
        };
        value.clamp(self.from, self.to)
    }

    pub(super) fn mean(&self) -> f64 {
        (self.from + self.mode + self.to) / 3.0
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let mut found = range_violations(self.from, self.to);
        if found.is_empty() && !(self.from..=self.to).contains(&self.mode) {
            let allowed = format!("{} <= x <= {}", self.from, self.to);
            found.push(Violation::of("/mode", self.mode, allowed));
        }
        found
    }
}
