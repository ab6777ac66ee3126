//! Accuracy: what is asked of an answer, and the intervals that come with it.

use serde::Serialize;
use utoipa::ToSchema;

/// Demands on the answer's accuracy, and whether it shows its own.
#[derive(Debug, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Accuracy)]
pub struct AccuracyDocument {
    /// Every quantity of the outcome gets a interval.
    #[schema(required = false)]
    pub error_bars: bool,
    /// Distance that the interval of `quantity` may reach from its value, over it; to be met by
    /// the choice of cells; null: the cells are those of `numerics`.
    pub target: Option<f64>,
    /// The quantity that `target` is about.
    pub quantity: Option<QuantityDocument>,
    /// Index of the body whose quantity that is.
    #[schema(required = false)]
    pub body: u32,
    /// Point-steps that may be spent on `target`, those of all runs together.
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
    /// Time of that.
    #[serde(rename = "peak_speed_time_s")]
    PeakTime,
    /// Since when a body has been at rest.
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
    /// Front of the flow less that of the release.
    #[serde(rename = "runout_m")]
    Runout,
}

/// A quantity with the interval in which its value without cells is expected.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = UncertaintyInterval)]
pub struct UncertaintyIntervalDocument {
    /// The value of the answer, as it stands beside; null if it did not happen.
    #[schema(required = true)]
    pub value: Option<f64>,
    /// Lower end; null if there is none.
    #[schema(required = true)]
    pub low: Option<f64>,
    /// Upper end; null if there is none: it may also not happen at all.
    #[schema(required = true)]
    pub high: Option<f64>,
    /// Order at which the values were seen to converge; null if they don't.
    #[schema(required = true)]
    pub order: Option<f64>,
    /// Basis of the interval.
    pub basis: BasisDocument,
}

/// Basis of a interval.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Basis)]
pub enum BasisDocument {
    /// Values that converge at a plausible order.
    Converging,
    /// Values that turn, scatter, or change more with finer cells: a wide interval.
    Scattered,
    /// The same value in all runs.
    Same,
    /// One coarser run alone, so no order: a wide interval.
    OneRefinementRun,
    /// It happened in none of the runs.
    NeverHappened,
    /// It happened in some of the runs only: there is no upper end.
    SometimesHappened,
    /// There is no other run to compare with.
    Nothing,
}

/// Uncertainty intervals of a body's quantities, under the keys of its outcome.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BodyErrorBars)]
pub struct BodyErrorBarsDocument {
    /// Of `onset_time_s`.
    pub onset_time_s: UncertaintyIntervalDocument,
    /// Of `peak_speed_m_s`.
    pub peak_speed_m_s: UncertaintyIntervalDocument,
    /// Of `peak_speed_time_s`.
    pub peak_speed_time_s: UncertaintyIntervalDocument,
    /// Of `stop_time_s`.
    pub stop_time_s: UncertaintyIntervalDocument,
    /// Of `displacement_m`.
    pub displacement_m: UncertaintyIntervalDocument,
    /// Of `path_length_m`.
    pub path_length_m: UncertaintyIntervalDocument,
    /// Of each component of `final_position_m`.
    #[schema(min_items = 3, max_items = 3)]
    pub final_position_m: Vec<UncertaintyIntervalDocument>,
}

/// Uncertainty intervals of the flow's quantities, under the keys of its outcome.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowErrorBars)]
pub struct FlowErrorBarsDocument {
    /// Of `front_m`.
    pub front_m: UncertaintyIntervalDocument,
    /// Of `runout_m`.
    pub runout_m: UncertaintyIntervalDocument,
    /// Of `outflow_mass_kg`.
    pub outflow_mass_kg: UncertaintyIntervalDocument,
}

/// The runs behind the intervals, and whether a target was met.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = AccuracyReport)]
pub struct AccuracyReportDocument {
    /// All runs in the order they were made.
    pub runs: Vec<RunCostDocument>,
    /// Point-steps of all runs but the answer's, over those of the answer's.
    pub extra_cost: f64,
    /// The same of their wall times; null if the answer took no time. Larger in small
    /// scenes, where a step costs more than its points.
    #[schema(required = true)]
    pub extra_wall_cost: Option<f64>,
    /// Fate of the target; null if none was given.
    #[schema(required = true)]
    pub target: Option<TargetReportDocument>,
}

/// One of the runs behind a interval.
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
    /// Sub-steps summed over the points that took part; null if it failed.
    #[schema(required = true)]
    pub point_steps: Option<u64>,
    /// Wall time [s]; null if it failed.
    #[schema(required = true)]
    pub wall_s: Option<f64>,
    /// Reason that it could not be computed; null if it was.
    #[schema(required = true)]
    pub failure: Option<String>,
}

/// Purpose of a run.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(as = Role)]
pub enum RoleDocument {
    /// Larger cells than the answer's.
    Coarser,
    /// A material of reduced stiffness, at the cell size of a coarser run.
    ReducedStiffness,
    /// The answer.
    Answer,
}

/// Verdict on the target.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TargetReport)]
pub struct TargetReportDocument {
    /// The quantity it is about.
    pub quantity: QuantityDocument,
    /// Index of the body whose quantity that is; null for the flow's.
    #[schema(required = true)]
    pub body: Option<u32>,
    /// Distance that the interval may reach from the value, over it, as asked.
    pub asked: f64,
    /// The same, as reached; null if the interval has an open end or the value is 0.
    #[schema(required = true)]
    pub reached: Option<f64>,
    /// True if it is no more than asked.
    pub met: bool,
    /// Reason that it was not met; null if it was.
    #[schema(required = true)]
    pub reason: Option<String>,
}
