//! Design for Sobol' indices.

use super::{limits, sobol};
use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Two independent samples A and B, and for each input i the mixture AB_i, A with the column i of
/// B (Saltelli et al. 2010). A and B are the first and second half of the dimensions of one
/// sequence of Sobol' points. The members of a row follow each other, A, B, AB_0, AB_1, …, so a
/// design can be enlarged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = SaltelliDesign))]
#[serde(deny_unknown_fields)]
pub struct Saltelli {
    /// Number N of rows, a power of two; there are N (d + 2) members for d inputs.
    pub base_members: u64,
    /// Seed of the scrambling.
    pub seed: u64,
}

impl Saltelli {
    pub(super) fn point(&self, index: u64, inputs: usize) -> Vec<f64> {
        let members = inputs as u64 + 2;
        let (row, column) = (index / members, (index % members) as usize);
        let from_b = |input: usize| column == 1 || column == input + 2;
        let dimension = |input| if from_b(input) { inputs + input } else { input };
        let coordinate = |input| sobol::coordinate(self.seed, row, dimension(input));
        (0..inputs).map(coordinate).collect()
    }

    pub(super) fn violations(&self) -> Vec<Violation> {
        let members = limits::power_of_two("/base_members", self.base_members);
        members.into_iter().collect()
    }
}
