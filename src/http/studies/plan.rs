//! Plans of studies.

use super::validation::{INVALID_STUDY, validated};
use crate::http::access::Caller;
use crate::http::problem::Problem;
use crate::http::scenario_body::{ScenarioText, read_envelope};
use crate::jobs::JobService;
use crate::jobs::forecast::WallTime;
use crate::studies::StudyService;
use crate::studies::plan::{StudyCost, cost};
use axum::Json;
use axum::extract::State;
use axum::http::StatusCode;
use scree_studies::{Ensemble, Study};
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// Plan of a study.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = PlannedStudy)]
pub(super) struct PlannedStudyDocument {
    /// Cost of the members.
    pub cost: StudyCost,
    /// Expected wall time of the design's members, or of those that an accuracy is expected to take,
    /// on all workers of this service, if they have nothing else to do.
    pub wall_time: WallTime,
}

/// Plan a study
///
/// The study is checked like one that is submitted; the cost of up to 32 of its members is found,
/// and the first steps of one are timed, for about a second. Nothing is stored.
#[utoipa::path(
    post,
    path = "/v1/study-plans",
    tag = "studies",
    request_body = Study,
    responses(
        (status = 200, description = "The plan", body = PlannedStudyDocument),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The study breaks rules (`errors` has them all), or the first steps of a member can't be taken", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn plan_study(
    State(jobs): State<JobService>,
    State(studies): State<StudyService>,
    caller: Caller,
    ScenarioText(text): ScenarioText,
) -> Result<Json<PlannedStudyDocument>, Problem> {
    let study: Study = read_envelope(&text, INVALID_STUDY)?;
    let study = validated(&jobs, &caller, study).await?;
    let place = jobs.enter(&caller.share())?;
    let costed = {
        let reader = jobs.clone();
        place.work(move |_| costed(&study, &reader)).await?
    };
    drop(place);
    let (cost, member) = costed.ok_or_else(no_member)?;
    let planned = jobs.plan(&caller.share(), member).await?;
    let share = members_like_the_first(&cost, planned.plan.cost.point_steps);
    let share = share / studies.workers() as f64;
    let of_member = planned.wall_time;
    let wall_time = WallTime {
        expected_s: of_member.expected_s.map(|time| time * share),
        low_s: of_member.low_s * share,
        high_s: of_member.high_s * share,
        threads: of_member.threads,
    };
    Ok(Json(PlannedStudyDocument { cost, wall_time }))
}

/// Number of members like the first, of this many point-steps, that cost as much as all that are
/// expected.
fn members_like_the_first(cost: &StudyCost, point_steps: u64) -> f64 {
    if point_steps == 0 {
        return cost.members as f64;
    }
    let forecast = cost.accuracy.as_ref();
    let all = forecast.map_or(cost.point_steps, |forecast| forecast.point_steps);
    all / point_steps as f64
}

/// Cost of a study, and its first member's scenario as it runs beside others: on one thread.
fn costed(study: &Study, jobs: &JobService) -> Option<(StudyCost, String)> {
    let ensemble = Ensemble::of(study).ok()?;
    let cost = cost(&ensemble, &|text| jobs.read(text).ok())?;
    let mut scenario = ensemble.scenario(0).ok()?;
    let numerics = scenario.as_object_mut()?.entry("numerics");
    let numerics = numerics.or_insert_with(|| Value::Object(serde_json::Map::new()));
    numerics
        .as_object_mut()?
        .insert("threads".to_owned(), 1.into());
    Some((cost, scenario.to_string()))
}

fn no_member() -> Problem {
    let status = StatusCode::UNPROCESSABLE_ENTITY;
    let detail = "none of the members that were tried can be set up";
    Problem::new(status, INVALID_STUDY.0, INVALID_STUDY.1, detail)
}
