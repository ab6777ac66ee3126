//! Watches a run between two sub-steps: handles records, progress, states and requests to
//! stop.

use super::control::{RunControl, Stop};
use super::pace::Pace;
use super::progress::Resources;
use super::run::Sink;
use super::saved_run::{self, Spent};
use scree_solver::record::{Outcome, Record, Recorder};
use scree_solver::{Simulation, SubstepReport};
use std::ops::ControlFlow;

/// Watch between a running simulation and the sink.
pub(super) struct Watch<'a, S: Sink> {
    recorder: Recorder,
    pace: Pace,
    control: &'a RunControl,
    sink: &'a mut S,
    refused: Option<S::Error>,
    /// True if the run ended because nothing can move any more.
    ended_early: bool,
    /// True once the run is over, not only stopped.
    is_over: bool,
    /// Solver threads that the run is to go on with.
    other_threads: Option<usize>,
}

impl<'a, S: Sink> Watch<'a, S> {
    pub(super) fn new(
        recorder: Recorder,
        spent: Spent,
        (control, sink): (&'a RunControl, &'a mut S),
    ) -> Self {
        Self {
            pace: Pace::new(&recorder, spent),
            recorder,
            control,
            sink,
            refused: None,
            ended_early: false,
            is_over: false,
            other_threads: None,
        }
    }

    /// Solver threads that the run was interrupted for to go on with.
    pub(super) fn take_other_threads(&mut self) -> Option<usize> {
        self.other_threads.take()
    }

    /// True if the run ended because nothing can move any more.
    pub(super) fn ended_early(&self) -> bool {
        self.ended_early
    }

    /// Passes on the records of time 0.
    pub(super) fn start(&mut self, simulation: &Simulation) -> Result<(), S::Error> {
        let records = self.recorder.start(simulation);
        self.hand_on(records)
    }

    /// Handles one sub-step.
    pub(super) fn observe(
        &mut self,
        simulation: &Simulation,
        report: &SubstepReport,
    ) -> ControlFlow<()> {
        // After a refusal or a stop request the solver still finishes the current
        // step: its records belong to the run, unless the sink has refused.
        if self.refused.is_some() {
            return ControlFlow::Break(());
        }
        self.pace.count(report, simulation.share());
        let (records, flow) = self.recorder.watch(simulation, report);
        if flow.is_break() {
            self.ended_early = true;
        }
        if self.ended_early || simulation.time_s() >= self.recorder.duration_s() {
            self.is_over = true;
        }
        // Read once: a request that arrives in between is handled next time.
        let stop = self.control.asked();
        let stop_here = stop == Stop::AtOnce || (stop == Stop::OnceSaved && report.step_ended);
        let taken = self
            .hand_on(records)
            .and_then(|()| self.tell_progress(simulation))
            .and_then(|()| self.save(simulation, report, stop));
        if let Err(error) = taken {
            self.refused = Some(error);
        }
        if self.refused.is_some() || stop_here || self.ended_early {
            return ControlFlow::Break(());
        }
        let other = self.control.threads();
        let other = other.filter(|threads| *threads != simulation.threads());
        if report.step_ended && other.is_some() {
            self.other_threads = other;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// Saves the state at the end of a step, if it is due or this is the last chance.
    fn save(
        &mut self,
        simulation: &Simulation,
        report: &SubstepReport,
        stop: Stop,
    ) -> Result<(), S::Error> {
        let wanted = |sink: &mut S| stop == Stop::OnceSaved || sink.wants_state();
        if !report.step_ended || stop == Stop::AtOnce || !wanted(self.sink) {
            return Ok(());
        }
        match saved_run::save(simulation, &self.recorder, self.pace.spent()) {
            Ok(state) => self.sink.state(report.time_s, &state),
            // The run itself will report the error.
            Err(error) => {
                tracing::warn!(%error, "the run's state can't be saved");
                Ok(())
            }
        }
    }

    /// The outcome, with the wall time of all attempts together.
    pub(super) fn outcome(&self, simulation: &Simulation) -> Outcome {
        self.recorder.outcome(simulation, self.pace.wall_s())
    }

    fn hand_on(&mut self, records: Vec<Record>) -> Result<(), S::Error> {
        records
            .into_iter()
            .try_for_each(|record| self.sink.record(record))
    }

    /// Passes on the maps of the flow at the end of the run.
    pub(super) fn hand_on_maps(&mut self, simulation: &Simulation) -> Result<(), S::Error> {
        match self.recorder.flow_maps(simulation) {
            Some(maps) => self.sink.flow_maps(&maps),
            None => Ok(()),
        }
    }

    fn tell_progress(&mut self, simulation: &Simulation) -> Result<(), S::Error> {
        let Some(progress) = self.pace.due(simulation, &self.recorder) else {
            return Ok(());
        };
        let (points, grid) = simulation.bytes();
        self.sink.resources(&Resources {
            memory_bytes: (points + grid) as u64,
            wall_s: self.pace.wall_s(),
        })?;
        self.sink.progress(&progress)
    }

    /// Reports the last progress, or the sink's refusal.
    pub(super) fn end(&mut self) -> Result<(), S::Error> {
        match self.refused.take() {
            Some(error) => Err(error),
            None => self.sink.progress(&self.pace.last(self.is_over)),
        }
    }
}
