//! Means of quantities, with bounds.

use crate::multilevel::{Corrected, Known, LevelMeans, MeanError};
use crate::outcome::Member;
use crate::study::Ensemble;
use serde::{Deserialize, Serialize};

/// Mean of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyMean))]
pub struct Mean {
    /// Estimate, on the finest level; none of fewer than two known members.
    pub estimate: Option<f64>,
    /// Lower bound: sampling and numerical error below the estimate.
    pub lower: Option<f64>,
    /// Upper bound, likewise.
    pub upper: Option<f64>,
    /// Half width of the interval that sampling alone asks for.
    pub sampling_error: Option<f64>,
    /// Half width that cells of the finest level add to it; none on one level, which does not tell.
    pub numerical_error: Option<f64>,
    /// Members whose quantity is known.
    pub known: u64,
    /// Members whose quantity is not: failed, pending, or without it. For the bounds they lie
    /// anywhere between the smallest known value and the largest.
    pub unknown: u64,
}

impl Mean {
    /// Mean of a quantity, of a body or of the whole run. Together the bounds hold at
    /// [`crate::CONFIDENCE`] for independent draws; a Sobol' design errs less.
    pub fn of(ensemble: &Ensemble, members: &[Member], name: &str, body: Option<usize>) -> Self {
        let known = Known::of_quantity(ensemble, members, (name, body));
        Self::of_known(&known, LevelMeans::of(&known).as_ref())
    }

    /// Mean of known values, of which these are the means on the levels.
    pub(crate) fn of_known(known: &Known<1>, means: Option<&LevelMeans<1>>) -> Self {
        let corrected = Corrected::of(known);
        let values = || corrected.values.values().map(|[value]| *value);
        let (known, unknown) = (corrected.values.len() as u64, corrected.unknown);
        let found = means.map(|means| (means.mean()[0], means.error(0)));
        let least = values().fold(f64::INFINITY, f64::min);
        let most = values().fold(f64::NEG_INFINITY, f64::max);
        let all = (known + unknown) as f64;
        let with_unknown = |known_mean: f64, extreme: f64| {
            (known as f64 * known_mean + unknown as f64 * extreme) / all
        };
        let half = |error: MeanError| error.half_width();
        Self {
            estimate: found.map(|(mean, _)| mean),
            lower: found.map(|(mean, error)| with_unknown(mean - half(error), least)),
            upper: found.map(|(mean, error)| with_unknown(mean + half(error), most)),
            sampling_error: found.map(|(_, error)| error.sampling),
            numerical_error: found.and_then(|(_, error)| error.numerical),
            known,
            unknown,
        }
    }
    /// Largest distance of the bounds from the estimate, over the estimate; 0 of bounds at an
    /// estimate of 0.
    pub(crate) fn relative_error(&self) -> Option<f64> {
        let (estimate, lower, upper) = (self.estimate?, self.lower?, self.upper?);
        let distance = (estimate - lower).max(upper - estimate);
        Some(match distance > 0.0 {
            true => distance / estimate.abs(),
            false => 0.0,
        })
    }
}
