//! A whole run of a scenario in one call.

use crate::error::{SetupError, StepError};
use crate::record::{Outcome, Record, Recorder};
use crate::scenario::Scenario;
use crate::simulation::{PreparedScene, Simulation};
use thiserror::Error;

/// Reason why a scenario could not be computed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ComputeError {
    /// The scenario is valid, but can't be set up: too many points, say.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The computation could not go on; the error names the time and the culprit.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// Computes a scenario on so many threads to its duration, or to the time at which nothing can
/// move a body or the front any more, and passes every record on as it arises. The result does
/// not depend on the number of threads. The wall time in the outcome is 0: the crate has no
/// clock.
///
/// # Errors
/// See [`ComputeError`].
pub fn compute(
    scenario: &Scenario,
    threads: usize,
    mut take: impl FnMut(Record) + Send,
) -> Result<Outcome, ComputeError> {
    let prepared = PreparedScene::of(scenario)?;
    let mut recorder = Recorder::of(&prepared);
    let mut simulation = Simulation::of(prepared, threads)?;
    recorder.start(&simulation).into_iter().for_each(&mut take);
    simulation.run(f64::INFINITY, |simulation, report| {
        let (records, flow) = recorder.watch(simulation, report);
        records.into_iter().for_each(&mut take);
        flow
    })?;
    Ok(recorder.outcome(&simulation, 0.0))
}
