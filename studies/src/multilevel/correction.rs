//! Members as they would have been on the finest level.

use super::known::Known;
use super::regression::{Regression, Row};
use crate::random::{Purpose, Random};
use nalgebra::SVector;
use std::collections::BTreeMap;

/// Seed of the draws, the same for all studies.
const SEED: u64 = 3;

/// Most pairs among which the nearest are sought, the first.
const LOOKED_AT: usize = 1024;

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
    /// the pair's: a body that rests at the same place on both levels stays there. A member whose pair
    /// has no value on the finer level has none either, so that runs which fail there count for
    /// all members.
    pub(crate) fn of(known: &Known<D>) -> Self {
        let finest = known.finest();
        let steps: Vec<Step<D>> = (1..=finest).map(|level| Step::of(known, level)).collect();
        let mut values = BTreeMap::new();
        for index in known.draws() {
            if let Some((level, Some(value))) = known.best(*index, finest) {
                let on_finest = match level < finest {
                    true => corrected(value, &steps[level..], &known.inputs(*index), *index),
                    false => Some(value),
                };
                values.extend(on_finest.map(|value| (*index, value.into())));
            }
        }
        Self {
            unknown: (known.draws().len() - values.len()) as u64,
            values,
        }
    }
}

/// Value of a member after the corrections to finer levels; none if it has none there.
fn corrected<const D: usize>(
    value: SVector<f64, D>,
    steps: &[Step<D>],
    inputs: &[f64],
    index: u64,
) -> Option<SVector<f64, D>> {
    steps.iter().try_fold(value, |value, step| {
        let mut random = Random::new(Purpose::Residual, SEED, [index, step.coarser as u64]);
        step.corrected(value, inputs, &mut random)
    })
}

/// Correction from a level to the next finer one.
struct Step<const D: usize> {
    /// The coarser level.
    coarser: usize,
    /// Coarse values of members with an outcome on the finer level, and what became of them there;
    /// none of a run that failed or lacks the quantity.
    pairs: Vec<(SVector<f64, D>, Option<Row<D>>)>,
    regression: Regression<D>,
}

impl<const D: usize> Step<D> {
    fn of(known: &Known<D>, level: usize) -> Self {
        let rows = known.rows(level);
        let regression = Regression::of(&rows);
        let mut pairs = known.pairs(level, rows);
        pairs.truncate(LOOKED_AT);
        Self {
            coarser: level - 1,
            pairs,
            regression,
        }
    }

    /// Value on the finer level; none if the pair drawn has none there.
    fn corrected(
        &self,
        value: SVector<f64, D>,
        inputs: &[f64],
        random: &mut Random,
    ) -> Option<SVector<f64, D>> {
        let near = (self.pairs.len() as f64).sqrt().ceil() as usize;
        let rank = random.below(near);
        let (coarse, pair) = self.nearest(value, rank, random.below(self.pairs.len()));
        let pair = pair.as_ref()?;
        if *coarse == value {
            return Some(pair.value);
        }
        Some(self.regression.predicted(Some(value), inputs) + self.regression.residual_of(pair))
    }

    /// The pair with the coarse value of this rank by its distance from a value, 0 the nearest; of
    /// equal distances the first from a place on.
    fn nearest(
        &self,
        value: SVector<f64, D>,
        rank: usize,
        from: usize,
    ) -> &(SVector<f64, D>, Option<Row<D>>) {
        let count = self.pairs.len();
        let distance = |place: usize| {
            let turned = (place + from) % count;
            ((self.pairs[turned].0 - value).norm_squared(), place)
        };
        let mut distances: Vec<(f64, usize)> = (0..count).map(distance).collect();
        let (_, (_, place), _) = distances.select_nth_unstable_by(rank, |one, other| {
            one.0.total_cmp(&other.0).then(one.1.cmp(&other.1))
        });
        &self.pairs[(*place + from) % count]
    }
}
