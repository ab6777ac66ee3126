//! Means on the levels, and their errors.

use super::known::Known;
use super::regression::{Regression, Row};
use super::student;
use crate::CONFIDENCE;
use nalgebra::{SMatrix, SVector};
use std::collections::BTreeMap;

/// Means of a quantity on the levels up to the finest with enough pairs.
#[derive(Debug, Clone)]
pub(crate) struct LevelMeans<const D: usize> {
    /// Terms, the coarsest level's first.
    pub(super) terms: Vec<Term<D>>,
}

/// Term that a level adds to the estimate of the mean.
#[derive(Debug, Clone)]
pub(super) struct Term<const D: usize> {
    /// Cell size [m].
    pub(super) cell_size_m: f64,
    /// Mean on the level, that which the regression predicts: E_l = mean f_l + B_l (E_{l−1} − mean
    /// f_{l−1}) − Σ b_j mean φ_j, the means over the pairs, φ_j functions of the inputs of mean 0.
    pub(super) mean: SVector<f64, D>,
    /// Slope B_l of the regression on the next coarser level; 0 of the coarsest.
    pub(super) slope: SMatrix<f64, D, D>,
    /// Sampling variance that the level adds for each member: that of the regression's residuals.
    pub(super) variance: SMatrix<f64, D, D>,
    /// Degrees of freedom of that variance.
    freedom: f64,
    /// Members or pairs.
    pub(super) members: usize,
    /// Residuals of the regression by the index of the member.
    residuals: BTreeMap<u64, SVector<f64, D>>,
    /// Variance of the quantity on the level over those members.
    spread: SMatrix<f64, D, D>,
}

/// Error of a mean along one axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeanError {
    /// Sampling variance of the mean on the finest level.
    pub(crate) variance: f64,
    /// Half width of the interval at [`CONFIDENCE`] that sampling alone asks for.
    pub(crate) sampling: f64,
    /// Half width that the numerical error adds to it; none on one level.
    pub(crate) numerical: Option<f64>,
}

impl MeanError {
    /// Half width of the interval of both errors together; of sampling alone on one level.
    pub(crate) fn half_width(&self) -> f64 {
        self.sampling + self.numerical.unwrap_or(0.0)
    }
}

impl<const D: usize> LevelMeans<D> {
    /// Means of what is known; none of fewer than two values on the coarsest level.
    pub(crate) fn of(known: &Known<D>) -> Option<Self> {
        let mut terms: Vec<Term<D>> = Vec::new();
        for level in 0..=known.finest() {
            let rows = known.rows(level);
            if rows.len() < 2 {
                return None;
            }
            let coarser = terms.last().map(|term| term.mean);
            terms.push(Term::of(&rows, coarser, known.cell_size_m(level)));
        }
        Some(Self { terms })
    }

    /// Number of levels.
    pub(crate) fn levels(&self) -> usize {
        self.terms.len()
    }

    /// Mean on the finest level.
    pub(crate) fn mean(&self) -> SVector<f64, D> {
        self.terms[self.terms.len() - 1].mean
    }

    /// Number of independent draws on the finest level whose mean would have the same sampling
    /// variance.
    pub(crate) fn one_level_draws(&self, axis: usize) -> f64 {
        self.spread(axis) / self.variance(&self.weights(0.0), axis).0
    }

    /// Number of independent draws that a distribution of the members corrected to the finest level is
    /// worth: as many as there are on the coarsest, less what the corrections are uncertain by.
    pub(crate) fn draws(&self, axis: usize) -> f64 {
        let mut weights = self.weights(0.0);
        weights[0] = SMatrix::zeros();
        let (corrections, _) = self.variance(&weights, axis);
        let draws = 1.0 / self.terms[0].members as f64 + corrections / self.spread(axis);
        if draws.is_finite() {
            1.0 / draws
        } else {
            self.terms[0].members as f64
        }
    }

    /// Variance of the quantity on the finest level.
    fn spread(&self, axis: usize) -> f64 {
        self.terms[self.terms.len() - 1].spread[(axis, axis)]
    }

    /// Error along an axis.
    pub(crate) fn error(&self, axis: usize) -> MeanError {
        let (variance, freedom) = self.variance(&self.weights(0.0), axis);
        let sampling = half_width(variance, freedom);
        let numerical = self.remaining(axis).map(|remaining| {
            let (variance, freedom) = self.extrapolated_variance(axis);
            remaining + (half_width(variance, freedom) - sampling).max(0.0)
        });
        MeanError {
            variance,
            sampling,
            numerical,
        }
    }

    /// Error that cells of the finest level leave, if it falls with the first power of the cell
    /// size: by the difference between the last two levels or between the two before, whichever
    /// says more (Giles 2015, section 3.4). None on one level.
    pub(super) fn remaining(&self, axis: usize) -> Option<f64> {
        let finest = self.terms.last()?.cell_size_m;
        let of_two = |pair: &[Term<D>]| {
            let change = pair[1].mean[axis] - pair[0].mean[axis];
            (change / (pair[0].cell_size_m - pair[1].cell_size_m)).abs() * finest
        };
        let errors = self.terms.windows(2).rev().take(2).map(of_two);
        errors.reduce(f64::max)
    }

    /// Factor r of the last difference by which the mean on the finest level is extrapolated to
    /// vanishing cells; 0 on one level.
    pub(super) fn extrapolation(&self) -> f64 {
        match &self.terms[..] {
            [.., coarser, finest] => {
                finest.cell_size_m / (coarser.cell_size_m - finest.cell_size_m)
            }
            _ => 0.0,
        }
    }

