//! Submission of a study.

use super::documents::StudyDocument;
use super::named::unknown_study;
use super::validation::{INVALID_STUDY, validated};
use crate::http::access::Caller;
use crate::http::idempotency;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::http::scenario_body::{ScenarioText, read_envelope};
use crate::jobs::store::StudySubmitted;
use crate::jobs::{JobService, SubmitError};
use crate::studies::StudyService;
use crate::terrains::terrains_of;
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use scree_studies::Study;

/// Submit a study
///
/// Both ends of every input are checked before anything runs. The members are jobs, computed when
/// no other job waits. With an `Idempotency-Key`, a repeated request gets the study of the first
/// one.
#[utoipa::path(
    post,
    path = "/v1/studies",
    tag = "studies",
    params(
        ("Idempotency-Key" = Option<String>, Header, description = "A name for this request, 1 to 255 visible ASCII characters"),
    ),
    request_body = Study,
    responses(
        (status = 202, description = "The study runs", body = StudyDocument,
         headers(("Location" = String, description = "Where the study is"))),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The study breaks rules (`errors` has them all), or the Idempotency-Key came with another request", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many studies run, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn submit_study(
    State(jobs): State<JobService>,
    State(studies): State<StudyService>,
    caller: Caller,
    uri: Uri,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
    ScenarioText(text): ScenarioText,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let key = idempotency::key(&headers, &format!("{uri}\n{text}"))?;
    let study: Study = read_envelope(&text, INVALID_STUDY)?;
    let study = validated(&jobs, &caller, study).await?;
    let document = serde_json::to_string(&study).map_err(|error| Problem::internal(&error))?;
    let request = (caller.name(), key.as_ref());
    let terrains = terrains_of(&study.scenario.to_string());
    let (submitted, id) = studies
        .submit((&study.title, &document), request, &terrains)
        .await?;
    let id = match submitted {
        StudySubmitted::Accepted => id,
        StudySubmitted::Before(former) => former,
        StudySubmitted::OtherRequest => return Err(SubmitError::OtherRequest.into()),
        StudySubmitted::NoTerrain(terrain) => return Err(SubmitError::NoTerrain(terrain).into()),
        StudySubmitted::Full(running) => return Err(full(running, studies.room())),
        StudySubmitted::QuotaSpent(own) => return Err(spent(own, studies.room_of_one())),
    };
    let stored = studies.study(id).await?;
    let stored = stored.ok_or_else(|| unknown_study(&id.to_string()))?;
    let location = [(header::LOCATION, format!("/v1/studies/{id}"))];
    let document = Json(StudyDocument::from(stored));
    Ok((StatusCode::ACCEPTED, location, document).into_response())
}

fn spent(own: u32, most: u32) -> Problem {
    let detail = format!("{own} studies of this token run, and it may have {most}");
    Problem::busy("studies-spent", "Too many studies", &detail)
}

pub(super) fn full(running: u32, most: u32) -> Problem {
    let detail = format!("{running} studies run, and limits.studies of this service is {most}");
    Problem::busy("studies-full", "Too many studies run", &detail)
}
