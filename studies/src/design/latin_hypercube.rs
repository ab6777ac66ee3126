//! Latin hypercube.

use super::limits;
use crate::random::{self, Purpose, Random};
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Latin hypercube (McKay, Beckman & Conover 1979): each input's range is cut into as many equally
/// likely strata as there are members, and each stratum has one member at a random place in it.
/// It cannot be enlarged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = LatinHypercubeDesign))]
#[serde(deny_unknown_fields)]
pub struct LatinHypercube {
    /// Number of members.
    pub members: u64,
    /// Seed of the order of the strata and the places within.
    pub seed: u64,
}

impl LatinHypercube {
    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let coordinate = |input| {
            let key = random::key(Purpose::LatinStratum, self.seed, [input, 0]);
            let stratum = random::permuted(index, self.members, key);
            let place = Random::new(Purpose::LatinJitter, self.seed, [input, index]).unit();
            limits::clamped((stratum as f64 + place) / self.members as f64)
        };
        (0..inputs as u64).map(coordinate).collect()
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let members = limits::at_least("/members", self.members, 2);
        members.into_iter().collect()
    }
}
