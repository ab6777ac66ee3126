//! What is known of a quantity on each level.

use super::regression::{FEWEST_PAIRS, Row};
use crate::outcome::{Finished, Member, MemberOutcome};
use crate::study::Ensemble;
use nalgebra::SVector;
use std::collections::BTreeMap;

/// Quantity with `D` components in the members that are draws.
#[derive(Debug, Clone)]
pub(crate) struct Known<const D: usize> {
    /// Indices of the draws.
    draws: Vec<u64>,
    /// Values of the runs that have an outcome, by level and index; none of a run that failed or
    /// lacks the quantity.
    levels: Vec<BTreeMap<u64, Option<SVector<f64, D>>>>,
    /// Functions of the inputs of the members that have an outcome, by the index: see
    /// [`Ensemble::centred_functions`].
    inputs: BTreeMap<u64, Vec<f64>>,
    /// Cell size of each level [m]; none of a study on one level.
    cell_sizes_m: Vec<f64>,
}

impl<const D: usize> Known<D> {
    /// What members have of a quantity. Members that the study does not have (any more) are left
    /// out.
    pub(crate) fn of(
        ensemble: &Ensemble,
        members: &[Member],
        quantity: impl Fn(&Finished) -> Option<[f64; D]>,
    ) -> Self {
        let study = ensemble.study();
        let mut levels = vec![BTreeMap::new(); study.levels() as usize];
        let mut functions = BTreeMap::new();
        let (design, inputs) = (&study.design, ensemble.inputs());
        for member in members {
            let has = member.index < study.members_on(member.level);
            let value = match &member.outcome {
                MemberOutcome::Finished(finished) => quantity(finished).map(SVector::from),
                MemberOutcome::Failed(_) => None,
                MemberOutcome::Pending => continue,
            };
            if has && design.is_draw(member.index, inputs) {
                levels[member.level as usize].insert(member.index, value);
                let of_inputs = || ensemble.centred_functions(member.index);
                functions.entry(member.index).or_insert_with(of_inputs);
            }
        }
        let draws = (0..ensemble.members()).filter(|index| design.is_draw(*index, inputs));
        let cell_sizes_m = (0..study.levels()).map(|level| study.cell_size_m(level));
        Self {
            draws: draws.collect(),
            levels,
            inputs: functions,
            cell_sizes_m: cell_sizes_m.collect::<Option<_>>().unwrap_or_default(),
        }
    }

    /// Indices of the draws.
    pub(crate) fn draws(&self) -> &[u64] {
        &self.draws
    }

    /// Cell size of a level [m], of a study with several.
    pub(super) fn cell_size_m(&self, level: usize) -> f64 {
        self.cell_sizes_m.get(level).copied().unwrap_or(f64::NAN)
    }

    /// Finest level with enough pairs with the next coarser one, on which all coarser ones have
    /// enough, too.
    pub(crate) fn finest(&self) -> usize {
        let enough = |level: &usize| self.pairs(*level) >= FEWEST_PAIRS;
        (1..self.levels.len()).take_while(enough).count()
    }

    /// Number of members with a value on a level and on the next coarser one.
    fn pairs(&self, level: usize) -> usize {
        let coarse = |index: &u64| matches!(self.levels[level - 1].get(index), Some(Some(_)));
        let values = self.levels[level].iter();
        values
            .filter(|(index, value)| value.is_some() && coarse(index))
            .count()
    }

    /// Functions of the inputs of a member that has an outcome.
    pub(super) fn inputs(&self, index: u64) -> &[f64] {
        self.inputs.get(&index).map_or(&[], |inputs| inputs)
    }

    /// Members with a value on a level and, but for the coarsest, on the next coarser one, by the
    /// index.
    pub(super) fn rows(&self, level: usize) -> Vec<Row<D>> {
        let of_one = |(index, value): (&u64, &Option<SVector<f64, D>>)| {
            let coarse = match level.checked_sub(1) {
                Some(coarser) => Some((*self.levels[coarser].get(index)?)?),
                None => None,
            };
            Some(Row {
                index: *index,
                coarse,
                inputs: self.inputs(*index).to_vec(),
                value: (*value)?,
            })
        };
        self.levels[level].iter().filter_map(of_one).collect()
    }

    /// Finest run of a draw up to a level that has an outcome: its level, and the value if it has
    /// one.
    pub(crate) fn best(
        &self,
        index: u64,
        finest: usize,
    ) -> Option<(usize, Option<SVector<f64, D>>)> {
        let of_level = |level: usize| Some((level, *self.levels[level].get(&index)?));
        (0..=finest).rev().find_map(of_level)
    }
}
