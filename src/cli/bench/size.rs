//! The collapse at different numbers of points.

use super::Effort;
use super::scenes::Collapse;
use super::stopwatch::{Length, Runner, StageLap, take_turns};
use crate::cli::columns::{millions, table};
use crate::cli::failure::Failure;
use crate::cli::machine::one_and_all;
use serde::Serialize;

const SIZES: [u32; 3] = [10_000, 100_000, 1_000_000];
/// Additional sizes of the full bench.
const LARGE_SIZES: [u32; 2] = [5_000_000, 10_000_000];
/// Point-steps of a lap: about a second on a fast machine.
const WORK: u32 = 20_000_000;
/// Minimum number of sub-steps of a lap: a transfer comes once in so many.
const FEWEST_SUBSTEPS: u32 = 20;

/// Speeds by the number of points.
#[derive(Debug, Serialize)]
pub(super) struct Sizes {
    sizes: Vec<Size>,
    /// Slowest rate over fastest, on one thread and on all.
    flatness: Vec<f64>,
}

/// The collapse at one size.
#[derive(Debug, Serialize)]
pub(super) struct Size {
    pub(super) threads: usize,
    pub(super) points: usize,
    pub(super) point_steps_per_s: f64,
    bytes_per_point: f64,
    grid_bytes_per_point: f64,
    measured: StageLap,
}

impl Size {
    fn of(runner: &Runner) -> Self {
        let points = runner.simulation.point_count();
        let (own, grid) = runner.simulation.bytes();
        Self {
            threads: runner.simulation.threads(),
            points,
            point_steps_per_s: runner.median(StageLap::rate),
            bytes_per_point: own as f64 / points as f64,
            grid_bytes_per_point: grid as f64 / points as f64,
            measured: runner.total(),
        }
    }

    fn row(&self) -> [String; 5] {
        [
            self.threads.to_string(),
            self.points.to_string(),
            millions(self.point_steps_per_s),
            format!("{:.0}", self.bytes_per_point),
            format!("{:.0}", self.grid_bytes_per_point),
        ]
    }
}

/// Times collapses of different sizes.
pub(super) fn measure(effort: &Effort) -> Result<Sizes, Failure> {
    let mut runners = Vec::new();
    let large = LARGE_SIZES.iter().filter(|_| effort.full);
    for points in SIZES.iter().chain(large) {
        for threads in one_and_all() {
            let scenario = Collapse::of(*points).scenario()?;
            runners.push(Runner::new(&scenario, threads)?.warmed_up()?);
        }
    }
    take_turns(&mut runners, effort.repeats, |runner| {
        let points = runner.simulation.point_count() as u64;
        Length::Substeps((u64::from(WORK) / points).max(u64::from(FEWEST_SUBSTEPS)))
    })?;
    let mut sizes: Vec<Size> = runners.iter().map(Size::of).collect();
    sizes.sort_by_key(|size| (size.threads, size.points));
    let flatness = one_and_all()
        .into_iter()
        .map(|threads| flatness(&sizes, threads));
    Ok(Sizes {
        flatness: flatness.collect(),
        sizes,
    })
}

fn flatness(sizes: &[Size], threads: usize) -> f64 {
    let of_these = sizes.iter().filter(|size| size.threads == threads);
    let rates = of_these.map(|size| size.point_steps_per_s);
    let (slowest, fastest) = rates.fold((f64::INFINITY, 0.0f64), |(low, high), rate| {
        (low.min(rate), high.max(rate))
    });
    slowest / fastest
}

impl Sizes {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let flatness: Vec<_> = self
            .flatness
            .iter()
            .map(|ratio| format!("{ratio:.2}"))
            .collect();
        let title = format!(
            "size: the collapse at different sizes; slowest / fastest {}",
            flatness.join(" and ")
        );
        let headings = [
            "threads",
            "points",
            "M point-steps/s",
            "bytes / point",
            "of the grid / point",
        ];
        table(&title, headings, self.sizes.iter().map(Size::row))
    }

    /// Results by size.
    pub(super) fn each(&self) -> &[Size] {
        &self.sizes
    }
}
