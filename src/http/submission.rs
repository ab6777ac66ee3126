//! Submission of a scenario.

use super::access::Caller;
use super::documents::JobDocument;
use super::named_job::named;
use super::problem::{FieldError, Problem};
use super::query::Query;
use super::scenario_body::{ScenarioText, malformed};
use crate::jobs::job::Job;
use crate::jobs::store::Key;
use crate::jobs::submit::{ScenarioError, label};
use crate::jobs::{JobService, SubmissionRequest, SubmitError};
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};

/// Seconds after which a client may retry if the queue is full.
const RETRY_AFTER_S: u8 = 10;

/// Submit a scenario
///
/// The body is the bare scenario. The job is on disk when the answer is sent. With
/// an `Idempotency-Key`, a repeated request gets the same job.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    tag = "jobs",
    params(
        ("label" = Option<Vec<String>>, Query, explode = true, description = "Labels of the job; may be given several times"),
        ("reuse" = Option<String>, Query, description = "\"finished\": a successful job with the same scenario, run by this very program, is as good as a new one"),
        ("Idempotency-Key" = Option<String>, Header, description = "A name for this request, 1 to 255 visible ASCII characters"),
    ),
    request_body = crate::jobs::documents::Scenario,
    responses(
        (status = 200, description = "A finished job with the same scenario (`reuse=finished`)", body = JobDocument,
         headers(("Location" = String, description = "Where the job is"))),
        (status = 202, description = "The job was accepted", body = JobDocument,
         headers(("Location" = String, description = "Where the job is"))),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "A request with this Idempotency-Key is being answered", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The scenario or the query breaks rules (`errors` has them all), or the Idempotency-Key came with another request", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many jobs wait; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn submit(
    State(jobs): State<JobService>,
    caller: Caller,
    uri: Uri,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
    ScenarioText(text): ScenarioText,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let labels = query.all("label", LABEL_RULE, label);
    let reuse = query.word("reuse", "finished", |word| {
        (word == "finished").then_some(())
    });
    query.finish()?;
    let new = jobs.validate(&text, labels)?;
    if reuse.is_some()
        && let Some(id) = jobs.finished_like(&new).await?
    {
        let job = named(&jobs, &id.to_string()).await?;
        // One that the caller may not read is none to it.
        if caller.may_read(job.submitter.as_deref()) {
            return Ok(answer(StatusCode::OK, job));
        }
    }
    let request = format!("{uri}\n{text}");
    let key = key(&headers, &request)?;
    let ids = jobs
        .submit(&SubmissionRequest {
            jobs: &[new],
            submitter: caller.name(),
            quota: caller.quota(),
            key,
        })
        .await?;
    let id = ids
        .first()
        .ok_or_else(|| Problem::internal("a request without jobs"))?;
    let job = named(&jobs, &id.to_string()).await?;
    Ok(answer(StatusCode::ACCEPTED, job))
}

/// Rule for a label, for people.
pub(super) const LABEL_RULE: &str = "1 to 64 letters, digits or any of . _ : = / -";

fn answer(status: StatusCode, job: Job) -> Response {
    let location = [(header::LOCATION, format!("/v1/jobs/{}", job.summary.id))];
    (status, location, Json(JobDocument::from(job))).into_response()
}

/// Idempotency-Key of the request, if it has one.
pub(super) fn key<'a>(headers: &'a HeaderMap, request: &str) -> Result<Option<Key<'a>>, Problem> {
    let Some(value) = headers.get("idempotency-key") else {
        return Ok(None);
    };
    let text = value.to_str().unwrap_or_default();
    let is_legal =
        (1..=255).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_graphic());
    if !is_legal {
        return Err(Problem::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "invalid-key",
            "Invalid Idempotency-Key",
            "an Idempotency-Key has 1 to 255 visible ASCII characters",
        ));
    }
    Ok(Some(Key {
        text,
        body_hash: *blake3::hash(request.as_bytes()).as_bytes(),
    }))
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        let detail = error.to_string();
        match error {
            SubmitError::Scenario(error) => error.into(),
            SubmitError::Store(error) => error.into(),
            SubmitError::InFlight => {
                Self::new(StatusCode::CONFLICT, "key-in-use", "Being answered", detail)
            }
            SubmitError::OtherBody => Self::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "key-of-another-request",
                "Idempotency-Key of another request",
                detail,
            ),
            SubmitError::QueueFull { .. } => {
                Self::busy("queue-full", "Too many jobs wait", &detail)
            }
            SubmitError::QuotaSpent { .. } => Self::busy("quota-spent", "Too many jobs", &detail),
        }
    }
}

impl From<ScenarioError> for Problem {
    fn from(error: ScenarioError) -> Self {
        match error {
            ScenarioError::Invalid(violations) => {
                Self::invalid_scenario(violations.into_iter().map(FieldError::from).collect())
            }
            error @ ScenarioError::Malformed { .. } => malformed(&error.to_string()),
        }
    }
}

impl Problem {
    fn busy(kind: &str, title: &'static str, detail: &str) -> Self {
        let detail = format!("{detail}; try again later");
        Self {
            retry_after_s: Some(RETRY_AFTER_S),
            ..Self::new(StatusCode::TOO_MANY_REQUESTS, kind, title, detail)
        }
    }
}
