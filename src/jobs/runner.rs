//! Runs one scenario: the simulation, watched by a recorder, into a sink. The
//! service's workers and the command line both run jobs through here.

use super::progress::Progress;
use scree_solver::record::{Outcome, Record, Recorder};
use scree_solver::scenario::Scenario;
use scree_solver::{Ending, SetupError, Simulation, StepError, SubstepReport};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use thiserror::Error;

/// How often a sink hears of progress at most: often enough for a progress
/// bar, rare enough to cost nothing.
const PROGRESS_INTERVAL: Duration = Duration::from_millis(100);

/// Where a run's records and progress go.
pub trait Sink: Send {
    /// Why the sink can't take any more; ends the run.
    type Error: Send;

    /// Takes a sample or a flow snapshot, in order of time.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn record(&mut self, record: Record) -> Result<(), Self::Error>;

    /// Hears how far the run is, about ten times a second and at the end.
    ///
    /// # Errors
    /// The sink's own; the run ends.
    fn progress(&mut self, progress: &Progress) -> Result<(), Self::Error>;
}

/// Asks a run to stop after the sub-step in hand. Raised once, never lowered.
#[derive(Debug, Default)]
pub struct StopFlag(AtomicBool);

impl StopFlag {
    /// Asks for the stop.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether a stop was asked for.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// How a run ended well.
#[derive(Debug, Clone, PartialEq)]
pub enum RunEnd {
    /// The simulated time is over.
    Completed(Box<Outcome>),
    /// The [`StopFlag`] was raised first; what was recorded stays valid.
    Stopped,
}

/// How a run ended badly.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RunError<E> {
    /// The solver can't set the scenario up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The computation can't go on; never worth retrying.
    #[error(transparent)]
    Step(#[from] StepError),
    /// The sink can't take any more.
    #[error("the results can't be kept: {0}")]
    Sink(E),
}

/// Runs `scenario` on `threads` solver threads from its start to its end or
/// until `stop` is raised.
///
/// # Errors
/// See [`RunError`]; what the sink had taken by then stays valid.
pub fn run<S: Sink>(
    scenario: &Scenario,
    threads: usize,
    stop: &StopFlag,
    sink: &mut S,
) -> Result<RunEnd, RunError<S::Error>> {
    let mut watch = Watch::new(scenario, stop, sink);
    let mut simulation = Simulation::new(scenario, threads)?;
    watch.start(&simulation).map_err(RunError::Sink)?;
    if scenario.duration_s > 0.0 {
        let ending = simulation.run(scenario.duration_s, |simulation, report| {
            watch.observe(simulation, report)
        });
        watch.end().map_err(RunError::Sink)?;
        if ending? == Ending::Interrupted && !watch.ended_early {
            return Ok(RunEnd::Stopped);
        }
    }
    let outcome = watch.recorder.outcome(&simulation, watch.pace.wall_s());
    Ok(RunEnd::Completed(Box::new(outcome)))
}

/// What stands between a running simulation and the sink.
struct Watch<'a, S: Sink> {
    recorder: Recorder,
    pace: Pace,
    stop: &'a StopFlag,
    sink: &'a mut S,
    refused: Option<S::Error>,
    /// Whether nothing can move any more.
    ended_early: bool,
}

impl<'a, S: Sink> Watch<'a, S> {
    fn new(scenario: &Scenario, stop: &'a StopFlag, sink: &'a mut S) -> Self {
        Self {
            recorder: Recorder::new(scenario),
            pace: Pace::new(scenario.duration_s),
            stop,
            sink,
            refused: None,
            ended_early: false,
        }
    }

    fn start(&mut self, simulation: &Simulation) -> Result<(), S::Error> {
        let records = self.recorder.start(simulation);
        self.hand_on(records)
    }

    fn observe(&mut self, simulation: &Simulation, report: &SubstepReport) -> ControlFlow<()> {
        // After a refusal or a wish to stop the solver still finishes the step
        // in hand: what it shows then belongs to the run, unless the sink is shut.
        if self.refused.is_some() {
            return ControlFlow::Break(());
        }
        self.pace.count(report);
        let mut records = self.recorder.observe(simulation, report);
        if report.sample.is_some() && report.time_s < self.pace.duration_s {
            records.extend(self.end_early(simulation));
        }
        let taken = self.hand_on(records).and_then(|()| self.tell_progress());
        if let Err(error) = taken {
            self.refused = Some(error);
        }
        if self.refused.is_some() || self.stop.is_raised() || self.ended_early {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }

    /// The last records, if nothing can move any more.
    fn end_early(&mut self, simulation: &Simulation) -> Vec<Record> {
        let last = self.recorder.end_early(simulation);
        if last.is_some() {
            self.ended_early = true;
            self.pace.duration_s = simulation.time_s();
        }
        last.unwrap_or_default()
    }

    fn hand_on(&mut self, records: Vec<Record>) -> Result<(), S::Error> {
        records
            .into_iter()
            .try_for_each(|record| self.sink.record(record))
    }

    fn tell_progress(&mut self) -> Result<(), S::Error> {
        match self.pace.due() {
            Some(progress) => self.sink.progress(&progress),
            None => Ok(()),
        }
    }

    fn end(&mut self) -> Result<(), S::Error> {
        match self.refused.take() {
            Some(error) => Err(error),
            None => self.sink.progress(&self.pace.progress()),
        }
    }
}

/// Counts and times a run.
struct Pace {
    began: Instant,
    told: Instant,
    duration_s: f64,
    simulated_time_s: f64,
    steps: u64,
    substeps: u64,
    point_steps: u64,
}

impl Pace {
    fn new(duration_s: f64) -> Self {
        let now = Instant::now();
        Self {
            began: now,
            told: now,
            duration_s,
            simulated_time_s: 0.0,
            steps: 0,
            substeps: 0,
            point_steps: 0,
        }
    }

    fn count(&mut self, report: &SubstepReport) {
        self.simulated_time_s = report.time_s;
        self.steps = report.steps;
        self.substeps = report.substeps;
        self.point_steps += report.points;
    }

    fn wall_s(&self) -> f64 {
        self.began.elapsed().as_secs_f64()
    }

    /// Progress, if it was last told long enough ago.
    fn due(&mut self) -> Option<Progress> {
        if self.told.elapsed() < PROGRESS_INTERVAL {
            return None;
        }
        self.told = Instant::now();
        Some(self.progress())
    }

    fn progress(&self) -> Progress {
        let wall_s = self.wall_s();
        let fraction = (self.simulated_time_s / self.duration_s).clamp(0.0, 1.0);
        let going = fraction > 0.0 && fraction < 1.0;
        Progress {
            fraction,
            simulated_time_s: self.simulated_time_s,
            steps: self.steps,
            substeps: self.substeps,
            point_steps_per_s: if wall_s > 0.0 {
                self.point_steps as f64 / wall_s
            } else {
                0.0
            },
            eta_s: going.then(|| wall_s * (1.0 - fraction) / fraction),
        }
    }
}
