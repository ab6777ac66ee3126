//! Cost of a run, and the parts of its scene that it computes, found out before anything
//! runs (docs/method.md, section 12; docs/plan.md).

mod choices;
mod cost;
mod course;
mod hints;

pub use choices::Choice;
pub use cost::{Cost, Stage};
pub use hints::Hint;

use crate::error::SetupError;
use crate::scenario::Scenario;
use crate::simulation::Outline;
use serde::{Deserialize, Serialize};

/// Plan of a run: what it will compute, what it will leave out and why, what it will
/// cost, and what looks like a slip.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Each thing that could be left out.
    pub choices: Vec<Choice>,
    /// Things to look at once more before it runs.
    pub hints: Vec<Hint>,
    /// Cost of the run.
    pub cost: Cost,
}

/// The plan of a scenario's run.
///
/// # Errors
/// Too many points for one run, or a reduction asked for that the scene does not
/// allow.
pub fn of(scenario: &Scenario) -> Result<Plan, SetupError> {
    let outline = Outline::of(scenario)?;
    Ok(Plan {
        choices: choices::of(scenario, &outline),
        hints: hints::of(scenario, &outline),
        cost: Cost::of(scenario, &outline),
    })
}

/// Cost of a scenario's run.
///
/// # Errors
/// As for [`of`].
pub fn cost(scenario: &Scenario) -> Result<Cost, SetupError> {
    Ok(Cost::of(scenario, &Outline::of(scenario)?))
}
