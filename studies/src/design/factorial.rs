//! Full factorial design.

use super::limits;
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// All combinations of levels. The levels of an input are the middles of equally likely parts of
/// its distribution, the quantiles at (k + ½)/n, so all members are equally likely. The last input
/// changes fastest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = FullFactorialDesign))]
#[serde(deny_unknown_fields)]
pub struct FullFactorial {
    /// Numbers of levels.
    pub levels: LevelCounts,
}

/// Numbers of levels.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = FactorialLevels))]
#[serde(untagged)]
pub enum LevelCounts {
    /// One number for every input.
    Same(u64),
    /// A number for each input.
    Each(Vec<u64>),
}

impl FullFactorial {
    pub(super) fn members(&self, inputs: usize) -> u64 {
        let levels = (0..inputs).map(|input| self.levels_of(input));
        levels.fold(1, u64::saturating_mul)
    }

    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let mut left = index;
        let mut point = vec![0.0; inputs];
        for (input, coordinate) in point.iter_mut().enumerate().rev() {
            let levels = self.levels_of(input);
            *coordinate = limits::middle(left % levels, levels);
            left /= levels;
        }
        point
    }

    /// Number of levels of an input; one of an input that the list lacks, which is a violation.
    fn levels_of(&self, input: usize) -> u64 {
        match &self.levels {
            LevelCounts::Same(levels) => *levels,
            LevelCounts::Each(levels) => levels.get(input).copied().unwrap_or(1),
        }
    }

    pub(super) fn violations(&self, inputs: usize) -> Vec<Violation> {
        match &self.levels {
            LevelCounts::Same(levels) => limits::at_least("/levels", *levels, 1)
                .into_iter()
                .collect(),
            LevelCounts::Each(levels) if levels.len() == inputs => {
                let wrong = |(input, levels): (usize, &u64)| {
                    limits::at_least(&format!("/levels/{input}"), *levels, 1)
                };
                levels.iter().enumerate().filter_map(wrong).collect()
            }
            LevelCounts::Each(levels) => {
                let message = format!(
                    "levels has {} numbers, allowed: {inputs}, one for each input",
                    levels.len()
                );
                vec![Violation::new("/levels", message)]
            }
        }
    }
}
