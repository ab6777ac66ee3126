//! Next step of a study towards the accuracy asked of it.

use super::Known;
use super::estimate::{LevelMeans, half_width};
use crate::answers::Mean;
use crate::design::Design;
use crate::outcome::Member;
use crate::study::{Accuracy, Ensemble, FinerLevel, Study};
use serde::{Deserialize, Serialize};

/// Ratio of the cell sizes of a level and of the next finer one that is added.
pub(super) const REFINEMENT: f64 = 1.5;
/// Members of a new level.
pub(super) const PILOT: u64 = 16;
/// Fewest levels of which a numerical error is believed: with three, two differences tell whether
/// it falls.
pub(super) const FEWEST_LEVELS: usize = 3;
/// Share of the target that the error of the finest cells may take before a finer level is added.
pub(super) const NUMERICAL_SHARE: f64 = 0.7;
/// Largest share of the target that it may take at all: the rest is left to sampling.
pub(super) const LARGEST_SHARE: f64 = 0.9;
/// Most growth of a level at a time, since the variances of few members are uncertain.
const GROWTH: f64 = 4.0;
/// Power of the cell size with which a member's work grows: cells in three directions, and steps.
pub(super) const WORK_ORDER: f64 = 4.0;

/// Need of a study for its accuracy; of one that has ended, the need that it ended with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Needed {
    /// Nothing: the target is met.
    Nothing,
    /// More members.
    Members,
    /// A level of finer cells; of a study that has ended, one whose scenarios are not allowed.
    FinerLevel,
    /// Smaller cells than the smallest allowed, or more levels than a study may have.
    SmallerCells,
    /// More work than the budget has.
    Budget,
    /// More members than a design may have.
    LargerDesign,
    /// Members that succeed: too few have the quantity, or so many lack it that the interval is wide.
    Successes,
}

/// Progress of a study towards its accuracy.
#[derive(Debug, Clone)]
pub(crate) struct Progress {
    /// Mean of the quantity.
    pub(crate) mean: Mean,
    /// Means of the quantity on the levels; none of too few members.
    pub(crate) means: Option<LevelMeans<1>>,
    /// Mean work of a member on each level [point-steps], or what it is expected to be.
    pub(crate) costs: Vec<f64>,
}

/// Next step of a study towards its accuracy.
#[derive(Debug, Clone, PartialEq)]
pub struct NextStep {
    /// Need that it answers.
    pub needed: Needed,
    /// The study with more members or a finer level, if that is what is needed.
    pub study: Option<Study>,
}

impl NextStep {
    /// Next step after all members have an outcome; none of a study without an accuracy. Only a study
    /// that is allowed gets a finer level.
    pub fn of(
        ensemble: &Ensemble,
        members: &[Member],
        is_allowed: impl Fn(&Study) -> bool,
    ) -> Option<Self> {
        let study = ensemble.study();
        let accuracy = study.accuracy.as_ref()?;
        let progress = Progress::of(ensemble, members, accuracy);
        Some(progress.next(study, accuracy, &is_allowed))
    }

    fn without_study(needed: Needed) -> Self {
        Self {
            needed,
            study: None,
        }
    }
}

impl Progress {
    pub(crate) fn of(ensemble: &Ensemble, members: &[Member], accuracy: &Accuracy) -> Self {
        let quantity = (accuracy.quantity.as_str(), accuracy.body);
        let known = Known::of_quantity(ensemble, members, quantity);
        let means = LevelMeans::of(&known);
        Self {
            mean: Mean::of_known(&known, means.as_ref()),
            means,
            costs: costs(ensemble.study(), members),
        }
    }

    /// Number of members of the finest level alone whose mean has the same sampling variance.
    pub(crate) fn one_level_members(&self) -> Option<f64> {
        let members = self.means.as_ref()?.one_level_draws(0);
        Some(members).filter(|members| members.is_finite())
    }

    /// Next step of the study.
    pub(crate) fn next(
        &self,
        study: &Study,
        accuracy: &Accuracy,
        is_allowed: &dyn Fn(&Study) -> bool,
    ) -> NextStep {
        let Some(means) = self
            .means
            .as_ref()
            .filter(|means| means.terms.len() == self.costs.len())
        else {
            return NextStep::without_study(Needed::Successes);
        };
        if means.terms.len() < FEWEST_LEVELS {
            return self.finer_level(study, accuracy, is_allowed);
        }
        if self
            .mean
            .relative_error()
            .is_some_and(|error| error <= accuracy.target)
        {
            return NextStep::without_study(Needed::Nothing);
        }
        let target = accuracy.target * means.mean()[0].abs();
        if means.error(0).half_width() <= target {
            return NextStep::without_study(Needed::Successes);
        }
        let remaining = means.remaining(0).unwrap_or(f64::INFINITY);
        if remaining > NUMERICAL_SHARE * target {
            let finer = self.finer_level(study, accuracy, is_allowed);
            if finer.study.is_some() || remaining > LARGEST_SHARE * target {
                return finer;
            }
        }
        self.more_members(study, accuracy, (means, target - remaining))
    }

