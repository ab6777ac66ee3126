//! The collapse on an increasing number of threads, and the bits of its final state.

use super::Effort;
use super::scenes::Collapse;
use super::stopwatch::{Length, Runner, StageLap, take_turns};
use crate::cli::columns::{millions, table};
use crate::cli::failure::Failure;
use crate::cli::machine::cores;
use serde::Serialize;

/// Sub-steps of a lap.
const LAP: u64 = 64;
/// Numbers of threads whose bits are compared, whatever the number of cores.
const COMPARED: [usize; 4] = [1, 2, 3, 7];
/// Every number of threads up to this one is timed, then every doubling.
const EVERY_NUMBER: usize = 8;

/// Speeds by the number of threads.
#[derive(Debug, Serialize)]
pub(super) struct Scaling {
    points: usize,
    /// True if all runs ended in the same bits.
    same_bits: bool,
    runs: Vec<Run>,
}

#[derive(Debug, Serialize)]
struct Run {
    threads: usize,
    point_steps_per_s: f64,
    over_one_thread: f64,
    /// BLAKE3 of the saved state after the last lap.
    state: String,
    measured: StageLap,
}

impl Run {
    fn of(runner: &Runner, on_one_thread: &Runner) -> Result<Self, Failure> {
        let simulation = &runner.simulation;
        let saved = simulation
            .save()
            .map_err(|error| Failure::Other(error.to_string()))?;
        Ok(Self {
            threads: simulation.threads(),
            point_steps_per_s: runner.median(StageLap::rate),
            over_one_thread: runner.ratio(on_one_thread, StageLap::rate),
            state: blake3::hash(&saved).to_hex().to_string(),
            measured: runner.total(),
        })
    }

    fn row(&self) -> [String; 4] {
        [
            self.threads.to_string(),
            millions(self.point_steps_per_s),
            format!("{:.2}", self.over_one_thread),
            self.state[..16].to_owned(),
        ]
    }
}

fn numbers_of_threads() -> Vec<usize> {
    let cores = cores();
    let doublings = (0..usize::BITS).map(|bit| 1 << bit);
    let beyond = doublings.take_while(|threads| *threads < cores);
    let mut threads: Vec<usize> = (1..=cores.min(EVERY_NUMBER)).chain(beyond).collect();
    threads.extend(COMPARED);
    threads.push(cores);
    threads.sort_unstable();
    threads.dedup();
    threads
}

/// Times the collapse on one thread up to all, and compares the final states.
pub(super) fn measure(effort: &Effort) -> Result<Scaling, Failure> {
    let scenario = Collapse::of(effort.points).scenario()?;
    let mut runners = Vec::new();
    for threads in numbers_of_threads() {
        runners.push(Runner::new(&scenario, threads)?.warmed_up()?);
    }
    take_turns(&mut runners, effort.repeats, |_| Length::Substeps(LAP))?;
    let first = &runners[0];
    let runs: Result<Vec<_>, _> = runners.iter().map(|run| Run::of(run, first)).collect();
    let runs = runs?;
    Ok(Scaling {
        points: first.simulation.point_count(),
        same_bits: runs.iter().all(|run| run.state == runs[0].state),
        runs,
    })
}

impl Scaling {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let bits = if self.same_bits { "the same" } else { "OTHER" };
        let title = format!(
            "threads: collapse of {} points; {bits} bits on any number",
            self.points
        );
        let headings = ["threads", "M point-steps/s", "x 1 thread", "state"];
        table(&title, headings, self.runs.iter().map(Run::row))
    }
}
