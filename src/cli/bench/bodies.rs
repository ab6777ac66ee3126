//! Cost of bodies in the flow.

use super::Effort;
use super::scenes::{self, IN_THE_FLOW_S};
use super::stopwatch::{Length, Runner, StageLap, take_turns};
use crate::cli::columns::{millions, table};
use crate::cli::failure::Failure;
use crate::cli::machine::cores;
use scree_solver::scenario::Scenario;
use serde::Serialize;

/// Small cubes in the channel.
const COUNTS: [usize; 4] = [0, 1, 10, 100];

/// The same channel with more and more bodies.
#[derive(Debug, Serialize)]
pub(super) struct Growth {
    threads: usize,
    cell_size_m: f64,
    /// Start and end of the measured simulated time [s].
    simulated_s: [f64; 2],
    scenes: Vec<Crowd>,
}

#[derive(Debug, Serialize)]
struct Crowd {
    bodies: usize,
    points: usize,
    point_steps_per_s: f64,
    wall_s_per_simulated_s: f64,
    /// Wall time over that of the first scene.
    over_first: f64,
    /// Wall time of one point-step over that of the first scene: excludes the cost of
    /// shorter sub-steps.
    per_point_step_over_first: f64,
    measured: StageLap,
}

impl Crowd {
    fn of(runner: &Runner, first: &Runner) -> Self {
        Self {
            bodies: runner.simulation.bodies().len(),
            points: runner.simulation.point_count(),
            point_steps_per_s: runner.median(StageLap::rate),
            wall_s_per_simulated_s: runner.median(StageLap::wall_per_simulated),
            over_first: runner.ratio(first, StageLap::wall_per_simulated),
            per_point_step_over_first: first.ratio(runner, StageLap::rate),
            measured: runner.total(),
        }
    }

    fn row(&self) -> [String; 6] {
        [
            self.bodies.to_string(),
            self.measured.substeps.to_string(),
            millions(self.point_steps_per_s),
            format!("{:.1}", self.wall_s_per_simulated_s),
            format!("{:.3}", self.over_first),
            format!("{:.3}", self.per_point_step_over_first),
        ]
    }
}

/// Times the source paper's channel without and with its cube.
pub(super) fn measure_channel(effort: &Effort) -> Result<Growth, Failure> {
    let cell_m = effort.channel_cell_m();
    let scenes = [
        scenes::channel(false, cell_m)?,
        scenes::channel(true, cell_m)?,
    ];
    compare(effort, scenes)
}

/// Times the channel with none, one and many small cubes.
pub(super) fn measure_bodies(effort: &Effort) -> Result<Growth, Failure> {
    let cell_m = effort.channel_cell_m();
    let scenes: Result<Vec<_>, _> = COUNTS
        .map(|count| scenes::small_cubes(count, cell_m))
        .into_iter()
        .collect();
    compare(effort, scenes?)
}

fn compare(effort: &Effort, scenes: impl IntoIterator<Item = Scenario>) -> Result<Growth, Failure> {
    let (from_s, lasting_s) = IN_THE_FLOW_S;
    let lasting_s = if effort.full {
        lasting_s
    } else {
        0.5 * lasting_s
    };
    let mut runners = Vec::new();
    for scene in scenes {
        runners.push(Runner::new(&scene, cores())?.skipped_to(from_s)?);
    }
    let lap = Length::Simulated(lasting_s / f64::from(effort.repeats));
    take_turns(&mut runners, effort.repeats, |_| lap)?;
    let first = &runners[0];
    Ok(Growth {
        threads: cores(),
        cell_size_m: first.simulation.cell_size_m(),
        simulated_s: [from_s, first.simulation.time_s()],
        scenes: runners.iter().map(|run| Crowd::of(run, first)).collect(),
    })
}

impl Growth {
    /// Table for people.
    pub(super) fn table(&self, title: &str) -> String {
        let [from_s, to_s] = self.simulated_s;
        let points = self.scenes.first().map_or(0, |scene| scene.points);
        let title = format!(
            "{title}; {points} points at the start, cells of {:.4} m, t = {from_s:.2} to {to_s:.2} s, {} threads",
            self.cell_size_m, self.threads
        );
        let headings = [
            "bodies",
            "sub-steps",
            "M point-steps/s",
            "wall s / simulated s",
            "x first",
            "x per point-step",
        ];
        table(&title, headings, self.scenes.iter().map(Crowd::row))
    }
}
