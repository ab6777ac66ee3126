//! Scrambled Sobol' points.

use super::limits;
use crate::distribution::SMALLEST_PROBABILITY;
use crate::random::{self, Purpose};
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Points of one scrambled sequence, all that `sobol_burley` has.
const BLOCK: u64 = 1 << 16;

/// Sobol' points with nested uniform scrambling (Owen 1997) by hash (Burley 2020). Member i
/// depends on the seed and i alone, so a design can be enlarged. Each power of two of members is
/// balanced; beyond 2¹⁶ every further 2¹⁶ members have a scrambling of their own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = SobolDesign))]
#[serde(deny_unknown_fields)]
pub struct Sobol {
    /// Number of members, a power of two.
    pub members: u64,
    /// Seed of the scrambling.
    pub seed: u64,
}

impl Sobol {
    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let dimensions = 0..inputs;
        dimensions
            .map(|one| coordinate(self.seed, index, one))
            .collect()
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let members = limits::power_of_two("/members", self.members);
        members.into_iter().collect()
    }
}

/// Coordinate of a point in a dimension below [`DIMENSIONS`]: the middle of one of 2²³ steps.
pub(super) fn coordinate(seed: u64, index: u64, dimension: usize) -> f64 {
    let (block, within) = (index / BLOCK, index % BLOCK);
    let scrambling = random::key(Purpose::SobolBlock, seed, [block, 0]) as u32;
    let step = sobol_burley::sample(within as u32, dimension as u32, scrambling);
    f64::from(step) + SMALLEST_PROBABILITY
}
