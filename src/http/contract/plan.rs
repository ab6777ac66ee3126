//! The plan of a run.

use super::accuracy::RoleDocument;
use serde::Serialize;
use utoipa::ToSchema;

/// Plan of a run: what it computes, what it leaves out and why, and what it costs.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Plan)]
pub struct PlanDocument {
    /// Each thing that could be left out.
    pub choices: Vec<ChoiceDocument>,
    /// Things to look at once more before it runs; absent from plans of an older version.
    #[schema(required = false)]
    pub hints: Vec<HintDocument>,
    /// Cost of the run.
    pub cost: PlannedCostDocument,
}

/// Something that could be left out of a computation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Choice)]
pub struct ChoiceDocument {
    /// Thing that would be done.
    pub what: String,
    /// True if it is.
    pub taken: bool,
    /// Reason for or against.
    pub why: String,
    /// Error that it makes.
    pub error: String,
    /// The field of the scenario that decides otherwise, as a JSON pointer; null:
    /// there is none.
    #[schema(required = true)]
    pub decided_by: Option<String>,
}

/// Something that whoever wrote a scenario may want to look at once more: it is allowed,
/// but probably not meant, or costs more than it looks.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Hint)]
pub struct HintDocument {
    /// The field that it is about, as a JSON pointer.
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
    /// Acoustic sub-steps, if the run goes on for its whole duration.
    pub substeps: u64,
    /// Transfers between points and grid of as long a run.
    pub steps: u64,
    /// Sub-steps summed over the points that are computed, of as long a run.
    pub point_steps: u64,
    /// Memory for points and grid once the flow has spread [bytes].
    pub memory_bytes: u64,
    /// Time at which the run is expected to end [s].
    pub expected_end_s: f64,
    /// Shares of the flow that are computed, one after the other.
    pub stages: Vec<StageDocument>,
}

/// Range of a run in which the same share of the flow is computed.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Stage)]
pub struct StageDocument {
    /// Share of the flow.
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
#[schema(as = PlannedRefinementRun)]
pub struct PlannedRefinementRunDocument {
    /// Purpose.
    pub role: RoleDocument,
    /// Cell size [m].
    pub cell_size_m: f64,
    /// Sub-steps summed over its points, to the end of the duration.
    pub point_steps: u64,
    /// Time it will take [s].
    pub expected_s: f64,
}
