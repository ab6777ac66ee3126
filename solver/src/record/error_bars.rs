//! Uncertainty intervals of an outcome's quantities, and their cost: types only. Computation of
//! intervals: `accuracy`, and docs/method.md, section 13.

use crate::scenario::Quantity;
use serde::{Deserialize, Serialize};

/// A quantity with the interval in which its grid-converged value is expected.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct UncertaintyInterval {
    /// The value of the answer, a copy; null if it did not happen.
    pub value: Option<f64>,
    /// Lower end; null if there is none.
    pub low: Option<f64>,
    /// Upper end; null if there is none: it may also not happen at all.
    pub high: Option<f64>,
    /// Observed order of convergence; null if the values don't converge.
    pub order: Option<f64>,
    /// Basis of the interval.
    pub basis: Basis,
}

/// Basis of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Basis {
    /// Values that converge at a plausible order.
    Converging,
    /// Values that turn, scatter, or change more with finer cells: a wide interval.
    Scattered,
    /// The same value in all runs.
    Same,
    /// Only one coarser run, so no order: a wide interval.
    OneRefinementRun,
    /// It happened in none of the runs.
    NeverHappened,
    /// It happened in some of the runs only: there is no upper end.
    SometimesHappened,
    /// There is no other run to compare with.
    Nothing,
}

/// Uncertainty intervals of a body's quantities, under the keys of its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyErrorBars {
    /// Of `onset_time_s`.
    pub onset_time_s: UncertaintyInterval,
    /// Of `peak_speed_m_s`.
    pub peak_speed_m_s: UncertaintyInterval,
    /// Of `peak_speed_time_s`.
    pub peak_speed_time_s: UncertaintyInterval,
    /// Of `stop_time_s`.
    pub stop_time_s: UncertaintyInterval,
    /// Of `displacement_m`.
    pub displacement_m: UncertaintyInterval,
    /// Of `path_length_m`.
    pub path_length_m: UncertaintyInterval,
    /// Of each component of `final_position_m`.
    pub final_position_m: [UncertaintyInterval; 3],
}

/// Uncertainty intervals of the flow's quantities, under the keys of its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowErrorBars {
    /// Of `front_m`.
    pub front_m: UncertaintyInterval,
    /// Of `runout_m`.
    pub runout_m: UncertaintyInterval,
    /// Of `outflow_mass_kg`.
    pub outflow_mass_kg: UncertaintyInterval,
}

/// The runs behind the intervals, and the result of a target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AccuracyReport {
    /// All runs in the order they were made.
    pub runs: Vec<RunCost>,
    /// Point-steps of all other runs over those of the answer's.
    pub extra_cost: f64,
    /// Wall time of all other runs over that of the answer's; null if the answer took no time.
    /// Larger in small scenes, where the cost per step outweighs that of the points.
    pub extra_wall_cost: Option<f64>,
    /// Report on the target; null if none was given.
    pub target: Option<TargetReport>,
}

/// A run behind an interval.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunCost {
    /// Role of the run.
    pub role: Role,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Cells across the thinnest body; null without bodies.
    pub cells_per_body: Option<f64>,
    /// √(K/ρ) of the bulk [m/s].
    pub sound_speed_m_s: f64,
    /// Sub-steps summed over the computed points; null if it failed.
    pub point_steps: Option<u64>,
    /// Wall time, measured by the caller [s]; null if it failed.
    pub wall_s: Option<f64>,
    /// Reason for the failure; null if it succeeded.
    pub failure: Option<String>,
}

/// Role of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Larger cells than the answer's.
    Coarser,
    /// A material of reduced stiffness, at the cell size of a coarser run.
    ReducedStiffness,
    /// The answer.
    Answer,
}

/// Report on a target: the error asked for and the one reached.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TargetReport {
    /// The target quantity.
    pub quantity: Quantity,
    /// Index of the body whose quantity it is; null for the flow's.
    pub body: Option<u32>,
    /// Largest distance of the interval's ends from the value, over the value, as asked.
    pub asked: f64,
    /// The distance reached; null if the interval has an open end or the value is 0.
    pub reached: Option<f64>,
    /// True if the distance reached is within the one asked for.
    pub met: bool,
    /// Reason for which it was not met; null if it was.
    pub reason: Option<String>,
}
