//! Which cells meet a target (docs/method.md, section 13).

use super::bars::relative;
use super::companions::{Extent, Rung};
use crate::record::{Band, Basis, Role};
use crate::scenario::Scenario;
use crate::simulation::Simulation;

/// Cell sizes that are tried first, over the largest that tell anything. The
/// last but one is run with a softer material, too.
const PILOTS: [f64; 3] = [1.0, 0.8, 0.64];
/// A band is expected to narrow with this power of the cell size.
const ORDER: f64 = 1.0;
/// Cost of an answer with its companions over its own.
const WITH_COMPANIONS: f64 = 1.2;
/// Aims below the target, so that a guess a little off still meets it.
const AIM: f64 = 0.9;
/// Least and largest ratio of two cell sizes that follow each other: less is not
/// worth a run, more is beyond what coarse cells can foresee.
const RATIOS: (f64, f64) = (1.25, 2.0);

/// The first runs.
pub(super) fn pilots(extent: &Extent) -> Vec<Rung> {
    let mut rungs: Vec<Rung> = PILOTS
        .iter()
        .map(|share| Rung {
            role: Role::Coarser,
            cell_size_m: share * extent.coarsest(),
        })
        .collect();
    if !extent.stiffness_is_given {
        rungs.push(Rung {
            role: Role::Softer,
            ..rungs[1]
        });
    }
    rungs
}

/// How far the way to a target is.
#[derive(Debug)]
pub(super) struct Progress {
    /// How far the band may reach from the value, over it.
    pub(super) asked: f64,
    /// The band so far.
    pub(super) band: Option<Band>,
    /// Its share that finer cells don't narrow, the softness of the material, by every
    /// softer run so far in turn.
    pub(super) softness: Vec<f64>,
    /// Cells of the finest run [m].
    pub(super) cell_size_m: f64,
    /// Its point-steps.
    pub(super) cost: f64,
    /// Point-steps left of the budget.
    pub(super) left: f64,
    /// Why the last run could not be computed.
    pub(super) failed: Option<String>,
}

/// What to do now.
#[derive(Debug, PartialEq)]
pub(super) enum Next {
    /// The target is met.
    Met,
    /// A run of this cell size [m].
    Finer(f64),
    /// The target can't be met, and why.
    GiveUp(String),
}

/// The cheapest run that is expected to meet the target, or that gets closest to it
/// within the budget.
pub(super) fn next(progress: &Progress, given: &Scenario) -> Next {
    let reached = progress.band.as_ref().and_then(relative);
    if reached.is_some_and(|reached| reached <= progress.asked) {
        return Next::Met;
    }
    if let Some(why) = &progress.failed {
        return Next::GiveUp(format!("the last run could not be computed: {why}"));
    }
    let never = progress.band.map(|band| band.basis) == Some(Basis::NeverHappened);
    if never || progress.band.is_some_and(|band| band.value == Some(0.0)) {
        return Next::GiveUp("it did not happen, so there is nothing to be relative to".to_owned());
    }
    let (least, most) = RATIOS;
    let aim = AIM * progress.asked;
    if is_too_soft(&progress.softness, aim) {
        return Next::GiveUp(too_soft(progress));
    }
    let softness = progress.softness.last().copied().unwrap_or(0.0);
    let of_cells = |all: f64| (all * all - softness * softness).max(0.0).sqrt();
    let wanted = match reached {
        Some(reached) if softness < aim => (of_cells(reached) / of_cells(aim)).powf(1.0 / ORDER),
        Some(_) => most,
        // Without a band of two ends nothing can be foreseen but that it takes more.
        None => least,
    };
    let affordable = (progress.left / (WITH_COMPANIONS * progress.cost)).powf(0.25);
    if affordable < least {
        return Next::GiveUp(out_of_budget(progress, wanted));
    }
    let cell_size_m = progress.cell_size_m / wanted.clamp(least, most).min(affordable);
    let mut finer = given.clone();
    finer.numerics.cell_size_m = Some(cell_size_m);
    match Simulation::check(&finer) {
        Ok(()) => Next::Finer(cell_size_m),
        Err(error) => Next::GiveUp(error.to_string()),
    }
}

/// Whether no cells meet the target. A single softer run, of the first and coarsest
/// cells, shows how much these scatter rather than how soft the material is.
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
    let next = WITH_COMPANIONS * progress.cost * wanted.max(RATIOS.0).powi(4);
    format!(
        "about {next:.1e} more point-steps are needed, but accuracy.budget_point_steps leaves {:.1e}",
        progress.left.max(0.0)
    )
}
