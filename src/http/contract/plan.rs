//! The plan of a run.

use super::accuracy::RoleDocument;
use serde::Serialize;
use utoipa::ToSchema;

/// What a run computes, what it leaves out and why, and what it costs.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Plan)]
pub struct PlanDocument {
    /// Each thing that could be left out.
    pub choices: Vec<ChoiceDocument>,
    /// What the run will cost.
    pub cost: PlannedCostDocument,
}

/// Something that could be left out of a computation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Choice)]
pub struct ChoiceDocument {
    /// What would be done.
    pub what: String,
    /// Whether it is.
    pub taken: bool,
    /// Why, or why not.
    pub why: String,
    /// What error it makes.
    pub error: String,
    /// The field of the scenario that decides otherwise, as a JSON pointer; null:
    /// there is none.
    #[schema(required = true)]
    pub decided_by: Option<String>,
}

/// What a run will cost.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlannedCost)]
pub struct PlannedCostDocument {
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Material points of the flow at the start.
    pub points: u64,
    /// Acoustic sub-steps, if the run goes on for its whole duration.
    pub substeps: u64,
    /// Transfers between points and grid of as long a run.
    pub steps: u64,
    /// Sub-steps summed over the points that are computed, of as long a run.
    pub point_steps: u64,
    /// Memory for points and grid once the flow has spread [bytes].
    pub memory_bytes: u64,
    /// When the run is expected to end [s].
    pub expected_end_s: f64,
    /// Shares of the flow that are computed, one after the other.
    pub stages: Vec<StageDocument>,
}

/// A stretch of a run in which the same share of the flow is computed.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Stage)]
pub struct StageDocument {
    /// Which share.
    pub share: ShareDocument,
    /// Points of it.
    pub points: u64,
    /// Sub-steps, as far as can be expected.
    pub substeps: u64,
    /// Those of them before the expected end.
    pub expected_substeps: u64,
}

/// Share of the flow that is computed; the rest are its images.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = Share)]
pub enum ShareDocument {
    /// All of it.
    Whole,
    /// The right half.
    Half,
    /// One cell next to the right wall.
    Slab,
}

/// A run behind error bars, before it is made.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlannedCompanion)]
pub struct PlannedCompanionDocument {
    /// What it is for.
    pub role: RoleDocument,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Sub-steps summed over its points, to the end of the duration.
    pub point_steps: u64,
    /// How long it will take [s].
    pub expected_s: f64,
}
