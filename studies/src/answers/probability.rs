//! Probabilities of events, with bounds.

use super::Sample;
use super::binomial;
use crate::CONFIDENCE;
use serde::{Deserialize, Serialize};

/// Probability of an event, from the members in which it happened.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Probability {
    /// Share of the known members in which it happened; none without a known member.
    pub estimate: Option<f64>,
    /// Lower bound: that of Clopper & Pearson (1934) if it happened in no unknown member. With
    /// several levels it counts as many draws as the multilevel estimate is worth (Korn & Graubard
    /// 1998), and holds the numerical error.
    pub lower: f64,
    /// Upper bound: that if it happened in every unknown member.
    pub upper: f64,
    /// Members in which it happened.
    pub happened: u64,
    /// Members of which it is known whether it happened.
    pub known: u64,
    /// Members of which it is not: failed, pending, or without the quantity.
    pub unknown: u64,
}

/// Probability that a quantity exceeds a threshold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Exceedance {
    /// Threshold, in the unit of the quantity.
    pub threshold: f64,
    /// Probability of a larger value.
    pub probability: Probability,
}

impl Probability {
    /// Probability of an event that happened in so many of the known members. Together the bounds
    /// hold at [`CONFIDENCE`] for independent draws; a Sobol' or Latin hypercube design errs less.
    pub fn of(happened: u64, known: u64, unknown: u64) -> Self {
        let all = known + unknown;
        let tail = 0.5 * (1.0 - CONFIDENCE);
        Self {
            estimate: (known > 0).then(|| happened as f64 / known as f64),
            lower: binomial::lower_bound(happened, all, tail),
            upper: binomial::upper_bound(happened + unknown, all, tail),
            happened,
            known,
            unknown,
        }
    }

    /// Probability that a sample's quantity exceeds a threshold.
    pub fn exceeding(sample: &Sample, threshold: f64) -> Self {
        let above = |values: &[f64]| {
            let above = values.iter().filter(|value| **value > threshold);
            above.count() as u64
        };
        let known = sample.values.len() as u64;
        let plain = Self::of(above(&sample.values), known, sample.unknown);
        sample.levels.map_or(plain, |levels| {
            let [least, most] =
                [-1.0, 1.0].map(|side| above(&sample.shifted(side * levels.numerical)));
            plain.with_draws(levels.draws, [least, most])
        })
    }

    /// The same with the bounds of so many independent draws, of which the event happened in the
    /// shares of the known members in which it happened at least and at most.
    pub(super) fn with_draws(self, draws: f64, [least, most]: [u64; 2]) -> Self {
        let all = (self.known + self.unknown).max(1) as f64;
        let known = self.known.max(1) as f64;
        // Unknown members are draws like the known ones, and could have come out in any way.
        let draws = (draws.min(known) * all / known).floor().max(1.0);
        let tail = 0.5 * (1.0 - CONFIDENCE);
        let least = (draws * least as f64 / all).floor() as u64;
        let most = (draws * (most + self.unknown) as f64 / all).ceil() as u64;
        Self {
            lower: binomial::lower_bound(least, draws as u64, tail),
            upper: binomial::upper_bound(most.min(draws as u64), draws as u64, tail),
            ..self
        }
    }
}

impl Exceedance {
    /// Probabilities that a sample's quantity exceeds thresholds.
    pub fn curve(sample: &Sample, thresholds: &[f64]) -> Vec<Self> {
        let at = |threshold: &f64| Self {
            threshold: *threshold,
            probability: Probability::exceeding(sample, *threshold),
        };
        thresholds.iter().map(at).collect()
    }
}
