//! Turns what a run shows into records and an outcome.

use super::{Outcome, Record};
use crate::scenario::Scenario;
use crate::simulation::{Simulation, SubstepReport};

/// Watches a run: call [`Recorder::start`] once, [`Recorder::observe`] from the
/// run's observer, and [`Recorder::outcome`] at the end.
#[derive(Debug)]
pub struct Recorder {}

impl Recorder {
    /// A recorder for this scenario.
    pub fn new(_scenario: &Scenario) -> Self {
        todo!()
    }

    /// The records of time 0.
    pub fn start(&mut self, _simulation: &Simulation) -> Vec<Record> {
        todo!()
    }

    /// Takes one sub-step in; returns what is to be recorded then (mostly nothing).
    pub fn observe(&mut self, _simulation: &Simulation, _report: &SubstepReport) -> Vec<Record> {
        todo!()
    }

    /// The outcome so far, with the wall time the caller measured [s].
    pub fn outcome(&self, _simulation: &Simulation, _wall_s: f64) -> Outcome {
        todo!()
    }
}
