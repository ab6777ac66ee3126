//! Members of all levels, and the telescoping sum over them.

use super::MultilevelError;
use crate::moments;
use serde::{Deserialize, Serialize};

/// Fewest members or pairs of a level: fewer have no variance.
const FEWEST: usize = 2;

/// Quantity on two neighbouring levels with the same inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LevelPair))]
pub struct Pair {
    /// Quantity of the coarser member.
    pub coarse: f64,
    /// Quantity of the finer member.
    pub fine: f64,
}

/// Quantity of the members of two or more levels. A pair of which one run failed is left out by
/// the caller.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    base: Vec<f64>,
    corrections: Vec<Vec<Pair>>,
}

/// Estimate of an expectation on the finest level.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct LevelEstimate {
    /// Estimate, without bias against the finest level.
    pub value: f64,
    /// Its sampling variance, of independent draws.
    pub variance: f64,
    /// Terms of the sum, the coarsest level first.
    pub levels: Vec<LevelMoments>,
}

/// Term of the sum: the quantity on level 0, the difference to the next coarser level on others.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct LevelMoments {
    /// Mean.
    pub mean: f64,
    /// Variance of one member or pair.
    pub variance: f64,
    /// Number of members or pairs.
    pub members: u64,
}

impl Levels {
    /// Levels of the members of level 0 and the pairs of the others, coarse to fine.
    ///
    /// # Errors
    /// No pairs at all, or a level with fewer than two members or pairs.
    pub fn new(base: Vec<f64>, corrections: Vec<Vec<Pair>>) -> Result<Self, MultilevelError> {
        if corrections.is_empty() {
            return Err(MultilevelError::OneLevel);
        }
        let found = Self { base, corrections };
        found.check(FEWEST)?;
        Ok(found)
    }

    /// Error if level 0 has too few members, or another one fewer pairs than an estimate needs.
    pub(super) fn check(&self, pairs: usize) -> Result<(), MultilevelError> {
        let base = (self.base.len(), FEWEST);
        let corrections = self.corrections.iter().map(|level| (level.len(), pairs));
        let mut levels = [base].into_iter().chain(corrections).enumerate();
        match levels.find(|(_, (members, least))| members < least) {
            None => Ok(()),
            Some((level, (members, least))) => Err(MultilevelError::TooFewMembers {
                level,
                members,
                least,
            }),
        }
    }

    /// Indicator of a larger quantity than a threshold, 0 or 1, in place of the quantity; its
    /// expectation is the probability of exceedance.
    pub fn exceeding(&self, threshold: f64) -> Self {
        let indicator = |value: f64| f64::from(u8::from(value > threshold));
        let pair = |pair: &Pair| Pair {
            coarse: indicator(pair.coarse),
            fine: indicator(pair.fine),
        };
        let pairs = |pairs: &Vec<Pair>| pairs.iter().map(pair).collect();
        Self {
            base: self.base.iter().map(|value| indicator(*value)).collect(),
            corrections: self.corrections.iter().map(pairs).collect(),
        }
    }

    /// Expectation on the finest level: mean of level 0 plus the mean differences of the pairs
    /// (Giles 2008, equation 2.1). The variance is Σ V_l / N_l.
    pub fn mean(&self) -> LevelEstimate {
        let differences = self.corrections.iter().map(|pairs| {
            let differences = pairs.iter().map(|pair| pair.fine - pair.coarse);
            LevelMoments::of(&differences.collect::<Vec<f64>>())
        });
        let levels = [LevelMoments::of(&self.base)]
            .into_iter()
            .chain(differences);
        let levels: Vec<LevelMoments> = levels.collect();
        LevelEstimate {
            value: levels.iter().map(|level| level.mean).sum(),
            variance: levels.iter().map(LevelMoments::variance_of_mean).sum(),
            levels,
        }
    }

    /// Members of level 0.
    pub(super) fn base(&self) -> &[f64] {
        &self.base
    }

    /// Pairs of each further level.
    pub(super) fn corrections(&self) -> &[Vec<Pair>] {
        &self.corrections
    }

    /// Pairs of the finest level.
    pub(super) fn finest(&self) -> &[Pair] {
        self.corrections.last().map_or(&[], |pairs| pairs)
    }

    /// Variance of the quantity on the finest level.
    pub fn finest_variance(&self) -> f64 {
        let fine: Vec<f64> = self.finest().iter().map(|pair| pair.fine).collect();
        moments::variance(&fine)
    }
}

impl LevelMoments {
    pub(super) fn of(values: &[f64]) -> Self {
        Self {
            mean: moments::mean(values),
            variance: moments::variance(values),
            members: values.len() as u64,
        }
    }

    pub(super) fn variance_of_mean(&self) -> f64 {
        self.variance / self.members as f64
    }
}
