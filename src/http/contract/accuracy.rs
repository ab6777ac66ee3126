//! Accuracy: the requested accuracy of an answer, and its uncertainty intervals.

use serde::Serialize;
use utoipa::ToSchema;

/// Requested accuracy of the answer, and whether it reports uncertainty intervals.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Accuracy)]
pub struct AccuracyDocument {
    /// True if every quantity of the outcome gets an uncertainty interval.
    #[schema(required = false)]
    pub error_bars: bool,
    /// Largest distance of the interval of `quantity` from its value, over the value; the cell
    /// size is chosen to meet it. Null: the cell size is that of `numerics`.
    pub target: Option<f64>,
    /// Quantity to which `target` applies.
    pub quantity: Option<QuantityDocument>,
    /// Index of the body whose quantity it is.
    #[schema(required = false)]
    pub body: u32,
    /// Largest number of point-steps that may be spent on `target`, all runs together.
    #[schema(required = false)]
    pub budget_point_steps: f64,
}

/// A quantity of the outcome, by its key.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Quantity)]
pub enum QuantityDocument {
    /// First time a body's centre is 1 mm from its start.
    #[serde(rename = "onset_time_s")]
    Onset,
    /// Largest speed of a body's centre.
    #[serde(rename = "peak_speed_m_s")]
    PeakSpeed,
    /// Time of the largest speed of a body's centre.
    #[serde(rename = "peak_speed_time_s")]
    PeakTime,
    /// Time from which on a body is at rest.
    #[serde(rename = "stop_time_s")]
    Stop,
    /// Net horizontal displacement of a body.
    #[serde(rename = "displacement_m")]
    Displacement,
    /// Length of a body's path.
    #[serde(rename = "path_length_m")]
    PathLength,
    /// Front of the flow.
    #[serde(rename = "front_m")]
    Front,
    /// Front of the flow minus the front of the release.
    #[serde(rename = "runout_m")]
    Runout,
}

/// A quantity with the interval in which its grid-converged value (h → 0) is expected.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = UncertaintyInterval)]
pub struct UncertaintyIntervalDocument {
    /// Value of the answer, equal to that in the outcome; null if the event did not happen.
    #[schema(required = true)]
    pub value: Option<f64>,
    /// Lower end; null if there is none.
    #[schema(required = true)]
    pub low: Option<f64>,
    /// Upper end; null if there is none: the event may also never happen.
    #[schema(required = true)]
    pub high: Option<f64>,
    /// Observed order of convergence; null if the values don't converge.
    #[schema(required = true)]
    pub order: Option<f64>,
    /// Basis of the interval.
    pub basis: BasisDocument,
}

/// Basis of an uncertainty interval.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Basis)]
pub enum BasisDocument {
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
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyErrorBars)]
pub struct BodyErrorBarsDocument {
    /// Interval of `onset_time_s`.
    pub onset_time_s: UncertaintyIntervalDocument,
    /// Interval of `peak_speed_m_s`.
    pub peak_speed_m_s: UncertaintyIntervalDocument,
    /// Interval of `peak_speed_time_s`.
    pub peak_speed_time_s: UncertaintyIntervalDocument,
    /// Interval of `stop_time_s`.
    pub stop_time_s: UncertaintyIntervalDocument,
    /// Interval of `displacement_m`.
    pub displacement_m: UncertaintyIntervalDocument,
    /// Interval of `path_length_m`.
    pub path_length_m: UncertaintyIntervalDocument,
    /// Interval of each component of `final_position_m`.
    #[schema(min_items = 3, max_items = 3)]
    pub final_position_m: Vec<UncertaintyIntervalDocument>,
}

/// Uncertainty intervals of the flow's quantities, under the keys of its outcome.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowErrorBars)]
pub struct FlowErrorBarsDocument {
    /// Interval of `front_m`.
    pub front_m: UncertaintyIntervalDocument,
    /// Interval of `runout_m`.
    pub runout_m: UncertaintyIntervalDocument,
    /// Interval of `outflow_mass_kg`.
    pub outflow_mass_kg: UncertaintyIntervalDocument,
}

/// Runs behind the intervals, and the result of the target.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AccuracyReport)]
pub struct AccuracyReportDocument {
    /// All runs, in the order in which they were made.
    pub runs: Vec<RunCostDocument>,
    /// Point-steps of all other runs, over those of the run of the answer.
    pub extra_cost: f64,
    /// Wall time of all other runs, over that of the run of the answer; null if the latter
    /// took no time. Larger in small scenes, where the fixed cost of a step prevails.
    #[schema(required = true)]
    pub extra_wall_cost: Option<f64>,
    /// Result of the target; null if none was given.
    #[schema(required = true)]
    pub target: Option<TargetReportDocument>,
}

/// One of the runs behind an uncertainty interval.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = RunCost)]
pub struct RunCostDocument {
    /// Purpose of the run.
    pub role: RoleDocument,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Cells across the thinnest body; null without bodies.
    #[schema(required = true)]
    pub cells_per_body: Option<f64>,
    /// Speed of sound in the bulk [m/s].
    pub sound_speed_m_s: f64,
    /// Sub-steps summed over the points that took part; null if the run failed.
    #[schema(required = true)]
    pub point_steps: Option<u64>,
    /// Wall time [s]; null if the run failed.
    #[schema(required = true)]
    pub wall_s: Option<f64>,
    /// Reason of the failure; null if the run succeeded.
    #[schema(required = true)]
    pub failure: Option<String>,
}

/// Purpose of a run.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Role)]
pub enum RoleDocument {
    /// Run with larger cells than those of the answer.
    Coarser,
    /// Run with a material of reduced stiffness, at the cell size of a coarser run.
    ReducedStiffness,
    /// Run of the answer.
    Answer,
}

/// Result of the target.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TargetReport)]
pub struct TargetReportDocument {
    /// Quantity to which the target applies.
    pub quantity: QuantityDocument,
    /// Index of the body whose quantity it is; null for a quantity of the flow.
    #[schema(required = true)]
    pub body: Option<u32>,
    /// Requested largest distance of the interval from the value, over the value.
    pub asked: f64,
    /// Distance reached, over the value; null if the interval has an open end or the value is 0.
    #[schema(required = true)]
    pub reached: Option<f64>,
    /// True if the distance reached is no larger than the requested one.
    pub met: bool,
    /// Reason why the target was not met; null if it was met.
    #[schema(required = true)]
    pub reason: Option<String>,
}
