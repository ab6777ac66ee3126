//! Rank correlations of the inputs, by a Gaussian copula (Iman & Conover 1982).

mod copula;

pub use copula::{Copula, NotPositiveDefinite};

use crate::study::Violation;
use serde::{Deserialize, Serialize};

/// Rank correlation of two inputs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Correlation {
    /// Indices of the two inputs in the list of inputs.
    pub inputs: [usize; 2],
    /// Spearman's rank correlation ρ, −1 < ρ < 1. Where a discrete distribution ties many values,
    /// that of the drawn values is nearer to 0.
    pub rank: f64,
}

impl Correlation {
    /// Inputs in ascending order.
    fn pair(&self) -> (usize, usize) {
        let [one, other] = self.inputs;
        (one.min(other), one.max(other))
    }

    fn violations(&self, inputs: usize) -> Vec<Violation> {
        let mut found = Vec::new();
        for (place, input) in self.inputs.iter().enumerate() {
            if *input >= inputs {
                let allowed = format!("an index below {inputs}, the number of inputs");
                found.push(Violation::of(&format!("/inputs/{place}"), input, allowed));
            }
        }
        if self.inputs[0] == self.inputs[1] {
            let message = format!("inputs is twice {}, allowed: two inputs", self.inputs[0]);
            found.push(Violation::new("/inputs", message));
        }
        if !(self.rank > -1.0 && self.rank < 1.0) {
            found.push(Violation::of("/rank", self.rank, "-1 < x < 1"));
        }
        found
    }
}

/// Violations of a list of correlations between so many inputs.
pub(crate) fn violations(correlations: &[Correlation], inputs: usize) -> Vec<Violation> {
    let mut found = Vec::new();
    for (place, correlation) in correlations.iter().enumerate() {
        let mut of_one = correlation.violations(inputs);
        let earlier = &correlations[..place];
        if let Some(first) = earlier
            .iter()
            .position(|one| one.pair() == correlation.pair())
        {
            let message = format!("inputs has the pair of correlation {first} again");
            of_one.push(Violation::new("/inputs", message));
        }
        found.extend(Violation::under(&format!("/{place}"), of_one));
    }
    if found.is_empty()
        && let Err(wrong) = Copula::new(inputs, correlations)
    {
        found.push(Violation::new("", wrong.to_string()));
    }
    found
}