    /// Weights of the levels' own terms in the mean on the finest level, extrapolated by a factor of
    /// the last difference: (1 + r) E_L − r E_{L−1}.
    pub(super) fn weights(&self, extrapolation: f64) -> Vec<SMatrix<f64, D, D>> {
        let identity = SMatrix::<f64, D, D>::identity();
        let last = self.terms.len() - 1;
        let mut weights = vec![identity * (1.0 + extrapolation); last + 1];
        let mut carried = self.terms[last].slope * (1.0 + extrapolation) - identity * extrapolation;
        for level in (0..last).rev() {
            weights[level] = carried;
            carried *= self.terms[level].slope;
        }
        weights
    }

    /// Sampling variance along an axis of the mean extrapolated to vanishing cells, and its degrees
    /// of freedom.
    pub(super) fn extrapolated_variance(&self, axis: usize) -> (f64, f64) {
        self.variance(&self.weights(self.extrapolation()), axis)
    }

    /// Variance along an axis of the sum of the levels' terms with these weights, and its degrees of
    /// freedom (Satterthwaite 1946). Levels have members in common, whose residuals may go
    /// together; covariances that would lower the variance are not counted.
    fn variance(&self, weights: &[SMatrix<f64, D, D>], axis: usize) -> (f64, f64) {
        let (mut sum, mut squares) = (0.0, 0.0);
        for (term, weight) in self.terms.iter().zip(weights) {
            let variance = weight * term.variance * weight.transpose();
            let part = variance[(axis, axis)] / term.members as f64;
            sum += part;
            squares += part * part / term.freedom;
        }
        let freedom = if squares > 0.0 {
            sum * sum / squares
        } else {
            f64::INFINITY
        };
        (sum + self.covariance(weights, axis).max(0.0), freedom)
    }

    /// Twice the covariances of all pairs of levels, of weighted terms along an axis: of nested means
    /// that of the members over the number on the coarser level.
    fn covariance(&self, weights: &[SMatrix<f64, D, D>], axis: usize) -> f64 {
        let weighted = |level: usize, residual: &SVector<f64, D>| (weights[level] * residual)[axis];
        let of_two = |(coarser, finer): (usize, usize)| {
            let (coarse, fine) = (&self.terms[coarser], &self.terms[finer]);
            let products = fine.residuals.iter().filter_map(|(index, residual)| {
                let other = coarse.residuals.get(index)?;
                Some(weighted(coarser, other) * weighted(finer, residual))
            });
            2.0 * products.sum::<f64>() / fine.freedom / coarse.members as f64
        };
        let levels = 0..self.terms.len();
        let pairs = levels.flat_map(|finer| (0..finer).map(move |coarser| (coarser, finer)));
        pairs.map(of_two).sum()
    }
}

impl LevelMeans<1> {
    /// Mean on each level, and the standard deviation of what the level adds for each member.
    pub(crate) fn on_levels(&self) -> Vec<(f64, f64)> {
        let terms = self.terms.iter();
        terms
            .map(|term| (term.mean[0], term.variance[(0, 0)].sqrt()))
            .collect()
    }

    /// The same with other numbers of members.
    pub(super) fn with_members(mut self, members: &[u64]) -> Self {
        for (term, members) in self.terms.iter_mut().zip(members) {
            term.members = *members as usize;
        }
        self
    }
}

impl Term<1> {
    /// Term of a quantity of mean 1 before any member is known: all levels agree but for what each
    /// adds, of this standard deviation.
    pub(super) fn expected(cell_size_m: f64, level: usize, deviation: f64) -> Self {
        Self {
            cell_size_m,
            mean: SVector::repeat(1.0),
            slope: SMatrix::repeat(f64::from(u8::from(level > 0))),
            variance: SMatrix::repeat(deviation * deviation),
            freedom: f64::INFINITY,
            members: 1,
            residuals: BTreeMap::new(),
            spread: SMatrix::repeat(deviation * deviation),
        }
    }
}

impl<const D: usize> Term<D> {
    /// Term of a level. A mean corrected by q fitted slopes varies (n − 2)/(n − 2 − q) times as much
    /// as with the true ones (Lavenberg & Welch 1981).
    fn of(rows: &[Row<D>], coarser: Option<SVector<f64, D>>, cell_size_m: f64) -> Self {
        let regression = Regression::of(rows);
        let count = rows.len() as f64;
        let fitted = match regression.regressors as f64 {
            0.0 => 1.0,
            slopes => (count - 2.0) / (count - 2.0 - slopes).max(1.0),
        };
        Self {
            cell_size_m,
            mean: regression.predicted_mean(coarser),
            slope: regression.slope,
            variance: regression.residual * fitted,
            freedom: regression.freedom(),
            members: rows.len(),
            residuals: rows
                .iter()
                .map(|row| (row.index, regression.residual_of(row)))
                .collect(),
            spread: spread(rows),
        }
    }
}

/// Covariance of the values of members.
fn spread<const D: usize>(rows: &[Row<D>]) -> SMatrix<f64, D, D> {
    let count = rows.len() as f64;
    let mean = rows.iter().map(|row| row.value).sum::<SVector<f64, D>>() / count;
    let square = |row: &Row<D>| (row.value - mean) * (row.value - mean).transpose();
    rows.iter().map(square).sum::<SMatrix<f64, D, D>>() / (count - 1.0)
}

/// Half width of the interval at [`CONFIDENCE`].
pub(super) fn half_width(variance: f64, freedom: f64) -> f64 {
    student::quantile(0.5 * (1.0 + CONFIDENCE), freedom.max(1.0)) * variance.sqrt()
}
