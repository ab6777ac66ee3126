//! One input at a time.

use super::limits;
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// One input after the other at each of its levels, all others at their medians. Member 0 has all
/// inputs at their medians, which an odd number of levels does not repeat. The levels are the
/// quantiles at (k + ½)/n.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = OneAtATimeDesign))]
#[serde(deny_unknown_fields)]
pub struct OneAtATime {
    /// Number of levels of each input, at least 2.
    pub levels: u64,
}

impl OneAtATime {
    pub(super) fn members(&self, inputs: usize) -> u64 {
        self.moved().saturating_mul(inputs as u64).saturating_add(1)
    }

    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let mut point = vec![0.5; inputs];
        if index > 0 {
            let (input, step) = ((index - 1) / self.moved(), (index - 1) % self.moved());
            let skips = !self.levels.is_multiple_of(2) && step >= self.levels / 2;
            point[input as usize] = limits::middle(step + u64::from(skips), self.levels);
        }
        point
    }

    /// Levels of an input that are not its median.
    fn moved(&self) -> u64 {
        self.levels - self.levels % 2
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let levels = limits::at_least("/levels", self.levels, 2);
        levels.into_iter().collect()
    }
}
