//! Lognormal distribution.

use crate::normal;
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Lognormal distribution, given by two of its quantiles.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LognormalDistribution))]
#[serde(deny_unknown_fields)]
pub struct Lognormal {
    /// Median, positive, in the unit of the input.
    pub median: f64,
    /// 95 % quantile, above the median.
    pub p95: f64,
}

impl Lognormal {
    /// Quantile median · exp(σ Φ⁻¹(u)).
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        self.median * libm::exp(self.sigma() * normal::quantile(probability))
    }

    /// Mean median · exp(σ²/2).
    pub(super) fn mean(&self) -> f64 {
        self.median * libm::exp(0.5 * self.sigma() * self.sigma())
    }

    /// Standard deviation of the logarithm, ln(p95/median) / Φ⁻¹(0.95).
    fn sigma(&self) -> f64 {
        libm::log(self.p95 / self.median) / normal::quantile(0.95)
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        if !(self.median > 0.0 && self.median.is_finite()) {
            return vec![Violation::of("/median", self.median, "x > 0")];
        }
        if self.p95 > self.median && (self.p95 / self.median).is_finite() {
            return Vec::new();
        }
        let allowed = format!("median < x, with median = {}", self.median);
        vec![Violation::of("/p95", self.p95, allowed)]
    }
}
