//! Known values of a quantity on each level.

use super::regression::{FEWEST_PAIRS, Row};
use crate::outcome::{Finished, Member, MemberOutcome};
use crate::study::Ensemble;
use nalgebra::SVector;
use std::collections::BTreeMap;

/// Most members on a level whose inputs are looked at: of more, the plain mean is certain enough.
const LOOKED_AT: usize = 1 << 14;

/// Quantity with `D` components in the members that are draws.
#[derive(Debug, Clone)]
pub(crate) struct Known<'a, const D: usize> {
    ensemble: &'a Ensemble<'a>,
    /// Indices of the draws.
    draws: Vec<u64>,
    /// Values of the runs that have an outcome, by level and index; none of a run that failed or
    /// lacks the quantity.
    levels: Vec<BTreeMap<u64, Option<SVector<f64, D>>>>,
    /// Cell size of each level [m]; none of a study on one level.
    cell_sizes_m: Vec<f64>,
}

impl<'a, const D: usize> Known<'a, D> {
    /// Values that members have of a quantity. Members that the study does not have (any more) are
    /// left out.
    pub(crate) fn of(
        ensemble: &'a Ensemble<'a>,
        members: &[Member],
        quantity: impl Fn(&Finished) -> Option<[f64; D]>,
    ) -> Self {
        let study = ensemble.study();
        let mut levels = vec![BTreeMap::new(); study.levels() as usize];
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
            }
        }
        let draws = (0..ensemble.members()).filter(|index| design.is_draw(*index, inputs));
        let cell_sizes_m = (0..study.levels()).map(|level| study.cell_size_m(level));
        Self {
            ensemble,
            draws: draws.collect(),
            levels,
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
        let enough = |level: &usize| self.pairs_with_values(*level) >= FEWEST_PAIRS;
        (1..self.levels.len()).take_while(enough).count()
    }

    /// Number of members with a value on a level and on the next coarser one.
    fn pairs_with_values(&self, level: usize) -> usize {
        let coarse = |index: &u64| matches!(self.levels[level - 1].get(index), Some(Some(_)));
        let values = self.levels[level].iter();
        values
            .filter(|(index, value)| value.is_some() && coarse(index))
            .count()
    }

    /// Functions of the inputs of a member: see [`Ensemble::centred_functions`].
    pub(super) fn inputs(&self, index: u64) -> Vec<f64> {
        self.ensemble.centred_functions(index)
    }

    /// Members with a value on a level and, but for the coarsest, on the next coarser one, by the
    /// index; without functions of their inputs if they are very many.
    pub(super) fn rows(&self, level: usize) -> Vec<Row<D>> {
        let are_inputs_of_use = self.levels[level].len() <= LOOKED_AT;
        let of_one = |(index, value): (&u64, &Option<SVector<f64, D>>)| {
            let coarse = match level.checked_sub(1) {
                Some(coarser) => Some((*self.levels[coarser].get(index)?)?),
                None => None,
            };
            Some(Row {
                index: *index,
                coarse,
                inputs: match are_inputs_of_use {
                    true => self.inputs(*index),
                    false => Vec::new(),
                },
                value: (*value)?,
            })
        };
        self.levels[level].iter().filter_map(of_one).collect()
    }

    /// Coarse values of the members with an outcome on a level, by the index, and their rows there,
    /// of all of these; none of those without a value.
    pub(super) fn pairs(
        &self,
        level: usize,
        rows: Vec<Row<D>>,
    ) -> Vec<(SVector<f64, D>, Option<Row<D>>)> {
        let rows = rows.into_iter().map(|row| (row.index, row));
        let mut rows: BTreeMap<u64, Row<D>> = rows.collect();
        let coarser = &self.levels[level - 1];
        let outcomes = self.levels[level].keys();
        outcomes
            .filter_map(|index| Some(((*coarser.get(index)?)?, rows.remove(index))))
            .collect()
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

impl<'a> Known<'a, 1> {
    /// Values of a quantity by name, of a body or of the whole run.
    pub(crate) fn of_quantity(
        ensemble: &'a Ensemble<'a>,
        members: &[Member],
        (name, body): (&str, Option<usize>),
    ) -> Self {
        Self::of(ensemble, members, |finished| {
            finished.quantity(name, body).map(|value| [value])
        })
    }
}
