//! Coarser levels as control variates.

use super::MultilevelError;
use super::levels::{LevelMoments, Levels, Pair};
use crate::moments;
use serde::{Deserialize, Serialize};

/// Fewest pairs that a coefficient is estimated from.
const FEWEST_PILOTS: usize = 8;

/// Estimate of an expectation on the finest level with fitted coefficients.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ControlledEstimate {
    /// Estimate, without bias against the finest level.
    pub value: f64,
    /// Its sampling variance, of independent draws.
    pub variance: f64,
    /// Coefficient of each coarser level, the coarsest first; the telescoping sum has 1.
    pub coefficients: Vec<f64>,
}

impl Levels {
    /// Expectation on the finest level with each coarser level as a control variate of the next
    /// finer one: E_l = mean(f_l − α_l f_{l−1}) + α_l E_{l−1}, the means over the pairs of the
    /// level.
    ///
    /// α is fitted to the first `pilots` pairs of the level, which then take no part in the means:
    /// with a coefficient fitted to the same pairs the estimate would have a bias. Where the levels
    /// correlate weakly α is near 0, and the coarser level does little harm.
    ///
    /// # Errors
    /// Fewer than eight pilots, or a level that they leave fewer than two pairs of.
    pub fn controlled_mean(&self, pilots: usize) -> Result<ControlledEstimate, MultilevelError> {
        if pilots < FEWEST_PILOTS {
            return Err(MultilevelError::NotAllowed {
                what: "number of pilots",
                value: pilots as f64,
                allowed: "x >= 8",
            });
        }
        self.check(pilots.saturating_add(2))?;
        let base = LevelMoments::of(self.base());
        let start = ControlledEstimate {
            value: base.mean,
            variance: base.variance_of_mean(),
            coefficients: Vec::new(),
        };
        let pairs = self.corrections().iter();
        Ok(pairs.fold(start, |coarser, pairs| coarser.with_level(pairs, pilots)))
    }
}

impl ControlledEstimate {
    /// Estimate on the next finer level.
    fn with_level(mut self, pairs: &[Pair], pilots: usize) -> Self {
        let (pilots, others) = pairs.split_at(pilots);
        let coefficient = coefficient(pilots, self.variance * others.len() as f64);
        let difference = |pair: &Pair| pair.fine - coefficient * pair.coarse;
        let differences: Vec<f64> = others.iter().map(difference).collect();
        let moments = LevelMoments::of(&differences);
        self.coefficients.push(coefficient);
        Self {
            value: moments.mean + coefficient * self.value,
            variance: moments.variance_of_mean() + coefficient * coefficient * self.variance,
            coefficients: self.coefficients,
        }
    }
}

/// Coefficient of least variance, cov(f, c) / (var c + N v), where v is the variance of the coarser
/// level's estimate and N the number of pairs; 1 of a coarser level that does not vary.
fn coefficient(pilots: &[Pair], coarser_variance: f64) -> f64 {
    let coarse: Vec<f64> = pilots.iter().map(|pair| pair.coarse).collect();
    let fine: Vec<f64> = pilots.iter().map(|pair| pair.fine).collect();
    let variance = moments::variance(&coarse);
    if variance > 0.0 {
        moments::covariance(&coarse, &fine) / (variance + coarser_variance)
    } else {
        1.0
    }
}
