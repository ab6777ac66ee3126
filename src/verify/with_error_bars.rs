//! Answers with uncertainty intervals, computed in this process.

use super::run::{CaseError, Run, scenario_of};
use scree_solver::accuracy::ConvergenceStudy;
use scree_solver::record::{Outcome, Recorder};
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use serde_json::Value;
use std::ops::ControlFlow;

/// The answer to a scenario, with the uncertainty intervals it asks for.
///
/// # Errors
/// The scenario is refused, or its answer can't be computed.
pub(super) fn answer(document: &Value) -> Result<Outcome, CaseError> {
    let scenario = scenario_of(document)?;
    let mut convergence_study = ConvergenceStudy::of(&scenario)?;
    while let Some(study_run) = convergence_study.next() {
        match outcome(&convergence_study.scenario_of(study_run)) {
            Err(error) if !convergence_study.can_do_without(study_run) => return Err(error),
            outcome => convergence_study.take(outcome.map_err(|error| error.to_string())),
        }
    }
    let answer = convergence_study.finish();
    answer.ok_or(CaseError::Never("none of the runs could be computed"))
}

/// Outcome of one run of a scenario.
fn outcome(scenario: &Scenario) -> Result<Outcome, CaseError> {
    let prepared = PreparedScene::of(scenario)?;
    let mut recorder = Recorder::of(&prepared);
    let mut run = Run::start(prepared.scene())?;
    recorder.start(&run.simulation);
    run.watch(f64::INFINITY, |simulation, report| {
        recorder.observe(simulation, report);
        ControlFlow::Continue(())
    })?;
    Ok(recorder.outcome(&run.simulation, run.answer([]).cost.wall_s))
}
