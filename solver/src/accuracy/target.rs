//! Choice of the cells that meet a target (docs/method.md, section 13).

use super::error_bars::relative;
use super::refinement_runs::{ResolvedLengths, StudyRun};
use crate::record::{Basis, Role, UncertaintyInterval};
use crate::scenario::Scenario;
use crate::simulation::PreparedScene;

/// Cell sizes that are tried first, over the largest of use. The last but one is also run with
/// a material of reduced stiffness.
const PILOTS: [f64; 3] = [1.0, 0.8, 0.64];
/// Power of the cell size with which an interval is expected to narrow.
const ORDER: f64 = 1.0;
/// Cost of an answer with its refinement runs over its own.
const WITH_REFINEMENT_RUNS: f64 = 1.2;
/// Aim over the target, so that a slightly wrong prediction still meets it.
const AIM: f64 = 0.9;
/// Least and largest ratio of two successive cell sizes: less is not worth a run, more can't be
/// predicted from coarse cells.
const RATIOS: (f64, f64) = (1.25, 2.0);

/// The pilot runs.
pub(super) fn pilots(lengths: &ResolvedLengths) -> Vec<StudyRun> {
    let mut study_runs: Vec<StudyRun> = PILOTS
        .iter()
        .map(|share| StudyRun {
            role: Role::Coarser,
            cell_size_m: share * lengths.coarsest(),
        })
        .collect();
    if !lengths.stiffness_is_given {
        study_runs.push(StudyRun {
            role: Role::ReducedStiffness,
            ..study_runs[1]
        });
    }
    study_runs
}

/// Progress towards a target.
#[derive(Debug)]
pub(super) struct Progress {
    /// Largest distance of the interval's ends from the value, over the value.
    pub(super) asked: f64,
    /// The interval so far.
    pub(super) interval: Option<UncertaintyInterval>,
    /// The part of the interval that finer cells don't narrow: the effect of reduced stiffness, by
    /// every reduced-stiffness run so far in order.
    pub(super) softness: Vec<f64>,
    /// Cells of the finest run [m].
    pub(super) cell_size_m: f64,
    /// Point-steps of the finest run.
    pub(super) cost: f64,
    /// Point-steps left of the budget.
    pub(super) left: f64,
    /// Error of the last run, if it could not be computed.
    pub(super) failed: Option<String>,
}

/// The next action.
#[derive(Debug, PartialEq)]
pub(super) enum NextRun {
    /// The target is met.
    Met,
    /// A run of this cell size [m].
    Finer(f64),
    /// The target can't be met, and why.
    GiveUp(String),
}

/// The cheapest run that is expected to meet the target, or that gets closest to it
/// within the budget.
pub(super) fn next(progress: &Progress, given: &Scenario) -> NextRun {
    let reached = progress.interval.as_ref().and_then(relative);
    if reached.is_some_and(|reached| reached <= progress.asked) {
        return NextRun::Met;
    }
    if let Some(why) = &progress.failed {
        return NextRun::GiveUp(format!("the last run could not be computed: {why}"));
    }
    let never = progress.interval.map(|interval| interval.basis) == Some(Basis::NeverHappened);
    if never
        || progress
            .interval
            .is_some_and(|interval| interval.value == Some(0.0))
    {
        return NextRun::GiveUp(
            "it did not happen, so there is nothing to be relative to".to_owned(),
        );
    }
    let (least, most) = RATIOS;
    let aim = AIM * progress.asked;
    if is_too_soft(&progress.softness, aim) {
        return NextRun::GiveUp(too_soft(progress));
    }
    let softness = progress.softness.last().copied().unwrap_or(0.0);
    let of_cells = |all: f64| (all * all - softness * softness).max(0.0).sqrt();
    let wanted = match reached {
        Some(reached) if softness < aim => (of_cells(reached) / of_cells(aim)).powf(1.0 / ORDER),
        Some(_) => most,
        // Without a two-sided interval nothing can be predicted, except that finer cells are
        // needed.
        None => least,
    };
    let affordable = (progress.left / (WITH_REFINEMENT_RUNS * progress.cost)).powf(0.25);
    if affordable < least {
        return NextRun::GiveUp(out_of_budget(progress, wanted));
    }
    let cell_size_m = progress.cell_size_m / wanted.clamp(least, most).min(affordable);
    let mut finer = given.clone();
    finer.numerics.cell_size_m = Some(cell_size_m);
    match PreparedScene::of(&finer) {
        Ok(_) => NextRun::Finer(cell_size_m),
        Err(error) => NextRun::GiveUp(error.to_string()),
    }
}

/// True if no cells meet the target. A single reduced-stiffness run, with the first and
/// coarsest cells, shows scatter rather than the effect of stiffness.
fn is_too_soft(softness: &[f64], aim: f64) -> bool {
    softness.len() > 1 && softness.iter().all(|share| *share >= aim)
}

fn too_soft(progress: &Progress) -> String {
    let least = progress
        .softness
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    format!(
        "the softness of the material makes {least:.3} of it alone: raise numerics.sound_speed_m_s"
    )
}

fn out_of_budget(progress: &Progress, wanted: f64) -> String {
    let next = WITH_REFINEMENT_RUNS * progress.cost * wanted.max(RATIOS.0).powi(4);
    format!(
        "about {next:.1e} more point-steps are needed, but accuracy.budget_point_steps leaves {:.1e}",
        progress.left.max(0.0)
    )
}
