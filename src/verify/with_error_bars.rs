//! Answers with uncertainty intervals, computed in this process.

use super::run::{CaseError, scenario_of};
use crate::machine::cores;
use crate::runs::{NoSink, RunControl, RunEnd, RunError, convergence_study};
use scree_solver::record::Outcome;
use scree_solver::scenario::Ending;
use serde_json::Value;

/// The answer to a scenario, with the uncertainty intervals it asks for, for its whole duration.
///
/// # Errors
/// The scenario is refused, or its answer can't be computed.
pub(super) fn answer(document: &Value) -> Result<Outcome, CaseError> {
    let mut scenario = scenario_of(document)?;
    scenario.numerics.ending = Ending::Full;
    match convergence_study::run(&scenario, cores(), &RunControl::default(), &mut NoSink) {
        Ok(RunEnd::Completed(outcome)) => Ok(*outcome),
        Ok(RunEnd::Stopped) => Err(CaseError::Never("none of the runs could be computed")),
        Err(RunError::Setup(error)) => Err(error.into()),
        Err(RunError::Step(error)) => Err(error.into()),
        Err(RunError::Sink(never)) => match never {},
    }
}
