//! The plan of a run.

use super::accuracy::RoleDocument;
use serde::Serialize;
use utoipa::ToSchema;

/// Plan of a run: its computation, its reductions with their reasons, and its cost.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Plan)]
pub struct PlanDocument {
    /// Every reduction that was considered.
    pub choices: Vec<ChoiceDocument>,
    /// Warnings to check before the run; absent from plans of an older version.
    #[schema(required = false)]
    pub hints: Vec<HintDocument>,
    /// Cost of the run.
    pub cost: PlannedCostDocument,
}

/// A reduction of the computation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Choice)]
pub struct ChoiceDocument {
    /// Reduction that was considered.
    pub what: String,
    /// True if the reduction is made.
    pub taken: bool,
    /// Reason for or against the reduction.
    pub why: String,
    /// Error caused by the reduction.
    pub error: String,
    /// Field of the scenario that overrides the decision, as a JSON pointer; null
    /// if there is none.
    #[schema(required = true)]
    pub decided_by: Option<String>,
}

/// Warning about a scenario: something that is allowed, but probably not intended or
/// unexpectedly costly.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Hint)]
pub struct HintDocument {
    /// Field that the warning is about, as a JSON pointer.
    pub field: String,
    /// One sentence for people.
    pub detail: String,
}

/// Cost of a run.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlannedCost)]
pub struct PlannedCostDocument {
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Material points of the flow at the start.
    pub points: u64,
    /// Acoustic sub-steps of a run of the whole duration.
    pub substeps: u64,
    /// Transfers between points and grid of a run of the whole duration.
    pub steps: u64,
    /// Sub-steps summed over the computed points, of a run of the whole duration.
    pub point_steps: u64,
    /// Memory for points and grid once the flow has spread [bytes].
    pub memory_bytes: u64,
    /// Time at which the run is expected to end [s].
    pub expected_end_s: f64,
    /// Parts of the run, one after the other, by the share of the flow that is computed.
    pub stages: Vec<StageDocument>,
}

/// Part of a run during which the same share of the flow is computed.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Stage)]
pub struct StageDocument {
    /// Share of the flow.
    pub share: ShareDocument,
    /// Points of the share.
    pub points: u64,
    /// Expected number of sub-steps.
    pub substeps: u64,
    /// Expected number of sub-steps before the expected end.
    pub expected_substeps: u64,
}

/// Share of the flow that is computed; images stand for the rest.
#[derive(Debug, Serialize, ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = Share)]
pub enum ShareDocument {
    /// The full flow.
    Whole,
    /// The right half, with a symmetry plane.
    Half,
    /// A quasi-2D slab: one cell next to the right wall.
    Slab,
}

/// A planned run behind uncertainty intervals.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlannedRefinementRun)]
pub struct PlannedRefinementRunDocument {
    /// Purpose of the run.
    pub role: RoleDocument,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Sub-steps summed over its points, for the whole duration.
    pub point_steps: u64,
    /// Expected wall time [s].
    pub expected_s: f64,
}
