//! `scree bench`: how fast the solver is on this machine.

mod bodies;
mod collapse;
mod figures;
mod forecasts;
mod heaps;
mod own_process;
mod plan;
mod progress;
mod roofline;
mod scenes;
mod size;
mod stages;
mod stopwatch;
mod threads;

use super::arguments::{BenchOptions, Measurement, Quiet};
use super::console;
use super::failure::Failure;
use crate::cli::machine::Machine;
use scree_solver::VERSION;
use serde::Serialize;
use std::io::IsTerminal;

/// Cell size of the channel, quick and full [m].
const CHANNEL_CELLS_M: (f64, f64) = (0.0125, 0.01);

/// Extent of the measurements.
#[derive(Debug, Serialize)]
struct Effort {
    /// True if each scene is measured whole, and the largest scenes too.
    full: bool,
    /// Repetitions of every variant, in turn with the others.
    repeats: u32,
    /// Points of the collapse.
    points: u32,
}

/// Report of the measurements; those not made are left out.
#[derive(Debug, Serialize)]
struct Report {
    solver_version: &'static str,
    machine: Machine,
    effort: Effort,
    #[serde(skip_serializing_if = "Option::is_none")]
    s200k: Option<collapse::Speeds>,
    #[serde(skip_serializing_if = "Option::is_none")]
    size: Option<size::Sizes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    channel: Option<bodies::Growth>,
    #[serde(skip_serializing_if = "Option::is_none")]
    bodies: Option<bodies::Growth>,
    #[serde(skip_serializing_if = "Option::is_none")]
    heaps: Option<heaps::Heaps>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stages: Option<stages::Shares>,
    #[serde(skip_serializing_if = "Option::is_none")]
    threads: Option<threads::Scaling>,
    #[serde(skip_serializing_if = "Option::is_none")]
    roofline: Option<roofline::Rooflines>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plan: Option<plan::Savings>,
    #[serde(skip_serializing_if = "Option::is_none")]
    forecast: Option<forecasts::Forecasts>,
    #[serde(skip_serializing_if = "Option::is_none")]
    progress: Option<progress::Tracks>,
}

/// Runs the measurements asked for and prints them.
///
/// # Errors
/// See [`Failure`].
pub(super) fn bench(options: &BenchOptions) -> Result<(), Failure> {
    let effort = Effort {
        full: options.full,
        repeats: options.repeats,
        points: options.points.unwrap_or(scenes::COLLAPSE_POINTS),
    };
    let asked = Asked {
        only: &options.only,
        quiet: options.quiet,
    };
    let report = Report::measured(effort, &asked)?;
    if let Some(folder) = &options.figures {
        figures::write(&report, folder)?;
    }
    let answer = if options.json {
        serde_json::to_string_pretty(&report)?
    } else {
        report.tables()
    };
    Ok(console::only_answer(&answer)?)
}

/// Measurements to be made.
struct Asked<'a> {
    /// All if empty.
    only: &'a [Measurement],
    quiet: Quiet,
}

impl Asked<'_> {
    /// Makes a measurement if it is among those asked for, and announces it to the user.
    fn make<T>(
        &self,
        one: Measurement,
        measure: impl FnOnce() -> Result<T, Failure>,
    ) -> Result<Option<T>, Failure> {
        if !self.only.is_empty() && !self.only.contains(&one) {
            return Ok(None);
        }
        if std::io::stderr().is_terminal() {
            self.quiet.note(&format!("measuring: {}", one.name()));
        }
        measure().map(Some)
    }
}

impl Report {
    fn measured(effort: Effort, asked: &Asked<'_>) -> Result<Self, Failure> {
        use Measurement::{
            Bodies, Channel, Forecast, Heaps, Plan, Progress, Roofline, S200k, Size, Stages,
            Threads,
        };
        Ok(Self {
            solver_version: VERSION,
            machine: Machine::here(),
            s200k: asked.make(S200k, || collapse::measure(&effort))?,
            size: asked.make(Size, || size::measure(&effort))?,
            channel: asked.make(Channel, || bodies::measure_channel(&effort))?,
            bodies: asked.make(Bodies, || bodies::measure_bodies(&effort))?,
            heaps: asked.make(Heaps, || heaps::measure(&effort))?,
            stages: asked.make(Stages, || stages::measure(&effort))?,
            threads: asked.make(Threads, || threads::measure(&effort))?,
            roofline: asked.make(Roofline, || roofline::measure(&effort))?,
            plan: asked.make(Plan, || plan::measure(&effort))?,
            forecast: asked.make(Forecast, || forecasts::measure(&effort))?,
            progress: asked.make(Progress, progress::measure)?,
            effort,
        })
    }

    fn tables(&self) -> String {
        let tables = [
            self.s200k.as_ref().map(collapse::Speeds::table),
            self.size.as_ref().map(size::Sizes::table),
            self.channel.as_ref().map(|growth| {
                growth.table("channel: the source paper's, without and with its cube")
            }),
            self.bodies
                .as_ref()
                .map(|growth| growth.table("bodies: small cubes in the same channel")),
            self.heaps.as_ref().map(heaps::Heaps::table),
            self.stages.as_ref().map(stages::Shares::table),
            self.threads.as_ref().map(threads::Scaling::table),
            self.roofline.as_ref().map(roofline::Rooflines::table),
            self.plan.as_ref().map(plan::Savings::table),
            self.forecast.as_ref().map(forecasts::Forecasts::table),
            self.progress.as_ref().map(progress::Tracks::table),
        ];
        let how = format!(
            "Scree {}; {}\n{}\n",
            self.solver_version,
            self.machine.in_words(),
            self.effort.in_words()
        );
        let parts: Vec<String> = [Some(how)].into_iter().chain(tables).flatten().collect();
        parts.join("\n").trim_end().to_owned()
    }
}

impl Effort {
    /// Cell size of the channel [m].
    fn channel_cell_m(&self) -> f64 {
        let (quick, full) = CHANNEL_CELLS_M;
        if self.full { full } else { quick }
    }

    fn in_words(&self) -> String {
        let how = if self.full {
            "full: 0.15 s of the collapse, after a warm-up of some sub-steps"
        } else {
            "quick: the start of the collapse only, the channel on a coarser grid and half as long"
        };
        format!("{how}; medians of {} laps taken in turns", self.repeats)
    }
}
