//! Levels and members that an accuracy is expected to take, before any member is computed.

use super::estimate::{LevelMeans, Term};
use super::next::{
    FEWEST_LEVELS, LARGEST_SHARE, NUMERICAL_SHARE, PILOT, REFINEMENT, WORK_ORDER, finer_cells,
};
use crate::study::{FEWEST_MEMBERS, MOST_FINER, Study};
use crate::{CONFIDENCE, normal};
use serde::{Deserialize, Serialize};

/// Standard deviation of a quantity over its mean: the displacement of the cube of the source
/// paper with uncertain friction, volume, place and yaw.
const SPREAD: f64 = 0.2;
/// Standard deviation of what the first finer level adds, over that of the quantity, likewise; it
/// falls with the second power of the cell size.
const ADDED: f64 = 0.6;
const ADDED_ORDER: f64 = 2.0;
/// Numerical error of the coarsest level over the mean, likewise; it falls with the first power.
const NUMERICAL: f64 = 0.3;

/// Levels that an accuracy is expected to take.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyForecast))]
pub struct Forecast {
    /// Levels, the coarsest first.
    pub levels: Vec<ForecastLevel>,
    /// Work of all their members [point-steps].
    pub point_steps: f64,
    /// Members of the finest level alone with the same sampling error.
    pub one_level_members: u64,
    /// Their work [point-steps].
    pub one_level_point_steps: f64,
    /// That over the work of the levels: how many times cheaper they are.
    pub gain: f64,
    /// True if cells may get as small, and work as much, as the target is expected to take.
    pub is_expected_to_be_met: bool,
}

/// Level that an accuracy is expected to take.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct ForecastLevel {
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Members.
    pub members: u64,
    /// Work of a member [point-steps].
    pub point_steps_per_member: f64,
}

impl Forecast {
    /// Forecast for a study that an accuracy is asked of, from the work of its members on the
    /// coarsest level [point-steps]; none without one.
    pub fn of(study: &Study, point_steps_per_member: f64) -> Option<Self> {
        let accuracy = study.accuracy.as_ref()?;
        let cells = cells(study)?;
        let costs: Vec<f64> = cells
            .iter()
            .map(|size| point_steps_per_member * libm::pow(cells[0] / size, WORK_ORDER))
            .collect();
        let means = expected_means(&cells);
        let remaining = expected_error(&cells);
        let share = LARGEST_SHARE * accuracy.target;
        let half = accuracy.target - remaining.min(share);
        let quantile = normal::quantile(0.5 * (1.0 + CONFIDENCE));
        let variance = (half / quantile) * (half / quantile);
        let wanted = means.allocation(&costs, variance);
        let members: Vec<u64> = wanted
            .iter()
            .enumerate()
            .map(|(level, wanted)| members(study, level, *wanted))
            .collect();
        let levels = cells.iter().zip(&members).zip(&costs);
        let levels: Vec<ForecastLevel> = levels
            .map(|((cell_size_m, members), cost)| ForecastLevel {
                cell_size_m: *cell_size_m,
                members: *members,
                point_steps_per_member: *cost,
            })
            .collect();
        let work = levels.iter().map(ForecastLevel::point_steps).sum();
        let sampled = means.with_members(&members).error(0).variance;
        let alone = (SPREAD * SPREAD / sampled).ceil();
        let alone_work = alone * costs[costs.len() - 1];
        Some(Self {
            levels,
            point_steps: work,
            one_level_members: alone as u64,
            one_level_point_steps: alone_work,
            gain: alone_work / work,
            is_expected_to_be_met: remaining <= share && work <= accuracy.budget_point_steps,
        })
    }
}

impl ForecastLevel {
    fn point_steps(&self) -> f64 {
        self.members as f64 * self.point_steps_per_member
    }
}

/// Cell sizes of the levels that the study has, and of those expected to be added [m].
fn cells(study: &Study) -> Option<Vec<f64>> {
    let accuracy = study.accuracy.as_ref()?;
    let given = (0..study.levels()).map(|level| study.cell_size_m(level));
    let mut cells = given.collect::<Option<Vec<f64>>>()?;
    while cells.len() <= MOST_FINER {
        let finer = finer_cells(*cells.last()?);
        let is_enough = expected_error(&cells) <= NUMERICAL_SHARE * accuracy.target;
        if (is_enough && cells.len() >= FEWEST_LEVELS) || !accuracy.takes_cells(finer) {
            break;
        }
        cells.push(finer);
    }
    Some(cells)
}

/// Error of the finest cells over the mean.
fn expected_error(cells: &[f64]) -> f64 {
    NUMERICAL * cells[cells.len() - 1] / cells[0]
}

/// Means of 1 on levels of these cell sizes, with the spreads that are expected.
fn expected_means(cells: &[f64]) -> LevelMeans<1> {
    let spread = |level: usize| match level {
        0 => SPREAD,
        level => SPREAD * ADDED * libm::pow(cells[level] * REFINEMENT / cells[0], ADDED_ORDER),
    };
    let term = |(level, size): (usize, &f64)| Term::expected(*size, level, spread(level));
    LevelMeans {
        terms: cells.iter().enumerate().map(term).collect(),
    }
}

/// Members of a level: at least those that it begins with.
fn members(study: &Study, level: usize, wanted: f64) -> u64 {
    let begun = match level as u32 {
        level if level < study.levels() => study.members_on(level),
        _ => PILOT.min(study.members_on(study.levels() - 1)),
    };
    let members = begun.max(wanted.ceil() as u64).max(FEWEST_MEMBERS);
    match level {
        0 => members.next_power_of_two(),
        _ => members,
    }
}
