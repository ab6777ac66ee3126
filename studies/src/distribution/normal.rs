//! Normal distribution, perhaps truncated.

use super::uniform::range_violations;
use crate::normal;
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Smallest probability that a truncation must leave; below it the quantiles lose their digits.
const LEAST_PROBABILITY: f64 = 1e-6;

/// Normal distribution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = NormalDistribution))]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Mean before truncation, in the unit of the input.
    pub mean: f64,
    /// Standard deviation before truncation, in the unit of the input.
    pub sd: f64,
    /// Range that is kept; none: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub truncate: Option<Interval>,
}

/// Range of values.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = TruncationRange))]
#[serde(deny_unknown_fields)]
pub struct Interval {
    /// Smallest value, in the unit of the input.
    pub from: f64,
    /// Largest value, above `from`.
    pub to: f64,
}

impl Normal {
    /// Quantile μ + σ Φ⁻¹(Φ(a) + u (Φ(b) − Φ(a))), a and b the standardised ends.
    pub(super) fn quantile(&self, probability: f64) -> f64 {
        let Some(range) = self.truncate else {
            return self.mean + self.sd * normal::quantile(probability);
        };
        let (from, to) = self.standardised(range);
        // In the upper tail Φ is next to 1 and has lost its digits; the lower one is its mirror.
        let z = if from > 0.0 {
            -between(-to, -from, 1.0 - probability)
        } else {
            between(from, to, probability)
        };
        (self.mean + self.sd * z).clamp(range.from, range.to)
    }

    /// Mean μ + σ (φ(a) − φ(b)) / (Φ(b) − Φ(a)).
    pub(super) fn mean(&self) -> f64 {
        let Some(range) = self.truncate else {
            return self.mean;
        };
        let (from, to) = self.standardised(range);
        let densities = normal::density(from) - normal::density(to);
        self.mean + self.sd * densities / self.kept(range)
    }

    fn standardised(&self, range: Interval) -> (f64, f64) {
        let z = |value: f64| (value - self.mean) / self.sd;
        (z(range.from), z(range.to))
    }

    /// Probability within the range.
    fn kept(&self, range: Interval) -> f64 {
        let (from, to) = self.standardised(range);
        if from > 0.0 {
            return normal::cdf(-from) - normal::cdf(-to);
        }
        normal::cdf(to) - normal::cdf(from)
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let mut found = Vec::new();
        if !self.mean.is_finite() {
            found.push(Violation::of("/mean", self.mean, "a finite number"));
        }
        if !(self.sd > 0.0 && self.sd.is_finite()) {
            found.push(Violation::of("/sd", self.sd, "x > 0"));
        }
        if let Some(range) = self.truncate {
            let within = range_violations(range.from, range.to);
            found.extend(Violation::under("/truncate", within));
            if found.is_empty() && self.kept(range) < LEAST_PROBABILITY {
                found.push(self.too_narrow(range));
            }
        }
        found
    }

    fn too_narrow(&self, range: Interval) -> Violation {
        let message = format!(
            "truncate keeps a probability of {:.1e} of the normal distribution, allowed: at least \
             {LEAST_PROBABILITY:e}",
            self.kept(range)
        );
        Violation::new("/truncate", message)
    }
}

/// Quantile of the standard normal distribution truncated to from..to.
fn between(from: f64, to: f64, probability: f64) -> f64 {
    let (below, above) = (normal::cdf(from), normal::cdf(to));
    normal::quantile(below + probability * (above - below))
}
