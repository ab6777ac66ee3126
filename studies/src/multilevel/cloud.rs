//! Resting places of the coarse level, corrected by pairs.

use super::MultilevelError;
use crate::moments;
use crate::random::{Purpose, Random};
use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

/// Fewest pairs that a regression is fitted to.
const FEWEST: usize = 10;
/// Ridge of the regression over the larger variance of the coarse places, for places on a line.
const RIDGE: f64 = 1e-9;

/// Resting places on two neighbouring levels with the same inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct PlacePair {
    /// Place of the coarser member, downstream and across [m].
    pub coarse_m: [f64; 2],
    /// Place of the finer member [m].
    pub fine_m: [f64; 2],
}

/// Linear regression of the difference fine − coarse on the coarse place.
struct Regression {
    mean: Vector2<f64>,
    shift: Vector2<f64>,
    slope: Matrix2<f64>,
}

/// Coarse places as the finer level would have them: each is moved by the difference fine − coarse
/// that a linear regression on the coarse place predicts, and by the residual of a pair drawn from
/// the √n pairs nearest to it.
///
/// Near pairs keep what a line cannot say: a scatter that grows downstream, and a body that rests
/// at the same place on both levels, whose members stay there to rounding. Places that only the
/// fine level reaches are not found. To correct over several levels, call it for each in turn with
/// the corrected places.
///
/// # Errors
/// Fewer than ten pairs.
pub fn corrected_places(
    coarse_m: &[[f64; 2]],
    pairs: &[PlacePair],
    seed: u64,
) -> Result<Vec<[f64; 2]>, MultilevelError> {
    if pairs.len() < FEWEST {
        return Err(MultilevelError::TooFewMembers {
            level: 1,
            members: pairs.len(),
            least: FEWEST,
        });
    }
    let regression = Regression::of(pairs);
    let near = (pairs.len() as f64).sqrt().ceil() as usize;
    let corrected = |(place, coarse): (usize, &[f64; 2])| {
        let coarse = Vector2::from(*coarse);
        let mut random = Random::new(Purpose::Residual, seed, [place as u64, 0]);
        let pair = nearest(pairs, coarse, near)[random.below(near)];
        let residual = difference(pair) - regression.at(Vector2::from(pair.coarse_m));
        (coarse + regression.at(coarse) + residual).into()
    };
    Ok(coarse_m.iter().enumerate().map(corrected).collect())
}

impl Regression {
    fn of(pairs: &[PlacePair]) -> Self {
        let coarse = [0, 1].map(|axis| along(pairs, |pair| pair.coarse_m[axis]));
        let change = [0, 1].map(|axis| along(pairs, |pair| difference(pair)[axis]));
        let spread = |one: usize, other: usize| moments::covariance(&coarse[one], &coarse[other]);
        let shared = |row: usize, axis: usize| moments::covariance(&change[row], &coarse[axis]);
        let mut spreads = Matrix2::from_fn(spread);
        let ridge = RIDGE * spreads.m11.max(spreads.m22);
        spreads.m11 += ridge;
        spreads.m22 += ridge;
        let inverse = spreads.try_inverse().unwrap_or_else(Matrix2::zeros);
        Self {
            mean: Vector2::from_fn(|axis, _| moments::mean(&coarse[axis])),
            shift: Vector2::from_fn(|axis, _| moments::mean(&change[axis])),
            slope: Matrix2::from_fn(shared) * inverse,
        }
    }

    /// Predicted difference at a coarse place [m].
    fn at(&self, coarse: Vector2<f64>) -> Vector2<f64> {
        self.shift + self.slope * (coarse - self.mean)
    }
}

/// The pairs nearest to a coarse place.
fn nearest(pairs: &[PlacePair], coarse: Vector2<f64>, count: usize) -> Vec<&PlacePair> {
    let distance = |pair: &&PlacePair| (Vector2::from(pair.coarse_m) - coarse).norm_squared();
    let mut sorted: Vec<&PlacePair> = pairs.iter().collect();
    sorted.sort_by(|one, other| distance(one).total_cmp(&distance(other)));
    sorted.truncate(count);
    sorted
}

fn difference(pair: &PlacePair) -> Vector2<f64> {
    Vector2::from(pair.fine_m) - Vector2::from(pair.coarse_m)
}

fn along(pairs: &[PlacePair], number: impl Fn(&PlacePair) -> f64) -> Vec<f64> {
    pairs.iter().map(number).collect()
}
