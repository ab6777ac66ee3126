//! Members as they would have been on the finest level.

use super::known::Known;
use super::regression::{Regression, Row};
use crate::random::{Purpose, Random};
use nalgebra::SVector;
use std::collections::BTreeMap;

/// Seed of the draws, the same for all studies.
const SEED: u64 = 3;

/// A quantity of all draws on the finest level.
#[derive(Debug, Clone)]
pub(crate) struct Corrected<const D: usize> {
    /// Values by the index of the draw: of its run on the finest level if it has one, else the
    /// corrected value of its finest run.
    pub(crate) values: BTreeMap<u64, [f64; D]>,
    /// Number of draws without a value.
    pub(crate) unknown: u64,
}

impl<const D: usize> Corrected<D> {
    /// Values of what is known, corrected to the finest level that has enough pairs.
    ///
    /// From a level to the next finer one, a value becomes the regression's prediction and the
    /// residual of one of the √n pairs whose coarse values are nearest to it, so that scatter
    /// which the fine level adds is kept where it occurs. A value that the pair has exactly becomes
    /// the pair's: a body that rests at the same place on both levels stays there.
    pub(crate) fn of(known: &Known<D>) -> Self {
        let finest = known.finest();
        let steps: Vec<Step<D>> = (1..=finest).map(|level| Step::of(known, level)).collect();
        let mut values = BTreeMap::new();
        for index in known.draws() {
            if let Some((level, Some(value))) = known.best(*index, finest) {
                let inputs = known.inputs(*index);
                let later = steps.iter().enumerate().skip(level);
                let on_finest = later.fold(value, |value, (before, step)| {
                    let place = [*index, before as u64];
                    let mut random = Random::new(Purpose::Residual, SEED, place);
                    step.corrected(value, inputs, &mut random)
                });
                values.insert(*index, on_finest.into());
            }
        }
        Self {
            unknown: (known.draws().len() - values.len()) as u64,
            values,
        }
    }
}

/// Correction from a level to the next finer one.
struct Step<const D: usize> {
    pairs: Vec<Row<D>>,
    regression: Regression<D>,
}

impl<const D: usize> Step<D> {
    fn of(known: &Known<D>, level: usize) -> Self {
        let pairs = known.rows(level);
        Self {
            regression: Regression::of(&pairs),
            pairs,
        }
    }

    fn corrected(
        &self,
        value: SVector<f64, D>,
        inputs: &[f64],
        random: &mut Random,
    ) -> SVector<f64, D> {
        let near = (self.pairs.len() as f64).sqrt().ceil() as usize;
        let pair = self.nearest(value, random.below(near));
        if pair.coarse == Some(value) {
            return pair.value;
        }
        self.regression.predicted(Some(value), inputs) + self.regression.residual_of(pair)
    }

    /// The pair with the coarse value of this rank by its distance from a value, 0 the nearest.
    fn nearest(&self, value: SVector<f64, D>, rank: usize) -> &Row<D> {
        let distance = |(place, pair): (usize, &Row<D>)| {
            let distance = pair
                .coarse
                .map_or(f64::INFINITY, |one| (one - value).norm_squared());
            (distance, place)
        };
        let mut distances: Vec<(f64, usize)> =
            self.pairs.iter().enumerate().map(distance).collect();
        let (_, (_, place), _) = distances.select_nth_unstable_by(rank, |one, other| {
            one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
        });
        &self.pairs[*place]
    }
}
