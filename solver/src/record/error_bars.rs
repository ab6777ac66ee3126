//! Uncertainty intervals of an outcome's quantities, and their cost: types only. Computation of
//! intervals: `accuracy`, and docs/method.md, section 13.

use crate::scenario::Quantity;
use serde::{Deserialize, Serialize};

/// A quantity with the interval in which its grid-converged value (h → 0) is expected.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct UncertaintyInterval {
    /// Value of the answer, equal to that in the outcome; null if the event did not happen.
    pub value: Option<f64>,
    /// Lower end; null if there is none.
    pub low: Option<f64>,
    /// Upper end; null if there is none: the event may also never happen.
    pub high: Option<f64>,
    /// Observed order of convergence; null if the values don't converge.
    pub order: Option<f64>,
    /// Basis of the interval.
    pub basis: Basis,
}

/// Basis of an uncertainty interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Values that converge at a plausible order.
    Converging,
    /// Values that oscillate, scatter, or change more with finer cells: a wide interval.
    Scattered,
    /// The same value in all runs.
    Same,
    /// Only one coarser run, so no order: a wide interval.
    OneRefinementRun,
    /// The event happened in none of the runs.
    NeverHappened,
    /// The event happened in some of the runs only: there is no upper end.
    SometimesHappened,
    /// No other run to compare with.
    Nothing,
}

/// Uncertainty intervals of a body's quantities, under the keys of its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct BodyErrorBars {
    /// Interval of `onset_time_s`.
    pub onset_time_s: UncertaintyInterval,
    /// Interval of `peak_speed_m_s`.
    pub peak_speed_m_s: UncertaintyInterval,
    /// Interval of `peak_speed_time_s`.
    pub peak_speed_time_s: UncertaintyInterval,
    /// Interval of `stop_time_s`.
    pub stop_time_s: UncertaintyInterval,
    /// Interval of `displacement_m`.
    pub displacement_m: UncertaintyInterval,
    /// Interval of `path_length_m`.
    pub path_length_m: UncertaintyInterval,
    /// Interval of each component of `final_position_m`.
    #[cfg_attr(feature = "schema", schema(min_items = 3, max_items = 3))]
    pub final_position_m: [UncertaintyInterval; 3],
}

/// Uncertainty intervals of the flow's quantities, under the keys of its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct FlowErrorBars {
    /// Interval of `front_m`.
    pub front_m: UncertaintyInterval,
    /// Interval of `runout_m`.
    pub runout_m: UncertaintyInterval,
    /// Interval of `outflow_mass_kg`.
    pub outflow_mass_kg: UncertaintyInterval,
}

/// Runs behind the intervals, and the result of the target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct AccuracyReport {
    /// All runs, in the order in which they were made.
    pub runs: Vec<RunCost>,
    /// Point-steps of all other runs, over those of the run of the answer.
    pub extra_cost: f64,
    /// Wall time of all other runs, over that of the run of the answer; null if the latter took no
    /// time. Larger in small scenes, where the fixed cost of a step prevails.
    pub extra_wall_cost: Option<f64>,
    /// Result of the target; null if none was given.
    pub target: Option<TargetReport>,
}

/// One of the runs behind an uncertainty interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct RunCost {
    /// Purpose of the run.
    pub role: Role,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Cells across the thinnest body; null without bodies.
    pub cells_per_body: Option<f64>,
    /// Speed of sound in the bulk [m/s].
    pub sound_speed_m_s: f64,
    /// Sub-steps summed over the points that took part; null if the run failed.
    pub point_steps: Option<u64>,
    /// Wall time [s]; null if the run failed.
    pub wall_s: Option<f64>,
    /// Reason of the failure; null if the run succeeded.
    pub failure: Option<String>,
}

/// Purpose of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Run with larger cells than those of the answer.
    Coarser,
    /// Run with a material of reduced stiffness, at the cell size of a coarser run.
    ReducedStiffness,
    /// Run of the answer.
    Answer,
}

/// Result of the target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct TargetReport {
    /// Quantity to which the target applies.
    pub quantity: Quantity,
    /// Index of the body whose quantity it is; null for a quantity of the flow.
    pub body: Option<u32>,
    /// Requested largest distance of the interval from the value, over the value.
    pub asked: f64,
    /// Distance reached, over the value; null if the interval has an open end or the value is 0.
    pub reached: Option<f64>,
    /// True if the distance reached is no larger than the requested one.
    pub met: bool,
    /// Reason why the target was not met; null if it was met.
    pub reason: Option<String>,
}
