//! Plans: computation and cost of a run.

use super::access::Caller;
use super::problem::Problem;
use super::scenario_body::ScenarioText;
use crate::jobs::documents::{Plan, PlannedRefinementRun, Scenario};
use crate::jobs::forecast::WallTime;
use crate::jobs::{JobService, PlanError};
use crate::terrains::ReadError;
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// A plan, the runs behind uncertainty intervals, and the expected wall time of all.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Planned)]
pub(super) struct PlannedDocument {
    /// Computation, reductions and cost of the run.
    #[schema(value_type = Plan)]
    pub plan: Value,
    /// Runs made before that of the answer; with a target, the first ones.
    #[schema(value_type = Vec<PlannedRefinementRun>)]
    pub refinement_runs: Value,
    /// Expected wall time of all runs on a worker of this service.
    pub wall_time: WallTime,
}

/// Plan a run
///
/// The body is the bare scenario. It is planned like a job with this scenario; its first
/// steps are timed, for about a second. Nothing is stored.
#[utoipa::path(
    post,
    path = "/v1/plans",
    tag = "plans",
    request_body = Scenario,
    responses(
        (status = 200, description = "The plan", body = PlannedDocument),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The scenario breaks rules (`errors` has them all), or its first steps can't be taken, or the run is planned to take more than this service allows", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn plan(
    State(jobs): State<JobService>,
    caller: Caller,
    ScenarioText(text): ScenarioText,
) -> Result<Json<PlannedDocument>, Problem> {
    let planned = jobs.plan(&caller.share(), text).await?;
    let plan = serde_json::to_value(&planned.plan).map_err(|error| Problem::internal(&error))?;
    let refinement_runs = serde_json::to_value(&planned.refinement_runs)
        .map_err(|error| Problem::internal(&error))?;
    Ok(Json(PlannedDocument {
        plan,
        refinement_runs,
        wall_time: planned.wall_time,
    }))
}

impl From<PlanError> for Problem {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::Scenario(ReadError::Scenario(error)) => error.into(),
            PlanError::Scenario(ReadError::Store(error)) => error.into(),
            // A legal scenario that fails within its first steps: it would fail as a job, too.
            PlanError::Forecast(error) => Self::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "no-forecast",
                "No forecast",
                error.to_string(),
            ),
            PlanError::Admission(error) => error.into(),
        }
    }
}
