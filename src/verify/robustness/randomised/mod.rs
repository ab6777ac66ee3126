//! A randomised test over all legal scenarios, or over bodies alone: scenarios drawn at random,
//! each
//! run for a fraction of a second. A failing scenario is reduced to the parts needed for its
//! failure.

mod bodies_alone;
mod draw;
mod reduce;

use super::trial::{self, Ended, Trial, TrialReport};
use crate::verify::dice::Dice;
use crate::verify::on_all_cores::side_by_side;
use crate::verify::run::scenario_of;
use scree_solver::simulation::PreparedScene;
use serde::Serialize;
use serde_json::Value;
use std::sync::Mutex;

/// Budget of one run in point-steps, including the equivalents of other work.
const BUDGET: u64 = 60_000;
/// Largest number of draws until one is legal.
const MOST_DRAWS: u32 = 400;

/// Energy that contacts of bodies may create, over the sum of the initial and the largest kinetic
/// energy.
const ENERGY_OF_CONTACTS: f64 = 1e-3;

/// Field from which the scenarios of a randomised test are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Field {
    /// All legal scenarios, coarse, each within a budget of computation.
    #[default]
    Everything,
    /// Bodies without a flow, each run to its end; their contacts must not create energy.
    BodiesAlone,
}

/// Findings of a randomised test.
#[derive(Debug, Default, Serialize)]
pub struct RandomisedReport {
    /// Field of the scenarios.
    pub field: Field,
    /// Number of scenarios asked for.
    pub asked: u64,
    /// Number of scenarios run.
    pub run: u64,
    /// Number of draws refused by validation or set-up, or because they had
    /// too many points.
    pub refused: u64,
    /// Number of runs that reached the end of their duration or budget.
    pub finished: u64,
    /// Wall time of the longest run [s], and its seed.
    pub longest: (f64, u64),
    /// Largest relative energy created in a run, and its seed.
    pub most_energy: (f64, u64),
    /// Sub-steps of all runs.
    pub substeps: u64,
    /// Points of all runs.
    pub points: u64,
    /// Failures, by seed.
    pub failures: Vec<FailingScenario>,
}

/// A scenario that failed.
#[derive(Debug, Serialize)]
pub struct FailingScenario {
    /// Seed of the scenario.
    pub seed: u64,
    /// Kind of failure.
    pub kind: String,
    /// Description of the failure.
    pub words: String,
    /// Scenario, reduced as far as possible.
    pub scenario: Value,
}

impl RandomisedReport {
    /// Number of scenarios asked for and not run, because no draw of their seed was legal.
    pub fn not_run(&self) -> u64 {
        self.asked.saturating_sub(self.run)
    }
}

/// A legal scenario of this seed, and the number of draws refused before it.
pub fn scenario(field: Field, seed: u64) -> Option<(Value, u64)> {
    let mut dice = Dice::of(seed.wrapping_add(1));
    for refused in 0..MOST_DRAWS {
        let drawn = match field {
            Field::Everything => draw::scenario(&mut dice),
            Field::BodiesAlone => bodies_alone::scenario(&mut dice),
        };
        let legal = scenario_of(&drawn).is_ok_and(|scenario| PreparedScene::of(&scenario).is_ok());
        let small = field == Field::BodiesAlone || draw::is_small(&drawn);
        if legal && small {
            return Some((drawn, u64::from(refused)));
        }
    }
    None
}

/// Runs a scenario of a field.
pub fn run(field: Field, scenario: &Value) -> TrialReport {
    let mut trial = Trial::new("", scenario.clone());
    match field {
        Field::Everything => trial.budget = Some(BUDGET),
        Field::BodiesAlone => trial.energy_made = ENERGY_OF_CONTACTS,
    }
    trial::run("randomised", &trial)
}

/// Runs `count` scenarios of a field, with the seeds from `first` on, on all cores.
pub fn randomised(
    field: Field,
    first: u64,
    count: u64,
    tell: &(impl Fn(&FailingScenario) + Sync),
) -> RandomisedReport {
    let report = Mutex::new(RandomisedReport {
        field,
        asked: count,
        ..RandomisedReport::default()
    });
    let seeds: Vec<u64> = (first..first + count).collect();
    side_by_side(&seeds, |seed| take(field, &report, *seed, tell));
    let mut report = report
        .into_inner()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    report.failures.sort_by_key(|failing| failing.seed);
    report
}

fn take(
    field: Field,
    report: &Mutex<RandomisedReport>,
    seed: u64,
    tell: &(impl Fn(&FailingScenario) + Sync),
) {
    let Some((scenario, refused)) = scenario(field, seed) else {
        return;
    };
    let tried = run(field, &scenario);
    let failing = (!tried.is_valid()).then(|| failing(field, seed, &scenario, &tried));
    if let Some(failing) = &failing {
        tell(failing);
    }
    let mut report = report
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    report.run += 1;
    report.refused += refused;
    if tried.wall_s > report.longest.0 {
        report.longest = (tried.wall_s, seed);
    }
    report.finished += u64::from(tried.ended == Ended::Finished);
    if let Some(figures) = tried.figures {
        if figures.energy > report.most_energy.0 {
            report.most_energy = (figures.energy, seed);
        }
        report.substeps += figures.substeps;
        report.points += figures.points;
    }
    report.failures.extend(failing);
}

fn failing(field: Field, seed: u64, scenario: &Value, tried: &TrialReport) -> FailingScenario {
    let kind = reduce::kind(tried);
    let mut last = tried.clone();
    let scenario = reduce::reduced(scenario, &mut |simpler| {
        let again = run(field, simpler);
        let alike = !again.is_valid() && reduce::kind(&again) == kind;
        if alike {
            last = again;
        }
        alike
    });
    FailingScenario {
        seed,
        kind,
        words: format!(
            "{}; broken: {}; {:?}",
            last.ended,
            last.broken.join(", "),
            last.figures
        ),
        scenario,
    }
}
