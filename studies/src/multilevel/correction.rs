//! Members as they would have been on the finest level.

use super::estimate::LevelMeans;
use super::known::Known;
use super::regression::{Pair, Regression};
use crate::random::{Purpose, Random};
use nalgebra::SVector;
use std::collections::BTreeMap;

/// A quantity of all draws on the finest level.
#[derive(Debug, Clone)]
pub(crate) struct Corrected<const D: usize> {
    /// Values by the index of the draw: of its run on the finest level if it has one, else the
    /// corrected value of its finest run.
    pub(crate) values: BTreeMap<u64, [f64; D]>,
    /// Number of draws without a value.
    pub(crate) unknown: u64,
    /// Means on the levels; none of fewer than two values on the coarsest.
    pub(crate) means: Option<LevelMeans<D>>,
}

impl<const D: usize> Corrected<D> {
    /// Values of what is known, corrected to the finest level that has enough pairs.
    ///
    /// A value x of a coarser level becomes f + B (x − c), level by level: c and f are those of a
    /// pair drawn from the √n pairs whose coarse values are nearest to x, and B is the slope of the
    /// linear regression. That is the regression's prediction with the residual of a near pair, so
    /// that scatter which the fine level adds is kept where it occurs, and a body that rests at
    /// the same place on both levels stays there.
    pub(crate) fn of(known: &Known<D>) -> Self {
        let finest = known.finest();
        let steps: Vec<Step<D>> = (1..=finest).map(|level| Step::of(known, level)).collect();
        let mut values = BTreeMap::new();
        for index in known.draws() {
            if let Some((level, Some(value))) = known.best(*index, finest) {
                let later = steps.iter().enumerate().skip(level);
                let on_finest = later.fold(value, |value, (before, step)| {
                    let place = [*index, before as u64];
                    step.corrected(value, &mut Random::new(Purpose::Residual, SEED, place))
                });
                values.insert(*index, on_finest.into());
            }
        }
        Self {
            unknown: (known.draws().len() - values.len()) as u64,
            means: LevelMeans::of(known),
            values,
        }
    }
}

/// Seed of the draws, the same for all studies.
const SEED: u64 = 3;

/// Correction from a level to the next finer one.
struct Step<const D: usize> {
    pairs: Vec<Pair<D>>,
    regression: Regression<D>,
}

impl<const D: usize> Step<D> {
    fn of(known: &Known<D>, level: usize) -> Self {
        let pairs = known.pairs(level);
        Self {
            regression: Regression::of(&pairs),
            pairs,
        }
    }

    fn corrected(&self, value: SVector<f64, D>, random: &mut Random) -> SVector<f64, D> {
        let near = (self.pairs.len() as f64).sqrt().ceil() as usize;
        let pair = self.nearest(value, random.below(near));
        pair.fine + self.regression.slope * (value - pair.coarse)
    }

    /// The pair with the coarse value of this rank by its distance from a value, 0 the nearest.
    fn nearest(&self, value: SVector<f64, D>, rank: usize) -> &Pair<D> {
        let distance =
            |(place, pair): (usize, &Pair<D>)| ((pair.coarse - value).norm_squared(), place);
        let mut distances: Vec<(f64, usize)> =
            self.pairs.iter().enumerate().map(distance).collect();
        let (_, (_, place), _) = distances.select_nth_unstable_by(rank, |one, other| {
            one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
        });
        &self.pairs[*place]
    }
}
