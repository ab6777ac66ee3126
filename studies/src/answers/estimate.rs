//! Estimates with bounds from resampling.

use crate::random::{Purpose, Random};
use crate::{CONFIDENCE, moments};
use serde::{Deserialize, Serialize};

/// Resamples behind a pair of bounds.
const RESAMPLES: u64 = 400;
/// Seed of the resampling, the same for all studies.
const SEED: u64 = 2;

/// Estimate with bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyEstimate))]
pub struct Estimate {
    /// Estimate.
    pub value: f64,
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

/// Statistic of some of the rows of a table, by their numbers.
pub(super) type Statistic<'a> = &'a dyn Fn(&[usize]) -> f64;

impl Estimate {
    /// Statistic of all rows, with the bootstrap percentiles that hold [`CONFIDENCE`] between
    /// them (Efron 1979).
    pub(super) fn percentile(rows: usize, statistic: Statistic) -> Self {
        let all: Vec<usize> = (0..rows).collect();
        let value = statistic(&all);
        let [lower, upper] = ends(&resampled(rows, statistic));
        Self {
            value,
            lower,
            upper,
        }
    }

    /// The same for a statistic that rows drawn twice shift: the percentiles are moved so that
    /// the resamples have the estimate as their mean.
    pub(super) fn shifted_percentile(rows: usize, statistic: Statistic) -> Self {
        let all: Vec<usize> = (0..rows).collect();
        let value = statistic(&all);
        let resampled = resampled(rows, statistic);
        let shift = value - moments::mean(&resampled);
        let [lower, upper] = ends(&resampled).map(|end| end + shift);
        Self {
            value,
            lower,
            upper,
        }
    }
}

/// The statistic in resamples of the rows, drawn with replacement.
fn resampled(rows: usize, statistic: Statistic) -> Vec<f64> {
    let resample = |number: u64| {
        let mut random = Random::new(Purpose::Bootstrap, SEED, [number, 0]);
        let drawn: Vec<usize> = (0..rows).map(|_| random.below(rows)).collect();
        statistic(&drawn)
    };
    (0..RESAMPLES).map(resample).collect()
}

/// Percentiles that hold the confidence between them.
fn ends(resampled: &[f64]) -> [f64; 2] {
    let sorted = moments::sorted(resampled);
    let last = (sorted.len() - 1) as f64;
    let tail = 0.5 * (1.0 - CONFIDENCE);
    [tail, 1.0 - tail].map(|share| moments::at(&sorted, share * last))
}
