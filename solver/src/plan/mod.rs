//! What a run will cost, and what of its scene it computes, found out before
//! anything runs (docs/method.md, section 12).

mod cost;

pub use cost::Cost;

use crate::error::SetupError;
use crate::scenario::Scenario;
use crate::simulation::Outline;

/// What a scenario's run will cost.
///
/// # Errors
/// Too many points for one run.
pub fn cost(scenario: &Scenario) -> Result<Cost, SetupError> {
    Ok(Cost::of(scenario, &Outline::of(scenario)?))
}
