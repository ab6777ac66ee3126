//! Times simulations lap by lap, in turns.

use crate::cli::failure::{Failure, not_set_up};
use scree_solver::scenario::Scenario;
use scree_solver::simulation::Scene;
use scree_solver::{Instructions, Simulation};
use serde::Serialize;
use std::ops::ControlFlow;
use std::time::Instant;

/// Sub-steps taken before the first lap.
const WARM_UP: u64 = 16;

/// Length of a lap; it always ends with a step.
#[derive(Debug, Clone, Copy)]
pub(super) enum Length {
    /// This many sub-steps or a few more.
    Substeps(u64),
    /// This much simulated time or a little more [s].
    Simulated(f64),
}

/// Counts and times of a lap, or of several.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct StageLap {
    /// Wall time [s].
    pub(super) wall_s: f64,
    /// Simulated time [s].
    pub(super) simulated_s: f64,
    /// Transfers.
    pub(super) steps: u64,
    /// Sub-steps.
    pub(super) substeps: u64,
    /// Sub-steps summed over the points.
    pub(super) point_steps: u64,
}

impl StageLap {
    /// Point-steps per second of wall time.
    pub(super) fn rate(&self) -> f64 {
        self.point_steps as f64 / self.wall_s
    }

    /// Wall time per simulated time.
    pub(super) fn wall_per_simulated(&self) -> f64 {
        self.wall_s / self.simulated_s
    }
}

/// A simulation that is timed, and its laps.
#[derive(Debug)]
pub(super) struct Runner {
    pub(super) simulation: Simulation,
    pub(super) stages: Vec<StageLap>,
}

impl Runner {
    /// Sets a scenario up, without reductions.
    pub(super) fn new(scenario: &Scenario, threads: usize) -> Result<Self, Failure> {
        let scene = Scene::whole(scenario).map_err(|error| not_set_up(&error))?;
        let simulation =
            Simulation::of_scene(scene, threads).map_err(|error| not_set_up(&error))?;
        let stages = Vec::new();
        Ok(Self { simulation, stages })
    }

    /// Uses these instructions, or the best available below them.
    pub(super) fn with(mut self, instructions: Instructions) -> Self {
        self.simulation.limit_instructions(instructions);
        self
    }

    /// Takes the first steps, which touch all memory for the first time.
    pub(super) fn warmed_up(mut self) -> Result<Self, Failure> {
        self.go(Length::Substeps(WARM_UP))?;
        Ok(self)
    }

    /// Runs to a simulated time without timing it.
    pub(super) fn skipped_to(mut self, time_s: f64) -> Result<Self, Failure> {
        self.go(Length::Simulated(time_s - self.simulation.time_s()))?;
        Ok(self)
    }

    /// Runs one lap.
    pub(super) fn lap(&mut self, length: Length) -> Result<(), Failure> {
        let lap = self.go(length)?;
        self.stages.push(lap);
        Ok(())
    }

    fn go(&mut self, length: Length) -> Result<StageLap, Failure> {
        let simulation = &mut self.simulation;
        let (steps, substeps, point_steps) = simulation.counts();
        let from_s = simulation.time_s();
        let start = Instant::now();
        let ended = match length {
            Length::Simulated(time_s) => {
                simulation.run(from_s + time_s, |_, _| ControlFlow::Continue(()))
            }
            Length::Substeps(count) => simulation.run(f64::INFINITY, |_, report| {
                if report.step_ended && report.substeps >= substeps + count {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            }),
        };
        let wall_s = start.elapsed().as_secs_f64();
        ended.map_err(|error| Failure::Numerical(error.to_string()))?;
        let now = simulation.counts();
        Ok(StageLap {
            wall_s,
            simulated_s: simulation.time_s() - from_s,
            steps: now.0 - steps,
            substeps: now.1 - substeps,
            point_steps: now.2 - point_steps,
        })
    }

    /// Median over the laps of the value that `of` returns.
    pub(super) fn median(&self, of: impl Fn(&StageLap) -> f64) -> f64 {
        median(self.stages.iter().map(of).collect())
    }

    /// Median over the laps of this runner's value over the other's.
    pub(super) fn ratio(&self, other: &Self, of: impl Fn(&StageLap) -> f64) -> f64 {
        let pairs = self.stages.iter().zip(&other.stages);
        median(pairs.map(|(a, b)| of(a) / of(b)).collect())
    }

    /// All laps together.
    pub(super) fn total(&self) -> StageLap {
        self.stages
            .iter()
            .fold(StageLap::default(), |sum, lap| StageLap {
                wall_s: sum.wall_s + lap.wall_s,
                simulated_s: sum.simulated_s + lap.simulated_s,
                steps: sum.steps + lap.steps,
                substeps: sum.substeps + lap.substeps,
                point_steps: sum.point_steps + lap.point_steps,
            })
    }
}

/// Runs one lap of every runner in turn, repeatedly: other load on the machine affects
/// all of them alike.
pub(super) fn take_turns(
    runners: &mut [Runner],
    rounds: u32,
    length: impl Fn(&Runner) -> Length,
) -> Result<(), Failure> {
    for _ in 0..rounds {
        for runner in runners.iter_mut() {
            let length = length(runner);
            runner.lap(length)?;
        }
    }
    Ok(())
}

/// The middle value, or the mean of the two in the middle; NaN if there
/// are none.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() {
        0 => f64::NAN,
        odd if odd % 2 == 1 => values[middle],
        _ => 0.5 * (values[middle - 1] + values[middle]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_stands_in_the_middle() {
        assert_eq!(median(vec![3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median(vec![4.0, 1.0, 2.0, 3.0]), 2.5);
        assert!(median(Vec::new()).is_nan());
    }
}
