//! Submission of many scenarios at once.

use super::access::Caller;
use super::problem::{FieldError, Problem};
use super::query::Query;
use super::scenario_body::{ScenarioText, malformed};
use super::submission::{LABEL_RULE, key};
use crate::jobs::job::JobId;
use crate::jobs::submit::{LABELS_AT_MOST, NewJob, ScenarioError, excerpt, label};
use crate::jobs::{JobService, SubmissionRequest};
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, Uri};
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

/// Many scenarios in one request.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = Batch)]
pub(super) struct BatchDocument {
    /// Labels of every job.
    #[serde(default)]
    labels: Vec<String>,
    /// The jobs.
    #[schema(min_items = 1)]
    jobs: Vec<BatchJob>,
}

/// One of many scenarios.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BatchJob {
    /// The scenario.
    #[schema(value_type = crate::jobs::documents::Scenario)]
    scenario: Box<RawValue>,
    /// Additional labels of this job.
    #[serde(default)]
    labels: Vec<String>,
}

/// Result of a batch: its jobs, in its order.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = BatchAnswer)]
pub(super) struct BatchAnswer {
    /// Identifiers of the jobs.
    #[schema(value_type = Vec<String>)]
    ids: Vec<String>,
}

/// Submit many scenarios
///
/// All of them are accepted in one transaction, or none.
#[utoipa::path(
    post,
    path = "/v1/batches",
    tag = "jobs",
    params(
        ("Idempotency-Key" = Option<String>, Header, description = "A name for this request, 1 to 255 visible ASCII characters"),
    ),
    request_body = BatchDocument,
    responses(
        (status = 202, description = "The jobs were accepted", body = BatchAnswer),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "A request with this Idempotency-Key is being answered", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "Scenarios break rules (`errors` has them all), or the Idempotency-Key came with another request", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many jobs wait; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn submit_batch(
    State(jobs): State<JobService>,
    caller: Caller,
    uri: Uri,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
    ScenarioText(text): ScenarioText,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let batch = read_batch(&text)?;
    let new = admit_all(&jobs, &batch)?;
    let request = format!("{uri}\n{text}");
    let key = key(&headers, &request)?;
    let ids = jobs
        .submit(&SubmissionRequest {
            jobs: &new,
            submitter: caller.name(),
            quota: caller.quota(),
            key,
        })
        .await?;
    let ids = ids.iter().map(JobId::to_string).collect();
    Ok((StatusCode::ACCEPTED, Json(BatchAnswer { ids })).into_response())
}

fn read_batch(text: &str) -> Result<BatchDocument, Problem> {
    let batch: BatchDocument = serde_json::from_str(text).map_err(|error| {
        if !error.is_data() {
            return malformed(&error.to_string());
        }
        Problem::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "invalid-batch",
            "Invalid batch",
            without_long_texts(&error),
        )
    })?;
    if batch.jobs.is_empty() {
        let none = FieldError::of_body("/jobs", "at least one job");
        return Err(Problem::invalid_scenario(vec![none]));
    }
    Ok(batch)
}

/// The parser's message, which repeats a wrong key or text in full.
fn without_long_texts(error: &serde_json::Error) -> String {
    let position = format!(" at line {} column {}", error.line(), error.column());
    let message = error.to_string().replace(&position, "");
    format!("{}{position}", excerpt(&message))
}

/// Checks every scenario and every label; the problem lists all faults.
fn admit_all(jobs: &JobService, batch: &BatchDocument) -> Result<Vec<NewJob>, Problem> {
    let mut wrong = Vec::new();
    let common = read_labels(&batch.labels, "/labels", &mut wrong);
    let mut admitted = Vec::new();
    for (place, job) in batch.jobs.iter().enumerate() {
        let at = format!("/jobs/{place}");
        let mut labels = read_labels(&job.labels, &format!("{at}/labels"), &mut wrong);
        labels.extend_from_slice(&common);
        match jobs.validate(job.scenario.get(), labels) {
            Ok(new) => admitted.push(new),
            Err(ScenarioError::Invalid(violations)) => {
                let named = violations.into_iter().map(FieldError::from);
                wrong.extend(named.map(|error| error.under(&format!("{at}/scenario"))));
            }
            Err(error @ ScenarioError::Malformed { .. }) => {
                wrong.push(FieldError::of_body(
                    &format!("{at}/scenario"),
                    &error.to_string(),
                ));
            }
        }
    }
    if wrong.is_empty() {
        Ok(admitted)
    } else {
        Err(Problem::invalid_scenario(wrong))
    }
}

fn read_labels(texts: &[String], at: &str, wrong: &mut Vec<FieldError>) -> Vec<String> {
    if texts.len() > LABELS_AT_MOST {
        let rule = format!("at most {LABELS_AT_MOST} labels");
        wrong.push(FieldError::of_body(at, &rule));
    }
    let mut labels = Vec::new();
    for (place, text) in texts.iter().enumerate() {
        match label(text) {
            Some(label) => labels.push(label),
            None => wrong.push(FieldError::of_body(&format!("{at}/{place}"), LABEL_RULE)),
        }
    }
    labels
}
