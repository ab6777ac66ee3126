//! Rates of the collapse, for each variant of the computation.

use super::Effort;
use super::scenes::{COLLAPSE_S, Collapse};
use super::stopwatch::{Length, Runner, StageLap, take_turns};
use crate::cli::columns::{millions, table};
use crate::cli::failure::Failure;
use crate::cli::machine::{instruction_sets, one_and_all};
use scree_solver::Instructions;
use serde::Serialize;

/// Sub-steps of a quick lap, in single and in double precision.
const QUICK_LAP: (u64, u64) = (64, 8);

/// Rates of the collapse, by variant.
#[derive(Debug, Serialize)]
pub(super) struct Speeds {
    points: usize,
    ways: Vec<Speed>,
}

/// One variant of the computation of the collapse.
#[derive(Debug, Serialize)]
struct Speed {
    precision: &'static str,
    /// None in double precision, which has no code for special instruction sets.
    instructions: Option<String>,
    threads: usize,
    /// "moving": after the flow has moved by a given distance; "every": at every sub-step.
    transfer: &'static str,
    point_steps_per_s: f64,
    wall_s_per_simulated_s: f64,
    /// Rate over that of the same variant on one thread.
    over_one_thread: f64,
    measured: StageLap,
}

#[derive(Debug, Clone, Copy)]
struct Way {
    collapse: Collapse,
    instructions: Option<Instructions>,
    threads: usize,
}

impl Way {
    fn set_up(&self) -> Result<Runner, Failure> {
        let runner = Runner::new(&self.collapse.scenario()?, self.threads)?;
        let runner = match self.instructions {
            Some(instructions) => runner.with(instructions),
            None => runner,
        };
        runner.warmed_up()
    }

    fn speed(&self, runner: &Runner, on_one_thread: &Runner) -> Speed {
        let Collapse {
            double,
            every_substep,
            ..
        } = self.collapse;
        Speed {
            precision: if double { "double" } else { "single" },
            instructions: self.instructions.map(|set| set.to_string()),
            threads: self.threads,
            transfer: if every_substep { "every" } else { "moving" },
            point_steps_per_s: runner.median(StageLap::rate),
            wall_s_per_simulated_s: runner.median(StageLap::wall_per_simulated),
            over_one_thread: runner.ratio(on_one_thread, StageLap::rate),
            measured: runner.total(),
        }
    }
}

/// All variants: every instruction set with transfers paced by the flow, the best
/// one and double precision with both paces; on one thread and on all.
fn ways(points: u32) -> Vec<Way> {
    let best = Instructions::detected();
    let mut kinds: Vec<_> = instruction_sets().map(|set| (Some(set), false)).collect();
    kinds.extend([(Some(best), true), (None, false), (None, true)]);
    let mut ways = Vec::new();
    for (instructions, every_substep) in kinds {
        ways.extend(one_and_all().into_iter().map(|threads| Way {
            collapse: Collapse {
                double: instructions.is_none(),
                every_substep,
                ..Collapse::of(points)
            },
            instructions,
            threads,
        }));
    }
    ways
}

/// Times the collapse in each variant.
pub(super) fn measure(effort: &Effort) -> Result<Speeds, Failure> {
    let ways = ways(effort.points);
    let mut runners = Vec::new();
    for way in &ways {
        runners.push(way.set_up()?);
    }
    if effort.full {
        let rest = COLLAPSE_S / f64::from(effort.repeats);
        take_turns(&mut runners, effort.repeats, |_| Length::Simulated(rest))?;
    } else {
        for _ in 0..effort.repeats {
            for (way, runner) in ways.iter().zip(&mut runners) {
                let (single, double) = QUICK_LAP;
                let substeps = if way.collapse.double { double } else { single };
                runner.lap(Length::Substeps(substeps))?;
            }
        }
    }
    let group = one_and_all().len();
    let speeds = ways.iter().zip(&runners).enumerate();
    let speeds = speeds.map(|(place, (way, runner))| {
        // Each group begins with one thread.
        way.speed(runner, &runners[place - place % group])
    });
    Ok(Speeds {
        points: runners[0].simulation.point_count(),
        ways: speeds.collect(),
    })
}

impl Speeds {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!("s200k: collapse of {} points", self.points);
        let headings = [
            "precision",
            "instructions",
            "transfer",
            "threads",
            "M point-steps/s",
            "wall s / simulated s",
            "x 1 thread",
        ];
        table(&title, headings, self.ways.iter().map(Speed::row))
    }
}

impl Speed {
    fn row(&self) -> [String; 7] {
        [
            self.precision.to_owned(),
            self.instructions.clone().unwrap_or_else(|| "–".to_owned()),
            self.transfer.to_owned(),
            self.threads.to_string(),
            millions(self.point_steps_per_s),
            format!("{:.1}", self.wall_s_per_simulated_s),
            format!("{:.2}", self.over_one_thread),
        ]
    }
}