    /// The study with a finer level.
    fn finer_level(
        &self,
        study: &Study,
        accuracy: &Accuracy,
        is_allowed: &dyn Fn(&Study) -> bool,
    ) -> NextStep {
        let finest = study.levels() - 1;
        let cell_size_m = finer_cells(study.cell_size_m(finest).unwrap_or(f64::NAN));
        let level = FinerLevel {
            cell_size_m,
            members: PILOT.min(study.members_on(finest)),
        };
        let mut finer = study.clone();
        finer.finer_levels.push(level);
        if !accuracy.takes_cells(cell_size_m) || !finer.violations().is_empty() {
            return NextStep::without_study(Needed::SmallerCells);
        }
        if !is_allowed(&finer) {
            return NextStep::without_study(Needed::FinerLevel);
        }
        let mut costs = self.costs.clone();
        costs.extend(
            costs
                .last()
                .map(|cost| cost * libm::pow(REFINEMENT, WORK_ORDER)),
        );
        affordable(finer, &costs, (accuracy, Needed::FinerLevel))
    }

    /// The study with as many members as leave this half width to the interval.
    fn more_members(
        &self,
        study: &Study,
        accuracy: &Accuracy,
        (means, half): (&LevelMeans<1>, f64),
    ) -> NextStep {
        let (variance, freedom) = means.extrapolated_variance(0);
        let quantile = half_width(variance, freedom) / variance.sqrt();
        let allowed = (half / quantile) * (half / quantile);
        let wanted = means.allocation(&self.costs, allowed);
        let mut larger = study.clone();
        for (level, wanted) in (0_u32..).zip(wanted) {
            let now = study.members_on(level) as f64;
            set_members(&mut larger, level, wanted.clamp(now, GROWTH * now));
        }
        if larger == *study {
            // Rounding, or degrees of freedom that fell: a little more on the finest level.
            let finest = study.levels() - 1;
            set_members(&mut larger, finest, 1.25 * study.members_on(finest) as f64);
        }
        if !larger.violations().is_empty() {
            return NextStep::without_study(Needed::LargerDesign);
        }
        affordable(larger, &self.costs, (accuracy, Needed::Members))
    }
}

/// Cell size of the next finer level [m], of three digits.
pub(super) fn finer_cells(cell_size_m: f64) -> f64 {
    let finer = cell_size_m / REFINEMENT;
    let digits = libm::pow(10.0, 2.0 - libm::floor(libm::log10(finer)));
    (finer * digits).round() / digits
}

/// Sets the number of members of a level to at least this, and that of coarser levels to no less.
fn set_members(study: &mut Study, level: u32, least: f64) {
    let members = least.ceil() as u64;
    for finer in study.finer_levels.iter_mut().take(level as usize) {
        finer.members = finer.members.max(members);
    }
    if let Design::Sobol(sobol) = &mut study.design {
        sobol.members = sobol.members.max(members.next_power_of_two());
    }
}

/// Step to a larger study, if its members are within the budget.
fn affordable(study: Study, costs: &[f64], (accuracy, needed): (&Accuracy, Needed)) -> NextStep {
    let levels = (0_u32..).zip(costs);
    let work: f64 = levels
        .map(|(level, cost)| study.members_on(level) as f64 * cost)
        .sum();
    if work > accuracy.budget_point_steps {
        return NextStep::without_study(Needed::Budget);
    }
    NextStep {
        needed,
        study: Some(study),
    }
}

/// Mean work of a member on each level [point-steps]: of those that have it, else as it is expected
/// from the next coarser level.
pub(crate) fn costs(study: &Study, members: &[Member]) -> Vec<f64> {
    let mut costs: Vec<f64> = Vec::new();
    for level in 0..study.levels() {
        let of_level = members.iter().filter(|member| member.level == level);
        let work = of_level.filter(|member| member.index < study.members_on(level));
        let work = work.filter_map(|member| member.finished()?.quantity("point_steps", None));
        let (mut sum, mut count) = (0.0, 0.0);
        for one in work {
            sum += one;
            count += 1.0;
        }
        let sizes = level.checked_sub(1).and_then(|coarser| {
            let (coarse, fine) = (study.cell_size_m(coarser)?, study.cell_size_m(level)?);
            Some(coarse / fine)
        });
        let before = costs.last().copied().unwrap_or(1.0);
        let expected = before * libm::pow(sizes.unwrap_or(1.0), WORK_ORDER);
        costs.push(if sum > 0.0 { sum / count } else { expected });
    }
    costs
}
