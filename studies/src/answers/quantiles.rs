//! Quantiles of a quantity, with bounds.

use super::{Sample, binomial};
use crate::{CONFIDENCE, moments};
use serde::{Deserialize, Serialize};

/// Quantile of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Quantile {
    /// Probability of a smaller value.
    pub probability: f64,
    /// Estimate from the known members, type 8 of Hyndman & Fan (1996), whose median is right for
    /// any distribution; none without a known member.
    pub estimate: Option<f64>,
    /// Lower bound; none if the members are too few for one.
    pub lower: Option<f64>,
    /// Upper bound; none if the members are too few for one.
    pub upper: Option<f64>,
}

impl Quantile {
    /// Quantile of a sample at a probability 0 < p < 1.
    ///
    /// The bounds are order statistics, so they hold for any distribution: at [`CONFIDENCE`]
    /// together for independent draws. A member of unknown outcome could lie anywhere: for the
    /// lower bound it lies below all others, for the upper one above. With several levels the ranks
    /// are those of as many draws as the multilevel estimate is worth (Woodruff 1952), and the
    /// numerical error is added.
    pub fn of(sample: &Sample, probability: f64) -> Self {
        let sorted = moments::sorted(&sample.values);
        let (known, unknown) = (sorted.len() as u64, sample.unknown);
        let (lower, upper) = ranks(sample, probability);
        let numerical = sample.levels.map_or(0.0, |levels| levels.numerical);
        let ranked = |rank: u64, shift: f64| {
            let place = rank.checked_sub(1)? as usize;
            if shift == 0.0 {
                return sorted.get(place).copied();
            }
            let shifted = moments::sorted(&sample.shifted(shift));
            shifted.get(place).copied()
        };
        let lower = lower.checked_sub(unknown);
        Self {
            probability,
            estimate: type_8(&sorted, probability),
            lower: lower.and_then(|lower| ranked(lower, -numerical)),
            upper: (upper <= known).then(|| ranked(upper, numerical)).flatten(),
        }
    }
}

/// Ranks among all members, counted from 1, of the bounds of a quantile; 0 and more than there are
/// stand for no bound.
fn ranks(sample: &Sample, probability: f64) -> (u64, u64) {
    let all = sample.values.len() as u64 + sample.unknown;
    let tail = 0.5 * (1.0 - CONFIDENCE);
    let Some(levels) = sample.levels else {
        return binomial::quantile_ranks(probability, all, tail);
    };
    let draws = (levels.draws as u64).clamp(1, all.max(1));
    let (lower, upper) = binomial::quantile_ranks(probability, draws, tail);
    // The same shares of the members.
    let share = all as f64 / draws as f64;
    let beyond = if upper > draws {
        all + 1
    } else {
        (upper as f64 * share).ceil() as u64
    };
    ((lower as f64 * share).floor() as u64, beyond)
}

/// Quantile at the place (n + 1/3) p + 1/3 of the sorted values, counted from 1.
fn type_8(sorted: &[f64], probability: f64) -> Option<f64> {
    let place = (sorted.len() as f64 + 1.0 / 3.0) * probability + 1.0 / 3.0;
    (!sorted.is_empty()).then(|| moments::at(sorted, place - 1.0))
}
