//! `scree run`: one scenario, computed in this process.

use super::arguments::RunOptions;
use super::failure::{Failure, not_set_up};
use super::meter::Meter;
use super::output::OutputDirectory;
use super::{console, intervals, scenario_file, table};
use scree::results::{TrajectoryColumns, trajectory_json};
use scree::runs::{Progress, RunEnd, RunError, Sink, StopFlag, convergence_study};
use scree_solver::record::{FlowSnapshot, Outcome, Record, Sample};
use scree_solver::scenario::Scenario;
use std::convert::Infallible;

/// Computes a scenario, prints its outcome and writes its files.
///
/// # Errors
/// See [`Failure`]; after a numerical failure the trajectories up to it are
/// still written.
pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    let scenario = scenario_file::read(&options.scenario)?;
    let mut directory = options
        .out
        .as_deref()
        .map(OutputDirectory::create)
        .transpose()?;
    let threads = threads(options, &scenario);

    let mut recording = Recording::new(Meter::bar_or_silence());
    let ended = convergence_study::run(&scenario, threads, &StopFlag::default(), &mut recording);
    recording.meter.finish();

    if let Some(directory) = &mut directory {
        recording.write_trajectories(&scenario, directory)?;
    }
    let outcome = outcome_of(ended)?;
    if let Some(directory) = &mut directory {
        directory.outcome(&outcome)?;
        directory.pictures(
            &scenario,
            &recording.samples,
            &recording.snapshots,
            &outcome,
        )?;
    }
    if options.json {
        return Ok(console::answer(&serde_json::to_string_pretty(&outcome)?)?);
    }
    let mut answer = table::outcome(&outcome);
    if let Some(intervals) = intervals::intervals(&outcome) {
        answer = format!("{answer}\n{intervals}");
    }
    if let Some(directory) = &directory {
        answer = format!("{answer}\n\n{}", directory.summary());
    }
    Ok(console::answer(&answer)?)
}

/// The flag's number of threads, else the scenario's, else one per core.
fn threads(options: &RunOptions, scenario: &Scenario) -> usize {
    let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let asked = options
        .threads
        .map(usize::from)
        .or(scenario.numerics.threads);
    asked.unwrap_or_else(cores)
}

fn outcome_of(ended: Result<RunEnd, RunError<Infallible>>) -> Result<Box<Outcome>, Failure> {
    match ended {
        Ok(RunEnd::Completed(outcome)) => Ok(outcome),
        // No code raises the flag here; the message is for the case that this changes.
        Ok(RunEnd::Stopped) => Err(Failure::Other("the run was stopped".to_owned())),
        Err(RunError::Setup(error)) => Err(not_set_up(&error)),
        Err(RunError::Step(error)) => Err(Failure::Numerical(error.to_string())),
        Err(RunError::Sink(never)) => match never {},
    }
}

/// Keeps the records of a run in memory.
#[derive(Debug)]
struct Recording {
    samples: Vec<Sample>,
    snapshots: Vec<FlowSnapshot>,
    meter: Meter,
}

impl Recording {
    fn new(meter: Meter) -> Self {
        Self {
            samples: Vec::new(),
            snapshots: Vec::new(),
            meter,
        }
    }

    fn write_trajectories(
        &self,
        scenario: &Scenario,
        directory: &mut OutputDirectory,
    ) -> Result<(), Failure> {
        for body in 0..scenario.bodies.len() {
            let columns = TrajectoryColumns::of_body(&self.samples, body);
            let document = trajectory_json(None, body, &columns);
            directory.trajectory(body, document.as_bytes())?;
        }
        Ok(())
    }
}

impl Sink for Recording {
    type Error = Infallible;

    fn record(&mut self, record: Record) -> Result<(), Infallible> {
        match record {
            Record::Sample(sample) => self.samples.push(sample),
            Record::Snapshot(snapshot) => self.snapshots.push(snapshot),
        }
        Ok(())
    }

    fn progress(&mut self, progress: &Progress) -> Result<(), Infallible> {
        self.meter.show(progress);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scree_solver::{SetupError, StepError};

    /// Exit codes that scripts rely on: 2 for a scene too large to set up, 3 for
    /// a failed computation, 1 for failures of the machine.
    #[test]
    fn every_bad_end_has_its_exit_code() {
        let too_many = SetupError::TooManyPoints {
            points: 2,
            limit: 1,
            cell_size_m: 0.1,
        };
        let no_threads = SetupError::Threads {
            threads: 1,
            reason: "none left".to_owned(),
        };
        let step = StepError::NonFiniteBody {
            time_s: 0.5,
            body: 0,
            quantity: "velocity",
        };
        let ends = [
            (RunError::Setup(too_many), 2),
            (RunError::Step(step), 3),
            (RunError::Setup(no_threads), 1),
        ];
        for (end, code) in ends {
            let words = end.to_string();
            let failure = outcome_of(Err(end)).unwrap_err();
            assert_eq!(failure.exit_code(), code, "{words}");
            assert_eq!(failure.to_string(), words);
        }
    }
}
