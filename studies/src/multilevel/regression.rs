//! Linear regression of a level on the next coarser one.

use nalgebra::{SMatrix, SVector};

/// Fewest pairs that a regression is fitted to.
pub(super) const FEWEST_PAIRS: usize = 6;
/// Ridge over the largest variance of the coarse values, for places on a line.
const RIDGE: f64 = 1e-9;

/// Quantity of a member on two neighbouring levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair<const D: usize> {
    /// On the coarser one.
    pub(super) coarse: SVector<f64, D>,
    /// On the finer one.
    pub(super) fine: SVector<f64, D>,
}

/// Regression of the fine value on the coarse one, by least squares.
#[derive(Debug, Clone)]
pub(super) struct Regression<const D: usize> {
    pub(super) mean_coarse: SVector<f64, D>,
    pub(super) mean_fine: SVector<f64, D>,
    /// Change of the fine value with the coarse one; 0 of coarse values that do not vary.
    pub(super) slope: SMatrix<f64, D, D>,
    /// Covariance of the residuals, without bias.
    pub(super) residual: SMatrix<f64, D, D>,
    /// Number of pairs.
    pub(super) pairs: usize,
}

impl<const D: usize> Regression<D> {
    /// Regression over at least [`FEWEST_PAIRS`] pairs.
    pub(super) fn of(pairs: &[Pair<D>]) -> Self {
        let count = pairs.len() as f64;
        let sum = |of: fn(&Pair<D>) -> SVector<f64, D>| {
            pairs.iter().map(of).sum::<SVector<f64, D>>() / count
        };
        let (mean_coarse, mean_fine) = (sum(|pair| pair.coarse), sum(|pair| pair.fine));
        let mut spread = SMatrix::<f64, D, D>::zeros();
        let mut shared = SMatrix::<f64, D, D>::zeros();
        for pair in pairs {
            let coarse = pair.coarse - mean_coarse;
            spread += coarse * coarse.transpose();
            shared += (pair.fine - mean_fine) * coarse.transpose();
        }
        let ridge = RIDGE * spread.diagonal().max();
        spread += SMatrix::identity() * ridge;
        let slope = match ridge > 0.0 {
            true => shared * spread.try_inverse().unwrap_or_else(SMatrix::zeros),
            false => SMatrix::zeros(),
        };
        let mut residual = SMatrix::zeros();
        for pair in pairs {
            let left = pair.fine - mean_fine - slope * (pair.coarse - mean_coarse);
            residual += left * left.transpose();
        }
        Self {
            mean_coarse,
            mean_fine,
            slope,
            residual: residual / (pairs.len() - 1 - D) as f64,
            pairs: pairs.len(),
        }
    }

    /// Degrees of freedom of the residuals.
    pub(super) fn freedom(&self) -> f64 {
        (self.pairs - 1 - D) as f64
    }
}
