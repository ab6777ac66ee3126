//! Submission of a scenario.

use super::access::Caller;
use super::choice::Reuse;
use super::documents::JobDocument;
use super::field_errors::{FieldError, FieldErrors};
use super::idempotency;
use super::named_job::named;
use super::problem::Problem;
use super::query::Query;
use super::scenario_body::{ScenarioText, malformed};
use crate::jobs::job::Job;
use crate::jobs::store::{KeptAnswer, Key};
use crate::jobs::submit::{NewJob, ScenarioError, label};
use crate::jobs::{AdmissionError, JobService, Submission, SubmissionRequest, SubmitError};
use crate::terrains::TerrainHash;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode, Uri};
use axum::response::Response;

/// Seconds after which a client may retry if its request was not read in time.
const RETRY_AFTER_S: u8 = 10;

/// Submit a scenario
///
/// The body is the bare scenario. The job is on disk when the answer is sent. With
/// an `Idempotency-Key`, a repeated request gets the answer of the first one.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    tag = "jobs",
    params(
        ("label" = Option<Vec<String>>, Query, explode = true, description = "Labels of the job; may be given several times"),
        ("reuse" = inline(Option<Reuse>), Query, description = "`finished`: a successful job with the same scenario, run by this very program, is as good as a new one"),
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
        (status = 429, description = "Too many jobs wait, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
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
    let reuse: Option<Reuse> = query.choice("reuse");
    query.finish()?;
    let key = idempotency::key(&headers, &format!("{uri}\n{text}"))?;
    if let Some(key) = &key
        && let Some(former) = jobs.former_request(caller.name(), key).await?
    {
        return answer_again(&jobs, &caller, key, former).await;
    }
    let new = validated(&jobs, &caller, (text, labels)).await?;
    let finished = match reuse {
        Some(Reuse::Finished) => readable_like(&jobs, &caller, &new).await?,
        None => None,
    };
    // A finished job is as good: only the key is new.
    let new = finished.is_none().then_some(new);
    let submission = queued(&jobs, &caller, (new, key.clone())).await?;
    if let Some(answer) = submission.answer {
        return Ok(idempotency::response(answer));
    }
    let (status, job) = match (finished, submission.jobs.first()) {
        (Some(job), None) => (StatusCode::OK, job),
        (_, Some(id)) => (StatusCode::ACCEPTED, named(&jobs, &id.to_string()).await?),
        (None, None) => return Err(Problem::internal("a request without jobs")),
    };
    let answer = answer(status, job)?;
    Ok(idempotency::send(&jobs, caller.name(), key.as_ref(), answer).await)
}

/// The job of a scenario, checked in the caller's place in the admission pool.
pub(super) async fn validated(
    jobs: &JobService,
    caller: &Caller,
    (text, labels): (String, Vec<String>),
) -> Result<NewJob, SubmitError> {
    let place = jobs.enter(&caller.share())?;
    let reader = jobs.clone();
    let new = place
        .work(move |_| reader.validate(&text, labels))
        .await??;
    Ok(new)
}

/// Puts the job of a caller's request into the queue, with the request's key.
pub(super) async fn queued(
    jobs: &JobService,
    caller: &Caller,
    (new, key): (Option<NewJob>, Option<Key>),
) -> Result<Submission, SubmitError> {
    jobs.submit(SubmissionRequest {
        jobs: new.into_iter().collect(),
        submitter: caller.name().map(str::to_owned),
        quota: caller.quota(),
        key,
    })
    .await
}

/// A finished job like this one that the caller may read.
async fn readable_like(
    jobs: &JobService,
    caller: &Caller,
    new: &NewJob,
) -> Result<Option<Job>, Problem> {
    let Some(id) = jobs.finished_like(new).await? else {
        return Ok(None);
    };
    let job = jobs.job(id).await?;
    // One that the caller may not read is none to it.
    Ok(job.filter(|job| caller.may_read(job.submitter.as_deref())))
}

/// The answer to a request that came before: the one that was kept, or, if the service died
/// before there was one, one made from its job.
async fn answer_again(
    jobs: &JobService,
    caller: &Caller,
    key: &Key,
    former: Submission,
) -> Result<Response, Problem> {
    if let Some(answer) = former.answer {
        return Ok(idempotency::response(answer));
    }
    let id = former.jobs.first();
    let id = id.ok_or_else(|| Problem::internal("a kept key without a job or an answer"))?;
    let answer = answer(StatusCode::ACCEPTED, named(jobs, &id.to_string()).await?)?;
    Ok(idempotency::send(jobs, caller.name(), Some(key), answer).await)
}

/// Rule for a label, for people.
pub(super) const LABEL_RULE: &str = "1 to 64 letters, digits or any of . _ : = / -";

fn answer(status: StatusCode, job: Job) -> Result<KeptAnswer, Problem> {
    let location = format!("/v1/jobs/{}", job.summary.id);
    idempotency::answer(status, Some(location), &JobDocument::from(job))
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        let detail = error.to_string();
        match error {
            SubmitError::Scenario(error) => error.into(),
            SubmitError::Store(error) => error.into(),
            SubmitError::Admission(error) => error.into(),
            SubmitError::InFlight => Self::conflict("key-in-use", "Being answered", detail),
            SubmitError::OtherRequest => Self::new(
                StatusCode::UNPROCESSABLE_ENTITY,
                "key-of-another-request",
                "Idempotency-Key of another request",
                detail,
            ),
            SubmitError::Closing => Self::new(
                StatusCode::SERVICE_UNAVAILABLE,
                "closing",
                "The service stops",
                detail,
            )
            .retry_after(RETRY_AFTER_S),
            SubmitError::NoTerrain(terrain) => Self::invalid_scenario(no_terrain(terrain, detail)),
            SubmitError::QueueFull { .. } => {
                Self::busy("queue-full", "Too many jobs wait", &detail)
            }
            SubmitError::QuotaSpent { .. } => Self::busy("quota-spent", "Too many jobs", &detail),
        }
    }
}

/// The fault of a document that names a terrain which was removed since it was read.
fn no_terrain(terrain: TerrainHash, detail: String) -> FieldErrors {
    let allowed = "the name of a terrain of this service";
    FieldErrors::from(FieldError {
        detail,
        ..FieldError::of_body("", terrain.to_string().into(), allowed)
    })
}

impl From<AdmissionError> for Problem {
    fn from(error: AdmissionError) -> Self {
        let detail = error.to_string();
        match error {
            AdmissionError::Full { .. } | AdmissionError::ShareSpent { .. } => {
                Self::busy("admission-full", "Too many requests", &detail)
            }
            AdmissionError::TimedOut { .. } => Self::new(
                StatusCode::SERVICE_UNAVAILABLE,
                "timed-out",
                "Timed out",
                detail,
            )
            .retry_after(RETRY_AFTER_S),
            AdmissionError::BrokenOff(_) => Self::internal(&detail),
        }
    }
}

impl From<ScenarioError> for Problem {
    fn from(error: ScenarioError) -> Self {
        match error {
            ScenarioError::Invalid(violations) => Self::invalid_scenario(violations.into()),
            error @ ScenarioError::Malformed { .. } => malformed(&error.to_string()),
        }
    }
}
