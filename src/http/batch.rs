//! Submission of many scenarios at once.

use super::access::Caller;
use super::field_errors::{FieldError, FieldErrors};
use super::idempotency;
use super::problem::Problem;
use super::query::Query;
use super::scenario_body::{ScenarioText, read_envelope};
use super::submission::LABEL_RULE;
use crate::jobs::job::JobId;
use crate::jobs::store::{Key, StoreError};
use crate::jobs::submit::{LABELS_AT_MOST, NewJob, ScenarioError, excerpt, label};
use crate::jobs::{JobService, Submission, SubmissionRequest};
use crate::terrains::ReadError;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, Uri};
use axum::response::Response;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use serde_json::{Value, json};
use std::iter::Enumerate;
use std::time::{Duration, Instant};
use std::vec;
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
    #[schema(value_type = Vec<uuid::Uuid>)]
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
        (status = 429, description = "Too many jobs wait, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
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
    let key = idempotency::key(&headers, &format!("{uri}\n{text}"))?;
    let submitter = caller.name();
    if let Some(key) = &key
        && let Some(former) = jobs.former_request(submitter, key).await?
    {
        return send(&jobs, submitter, Some(key), former).await;
    }
    let new = read_in_slices(&jobs, &caller, text).await?;
    let submission = jobs
        .submit(SubmissionRequest {
            jobs: new,
            submitter: submitter.map(str::to_owned),
            quota: caller.quota(),
            key: key.clone(),
        })
        .await?;
    send(&jobs, submitter, key.as_ref(), submission).await
}

/// Reads and checks a batch in slices, between which others have their turns.
async fn read_in_slices(
    jobs: &JobService,
    caller: &Caller,
    text: String,
) -> Result<Vec<NewJob>, Problem> {
    let place = jobs.enter(&caller.share())?;
    let batch = place.work(move |_| read_batch(&text)).await??;
    let mut reading = BatchReading::new(jobs.clone(), batch);
    while !reading.is_done() {
        reading = place.work(move |_| reading.slice()).await?;
    }
    reading.finish()
}

/// Sends the answer to a batch: the one kept of the first request with its key, if there is one.
async fn send(
    jobs: &JobService,
    submitter: Option<&str>,
    key: Option<&Key>,
    submission: Submission,
) -> Result<Response, Problem> {
    if let Some(answer) = submission.answer {
        return Ok(idempotency::response(answer));
    }
    let ids = submission.jobs.iter().map(JobId::to_string).collect();
    let answer = idempotency::answer(StatusCode::ACCEPTED, None, &BatchAnswer { ids })?;
    Ok(idempotency::send(jobs, submitter, key, answer).await)
}

fn read_batch(text: &str) -> Result<BatchDocument, Problem> {
    let batch: BatchDocument = read_envelope(text, ("invalid-batch", "Invalid batch"))?;
    if batch.jobs.is_empty() {
        let none = FieldError::of_body("/jobs", json!([]), "at least one job");
        return Err(Problem::invalid_scenario(none.into()));
    }
    Ok(batch)
}

/// Longest time for which scenarios are checked before others have their turn.
const SLICE: Duration = Duration::from_millis(50);

/// A batch whose scenarios and labels are being checked; all faults are listed.
struct BatchReading {
    jobs: JobService,
    common: Vec<String>,
    left: Enumerate<vec::IntoIter<BatchJob>>,
    admitted: Vec<NewJob>,
    wrong: FieldErrors,
    /// Error of the store, by which a scenario could not be read.
    broken: Option<StoreError>,
}

impl BatchReading {
    fn new(jobs: JobService, batch: BatchDocument) -> Self {
        let mut wrong = FieldErrors::default();
        Self {
            jobs,
            common: read_labels(&batch.labels, "/labels", &mut wrong),
            left: batch.jobs.into_iter().enumerate(),
            admitted: Vec::new(),
            wrong,
            broken: None,
        }
    }

    fn is_done(&self) -> bool {
        self.left.len() == 0
    }

    /// Checks some of the jobs, at least one.
    fn slice(mut self) -> Self {
        let began = Instant::now();
        while let Some((place, job)) = self.left.next() {
            self.check(place, &job);
            if began.elapsed() >= SLICE {
                break;
            }
        }
        self
    }

    fn check(&mut self, place: usize, job: &BatchJob) {
        let at = format!("/jobs/{place}");
        let wrong = &mut self.wrong;
        let mut labels = read_labels(&job.labels, &format!("{at}/labels"), wrong);
        labels.extend_from_slice(&self.common);
        match self.jobs.validate(job.scenario.get(), labels) {
            Ok(new) => self.admitted.push(new),
            Err(ReadError::Scenario(ScenarioError::Invalid(violations))) => {
                let at = format!("{at}/scenario");
                for violation in violations {
                    wrong.add(|| FieldError::from(violation).under(&at));
                }
            }
            Err(ReadError::Scenario(error @ ScenarioError::Malformed { .. })) => {
                let at = format!("{at}/scenario");
                wrong.add(|| FieldError::of_body(&at, Value::Null, &error.to_string()));
            }
            Err(ReadError::Store(error)) => self.broken = Some(error),
        }
    }

    fn finish(self) -> Result<Vec<NewJob>, Problem> {
        if let Some(error) = self.broken {
            Err(error.into())
        } else if self.wrong.is_empty() {
            Ok(self.admitted)
        } else {
            Err(Problem::invalid_scenario(self.wrong))
        }
    }
}

/// The labels; of a list that is too long none is read.
fn read_labels(texts: &[String], at: &str, wrong: &mut FieldErrors) -> Vec<String> {
    if texts.len() > LABELS_AT_MOST {
        let rule = format!("at most {LABELS_AT_MOST} labels");
        let value = json!(format!("{} labels", texts.len()));
        wrong.add(|| FieldError::of_body(at, value, &rule));
        return Vec::new();
    }
    let mut labels = Vec::new();
    for (place, text) in texts.iter().enumerate() {
        match label(text) {
            Some(label) => labels.push(label),
            None => wrong.add(|| {
                let value = Value::from(excerpt(text));
                FieldError::of_body(&format!("{at}/{place}"), value, LABEL_RULE)
            }),
        }
    }
    labels
}
