//! The simulation: step and run.

use crate::error::{RestoreError, SetupError, StepError};
use crate::scenario::Scenario;
use std::ops::ControlFlow;

/// A run in progress.
#[derive(Debug)]
pub struct Simulation {}

/// What one acoustic sub-step did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SubstepReport {
    /// Simulated time at its end [s].
    pub time_s: f64,
    /// Its length [s].
    pub substep_s: f64,
    /// Sub-steps so far, this one included.
    pub substeps: u64,
    /// Steps (transfers) finished so far.
    pub steps: u64,
    /// Points that took part.
    pub points: u64,
    /// This sub-step ended a step: the points' own state is up to date.
    pub step_ended: bool,
    /// Index k of the sample time reached (time = k · interval, or the end).
    pub sample: Option<u64>,
}

/// Why a run came back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// It reached the time asked for.
    Reached,
    /// The observer asked it to stop; the state is sound and can be saved.
    Interrupted,
}

impl Simulation {
    /// Sets a scenario up on `threads` solver threads.
    pub fn new(_scenario: &Scenario, _threads: usize) -> Result<Self, SetupError> {
        todo!()
    }

    /// Simulated time [s].
    pub fn time_s(&self) -> f64 {
        todo!()
    }

    /// Runs to the first step end at or after `until_s` (never beyond the
    /// scenario's duration), calling `observe` after every sub-step. On
    /// `Break` the step in hand is finished first, so the state is whole.
    pub fn run(
        &mut self,
        _until_s: f64,
        _observe: impl FnMut(&Simulation, &SubstepReport) -> ControlFlow<()>,
    ) -> Result<Ending, StepError> {
        todo!()
    }

    /// The whole state as bytes.
    pub fn save(&self) -> Vec<u8> {
        todo!()
    }

    /// Takes up a saved state: the run goes on with the same bits.
    pub fn restore(
        _scenario: &Scenario,
        _threads: usize,
        _saved: &[u8],
    ) -> Result<Self, RestoreError> {
        todo!()
    }
}
