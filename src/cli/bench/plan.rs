//! Savings of each reduction on the source paper's scene, and the changes it causes.

use super::Effort;
use super::scenes;
use super::stopwatch::median;
use crate::cli::columns::table;
use crate::cli::failure::{Failure, not_set_up};
use crate::cli::machine::cores;
use scree::runs::{NoSink, RunControl, RunEnd, RunError, run};
use scree_solver::record::Outcome;
use scree_solver::scenario::{Approach, Ending, Scenario, Symmetry};
use serde::Serialize;
use std::time::Instant;

/// Cell sizes, coarse ones first [m]: two, three and four cells per cube side.
const CELLS_M: [f64; 3] = [0.02, 0.04 / 3.0, 0.01];
/// End of the run, shortly before the flow strikes the cube [s].
const BEFORE_IMPACT_S: f64 = 0.16;

/// The scene in every variant, at every cell size.
#[derive(Debug, Serialize)]
pub(super) struct Savings {
    threads: usize,
    pub(super) runs: Vec<Saving>,
}

/// One variant of the computation of the scene.
#[derive(Debug, Serialize)]
pub(super) struct Saving {
    pub(super) cell_size_m: f64,
    pub(super) way: &'static str,
    pub(super) wall_s: f64,
    /// Wall time of the full model over this one's.
    times_faster: f64,
    ended_s: f64,
    pub(super) outcome: Outcome,
}

/// A variant of the computation: its name, and its change to the full model.
type Way = (&'static str, fn(&mut Scenario));

/// Variants; the first one of each time range is the full model.
const WAYS: [Way; 8] = [
    ("full", |_| {}),
    ("mirror", |s| s.numerics.symmetry = Symmetry::Auto),
    ("slab", |s| s.numerics.approach = Approach::Auto),
    ("end at rest", |s| s.numerics.ending = Ending::Auto),
    ("all of them", everything),
    ("full, before impact", before_impact),
    ("slab, before impact", |s| {
        before_impact(s);
        s.numerics.approach = Approach::Auto;
    }),
    ("slab and mirror, before impact", |s| {
        before_impact(s);
        everything(s);
    }),
];
/// Index of the full model with which a variant is compared.
const COMPARED_WITH: [usize; WAYS.len()] = [0, 0, 0, 0, 0, 5, 5, 5];

fn everything(scenario: &mut Scenario) {
    scenario.numerics.symmetry = Symmetry::Auto;
    scenario.numerics.approach = Approach::Auto;
    scenario.numerics.ending = Ending::Auto;
}

fn before_impact(scenario: &mut Scenario) {
    scenario.duration_s = BEFORE_IMPACT_S;
}

/// Runs the scene in every variant, in turns.
pub(super) fn measure(effort: &Effort) -> Result<Savings, Failure> {
    let mut runs = Vec::new();
    let sizes = if effort.full {
        &CELLS_M[..]
    } else {
        &CELLS_M[..1]
    };
    for &cell_size_m in sizes {
        runs.extend(at(cell_size_m, effort.repeats)?);
    }
    Ok(Savings {
        threads: cores(),
        runs,
    })
}

fn at(cell_size_m: f64, repeats: u32) -> Result<Vec<Saving>, Failure> {
    let mut scenario = scenes::channel(true, cell_size_m)?;
    scenario.numerics.symmetry = Symmetry::Full;
    scenario.numerics.approach = Approach::Full;
    scenario.numerics.ending = Ending::Full;
    let mut times = vec![Vec::new(); WAYS.len()];
    let mut outcomes = Vec::new();
    for _ in 0..repeats {
        outcomes.clear();
        for ((_, change), times) in WAYS.iter().zip(&mut times) {
            let mut changed = scenario.clone();
            change(&mut changed);
            let (wall_s, outcome) = timed(&changed, cores())?;
            times.push(wall_s);
            outcomes.push((outcome, changed.duration_s));
        }
    }
    let faster = |place: usize| {
        let full = &times[COMPARED_WITH[place]];
        median(
            full.iter()
                .zip(&times[place])
                .map(|(full, own)| full / own)
                .collect(),
        )
    };
    let saving = |(place, (outcome, duration_s)): (usize, (Outcome, f64))| Saving {
        cell_size_m,
        way: WAYS[place].0,
        wall_s: median(times[place].clone()),
        times_faster: faster(place),
        ended_s: outcome
            .ended_early
            .as_ref()
            .map_or(duration_s, |ended| ended.time_s),
        outcome,
    };
    Ok(outcomes.into_iter().enumerate().map(saving).collect())
}

/// Runs a scenario as a job would; the time of its set-up is included.
pub(super) fn timed(scenario: &Scenario, threads: usize) -> Result<(f64, Outcome), Failure> {
    let start = Instant::now();
    match run::run(scenario, threads, &RunControl::default(), &mut NoSink) {
        Ok(RunEnd::Completed(outcome)) => Ok((start.elapsed().as_secs_f64(), *outcome)),
        Ok(RunEnd::Stopped) => Err(Failure::Other("the run was stopped".to_owned())),
        Err(RunError::Setup(error)) => Err(not_set_up(&error)),
        Err(RunError::Step(error)) => Err(Failure::Numerical(error.to_string())),
        Err(RunError::Sink(never)) => match never {},
    }
}

impl Savings {
    /// Table for people.
    pub(super) fn table(&self) -> String {
        let title = format!(
            "plan: the source paper's scene with and without what need not be computed, {} threads",
            self.threads
        );
        let headings = [
            "cell mm",
            "way",
            "wall s",
            "x full",
            "ended s",
            "onset s",
            "peak m/s",
            "displaced m",
            "front m",
        ];
        table(&title, headings, self.runs.iter().map(Saving::row))
    }
}

impl Saving {
    fn row(&self) -> [String; 9] {
        let cube = &self.outcome.bodies[0];
        let optional = |value: Option<f64>, digits: usize| {
            value.map_or_else(|| "–".to_owned(), |value| format!("{value:.digits$}"))
        };
        [
            format!("{:.2}", 1e3 * self.cell_size_m),
            self.way.to_owned(),
            format!("{:.2}", self.wall_s),
            format!("{:.2}", self.times_faster),
            format!("{:.2}", self.ended_s),
            optional(cube.onset_time_s, 4),
            format!("{:.5}", cube.peak_speed_m_s),
            format!("{:.5}", cube.displacement_m),
            optional(self.outcome.flow.front_m, 4),
        ]
    }
}
