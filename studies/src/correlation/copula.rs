//! Gaussian copula.

use super::Correlation;
use crate::distribution::SMALLEST_PROBABILITY;
use crate::normal;
use nalgebra::DMatrix;
use thiserror::Error;

/// Gaussian copula: turns independent uniform numbers into correlated uniform ones.
#[derive(Debug, Clone, PartialEq)]
pub struct Copula {
    /// Lower triangle of the Cholesky decomposition of the normal correlations.
    lower: DMatrix<f64>,
}

/// Rank correlations that no distribution can have together.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("the correlations of the inputs {} contradict each other: their matrix isn't positive definite", pairs(.0))]
pub struct NotPositiveDefinite(
    /// Pairs of inputs whose correlations contradict each other.
    pub Vec<[usize; 2]>,
);

impl Copula {
    /// Copula of rank correlations between so many inputs; pairs that are not listed are
    /// independent. Every index is below the number of inputs.
    ///
    /// # Errors
    /// A matrix that is not positive definite, with the pairs that make it so.
    pub fn new(inputs: usize, correlations: &[Correlation]) -> Result<Self, NotPositiveDefinite> {
        let mut matrix = DMatrix::identity(inputs, inputs);
        for correlation in correlations {
            let [one, other] = correlation.inputs;
            let pearson = normal_correlation(correlation.rank);
            matrix[(one, other)] = pearson;
            matrix[(other, one)] = pearson;
        }
        match matrix.clone().cholesky() {
            Some(cholesky) => Ok(Self {
                lower: cholesky.unpack(),
            }),
            None => Err(NotPositiveDefinite(contradiction(&matrix))),
        }
    }

    /// Correlated point of an independent one; each coordinate is uniform over (0, 1). A
    /// coordinate without correlation to an earlier one stays as it is, so that the strata of a
    /// design survive.
    pub fn correlated(&self, point: &[f64]) -> Vec<f64> {
        let normal: Vec<f64> = point.iter().map(|u| normal::quantile(*u)).collect();
        let coordinate = |(row, u): (usize, &f64)| {
            let earlier = (0..row).filter(|column| self.lower[(row, *column)] != 0.0);
            let shift = earlier.map(|column| self.lower[(row, column)] * normal[column]);
            let shift = shift.reduce(|sum, part| sum + part);
            shift.map_or(*u, |shift| {
                let z = shift + self.lower[(row, row)] * normal[row];
                normal::cdf(z).clamp(SMALLEST_PROBABILITY, 1.0 - SMALLEST_PROBABILITY)
            })
        };
        point.iter().enumerate().map(coordinate).collect()
    }
}

/// Pearson's correlation of normal variables with a Spearman's ρ: 2 sin(π ρ / 6) (Pearson 1907).
fn normal_correlation(rank: f64) -> f64 {
    2.0 * libm::sin(std::f64::consts::PI * rank / 6.0)
}

/// Correlated pairs within the first inputs whose matrix is not positive definite, those left out
/// that it fails without.
fn contradiction(matrix: &DMatrix<f64>) -> Vec<[usize; 2]> {
    let mut kept: Vec<usize> = (0..matrix.nrows()).collect();
    for input in 0..matrix.nrows() {
        let without: Vec<usize> = kept.iter().copied().filter(|one| *one != input).collect();
        if !is_positive_definite(matrix, &without) {
            kept = without;
        }
    }
    let pairs = kept.iter().enumerate().flat_map(|(place, one)| {
        let later = kept[place + 1..].iter();
        later.map(|other| [*one, *other])
    });
    pairs
        .filter(|[one, other]| matrix[(*one, *other)] != 0.0)
        .collect()
}

fn is_positive_definite(matrix: &DMatrix<f64>, inputs: &[usize]) -> bool {
    let part = matrix.select_rows(inputs).select_columns(inputs);
    part.cholesky().is_some()
}

fn pairs(pairs: &[[usize; 2]]) -> String {
    let names = pairs
        .iter()
        .map(|[one, other]| format!("{one} and {other}"));
    names.collect::<Vec<String>>().join(", ")
}
