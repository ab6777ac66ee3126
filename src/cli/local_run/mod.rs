//! `scree run`: one scenario, computed in this process.

mod ending;
mod job;
mod recording;
mod schedule;

use super::arguments::RunOptions;
use super::console;
use super::failure::{Failure, not_set_up};
use super::files::FileError;
use super::interrupts::Interrupts;
use super::machine::cores;
use super::results_folder::Place;
use super::{intervals, table};
use job::{Asked, Job, Start};
use recording::Recording;
use scree::runs::{RunEnd, RunError, Stop};
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;

/// Computes a scenario, writes its files and prints its outcome.
///
/// # Errors
/// See [`Failure`]; after a numerical failure the trajectories up to it are
/// still written.
pub(super) fn run(options: &RunOptions) -> Result<(), Failure> {
    match Asked::of(options)? {
        Asked::Compute(job) => compute(*job, options),
        Asked::Delivered(folder, Place::Whole) => {
            let path = folder.path().display().to_string();
            answer(&folder.outcome()?, Some(&path), options.json)
        }
        Asked::Delivered(folder, Place::Failed) => Err(Failure::Numerical(format!(
            "the run had failed; its trajectories are in {}",
            folder.of(Place::Failed).display()
        ))),
    }
}

fn compute(mut job: Job, options: &RunOptions) -> Result<(), Failure> {
    // Only from here on: until the run begins, Ctrl-C ends the process as it does any other.
    let interrupts = Interrupts::watch(match job.folder {
        Some(_) => Stop::OnceSaved,
        None => Stop::AtOnce,
    })?;
    let Start {
        runs,
        records,
        saved,
    } = job.start(threads(options, &job.scenario))?;
    let mut recording = Recording::new(records, saved, interrupts.stop(), options.quiet.meter());
    let ended = runs.go(interrupts.stop(), &mut recording);
    recording.meter.finish();
    let fraction = recording.fraction;
    let recorded = recording.into_parts();
    match ended {
        Ok(RunEnd::Completed(outcome)) => {
            let written = job.completed(&recorded, &outcome)?;
            answer(&outcome, written.as_deref(), options.json)
        }
        Ok(RunEnd::Stopped) => Err(job.stopped(&interrupts, fraction)),
        Err(error @ RunError::Step(_)) => Err(job.failed(&recorded, &failure(&error))),
        Err(error @ RunError::Setup(_)) => Err(job.given_up(failure(&error))),
        Err(error @ RunError::Sink(_)) => Err(job.broken_off(&failure(&error))),
    }
}

/// Prints the outcome, and where the files are.
fn answer(outcome: &Outcome, written: Option<&str>, json: bool) -> Result<(), Failure> {
    let text = if json {
        serde_json::to_string_pretty(outcome)?
    } else {
        in_words(outcome, written)
    };
    let printed = match written {
        Some(_) => console::answer(&text),
        None => console::only_answer(&text),
    };
    Ok(printed?)
}

fn in_words(outcome: &Outcome, written: Option<&str>) -> String {
    let mut answer = table::outcome(outcome);
    if let Some(intervals) = intervals::intervals(outcome) {
        answer = format!("{answer}\n{intervals}");
    }
    if let Some(written) = written {
        answer = format!("{answer}\n\nwritten to {written}");
    }
    answer
}

/// The flag's number of threads, else the scenario's, else one per core.
fn threads(options: &RunOptions, scenario: &Scenario) -> usize {
    let asked = options
        .threads
        .map(usize::from)
        .or(scenario.numerics.threads);
    asked.unwrap_or_else(cores)
}

/// Failure of a run, by the person who can act on it.
fn failure(error: &RunError<FileError>) -> Failure {
    match error {
        RunError::Setup(error) => not_set_up(error),
        RunError::Step(error) => Failure::Numerical(error.to_string()),
        RunError::Sink(error) => Failure::Other(error.to_string()),
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
            let failure = failure(&end);
            assert_eq!(failure.exit_code(), code, "{words}");
            assert_eq!(failure.to_string(), words);
        }
    }
}
