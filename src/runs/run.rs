//! One run of a scenario: the simulation, with a recorder, into a sink.

use super::control::RunControl;
use super::progress::{Progress, Resources};
use super::saved_run::{self, SavedRunError, Spent};
use super::watch::Watch;
use scree_solver::record::{FlowMaps, Outcome, Record, Recorder};
use scree_solver::scenario::Scenario;
use scree_solver::simulation::PreparedScene;
use scree_solver::{Ending, SetupError, Simulation, StepError};
use std::convert::Infallible;
use thiserror::Error;

/// Sink of a run's records and progress.
pub trait Sink: Send {
    /// Reason why the sink can't take any more; ends the run.
    type Error: Send;

    /// Takes a sample or a flow snapshot, in order of time.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn record(&mut self, record: Record) -> Result<(), Self::Error>;

    /// Takes the maps of the flow on a terrain, once the run is over.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn flow_maps(&mut self, _maps: &FlowMaps) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Takes the progress of the run, about ten times a second and at the end.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn progress(&mut self, progress: &Progress) -> Result<(), Self::Error>;

    /// Takes the memory that a run is planned to need [bytes], before it is set up.
    ///
    /// # Errors
    /// The sink's own; the run is not set up.
    fn before_set_up(&mut self, _memory_bytes: u64) -> Result<(), Self::Error> {
        Ok(())
    }

    /// Takes the resources that a run uses, whenever its progress is told.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn resources(&mut self, _used: &Resources) -> Result<(), Self::Error> {
        Ok(())
    }

    /// True if it is time to save the run's state. Called wherever a state can be saved; a
    /// sink that keeps no states always returns false.
    fn wants_state(&mut self) -> bool {
        false
    }

    /// Takes the run's state after all records so far; [`Run::restored`] restores
    /// the run from it.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn state(&mut self, _time_s: f64, _state: &[u8]) -> Result<(), Self::Error> {
        Ok(())
    }
}

/// A sink that keeps nothing: for the outcome alone.
#[derive(Debug)]
pub struct NoSink;

impl Sink for NoSink {
    type Error = Infallible;

    fn record(&mut self, _: Record) -> Result<(), Infallible> {
        Ok(())
    }

    fn progress(&mut self, _: &Progress) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Regular end of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum RunEnd {
    /// The simulated time is over.
    Completed(Box<Outcome>),
    /// The [`RunControl`] asked it to stop first; the records so far stay valid.
    Stopped,
}

/// Error of a run.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError<E> {
    /// The solver can't set the scenario up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The computation can't go on; a retry would fail again.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The sink can't take any more.
    #[error("the results can't be kept: {0}")]
    Sink(E),
}

/// Runs `scenario` on `threads` solver threads from its start to its end or
/// until `control` asks it to stop.
///
/// # Errors
/// See [`RunError`]; records that the sink has taken stay valid.
pub fn run<S: Sink>(
    scenario: &Scenario,
    threads: usize,
    control: &RunControl,
    sink: &mut S,
) -> Result<RunEnd, RunError<S::Error>> {
    Run::afresh(scenario, threads)?.go(control, sink)
}

/// A run that is set up and not started yet.
#[derive(Debug)]
pub struct Run {
    simulation: Simulation,
    recorder: Recorder,
    spent: Spent,
}

impl Run {
    /// A run at the start of a scenario.
    ///
    /// # Errors
    /// The solver can't set it up.
    pub fn afresh(scenario: &Scenario, threads: usize) -> Result<Self, SetupError> {
        Self::of(PreparedScene::of(scenario)?, threads)
    }

    /// A run at the start of a prepared scene.
    ///
    /// # Errors
    /// The solver can't set it up.
    pub fn of(prepared: PreparedScene, threads: usize) -> Result<Self, SetupError> {
        Ok(Self {
            recorder: Recorder::of(&prepared),
            spent: Spent::default(),
            simulation: Simulation::of(prepared, threads)?,
        })
    }

    /// A run restored from a saved `state`; it continues with the same bits.
    ///
    /// # Errors
    /// The bytes are not a state of this scenario and this build.
    pub fn restored(
        scenario: &Scenario,
        threads: usize,
        state: &[u8],
    ) -> Result<Self, SavedRunError> {
        let (simulation, recorder, spent) = saved_run::restore(scenario, threads, state)?;
        Ok(Self {
            simulation,
            recorder,
            spent,
        })
    }

    /// Runs to the scenario's end or until `control` asks it to stop.
    ///
    /// # Errors
    /// See [`RunError`]; records that the sink has taken stay valid.
    pub fn go<S: Sink>(
        self,
        control: &RunControl,
        sink: &mut S,
    ) -> Result<RunEnd, RunError<S::Error>> {
        let Self {
            mut simulation,
            recorder,
            spent,
        } = self;
        simulation.cancel_with(control.cancellation());
        let duration_s = recorder.duration_s();
        let mut watch = Watch::new(recorder, spent, (control, sink));
        let (_, substeps, _) = simulation.counts();
        if substeps == 0 {
            watch.start(&simulation).map_err(RunError::Sink)?;
        }
        if duration_s > 0.0 {
            let ending = loop {
                let ending = simulation.run(duration_s, |simulation, report| {
                    watch.observe(simulation, report)
                });
                match watch.take_other_threads() {
                    Some(threads) if ending.is_ok() => simulation.set_threads(threads)?,
                    _ => break ending,
                }
            };
            watch.end().map_err(RunError::Sink)?;
            if ending? == Ending::Interrupted && !watch.ended_early() {
                return Ok(RunEnd::Stopped);
            }
        }
        watch.hand_on_maps(&simulation).map_err(RunError::Sink)?;
        Ok(RunEnd::Completed(Box::new(watch.outcome(&simulation))))
    }
}
