//! Execution of the process.

use super::super::access::Caller;
use super::super::idempotency;
use super::super::named_job::named;
use super::super::problem::Problem;
use super::super::scenario_body::ScenarioText;
use super::super::shares::StreamRight;
use super::super::submission::{queued, validated};
use super::execute_request::{ExecuteDocument, ExecuteRequest, SCENARIO};
use super::links::Base;
use super::preferences::Preferences;
use super::processes::NamedProcess;
use super::results::{self, ResultsDocument};
use super::status_info::StatusInfoDocument;
use crate::jobs::job::{Job, JobId};
use crate::jobs::store::{KeptAnswer, Key};
use crate::jobs::{JobService, Submission};
use axum::extract::State;
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri};
use axum::response::Response;

/// Execute a process
///
/// The job is that of `POST /v1/jobs` with this scenario, and is on disk when the answer is sent.
/// The answer is the results, unless the client prefers not to wait (`Prefer: respond-async`) or
/// the job takes longer than the answer may wait: then it is the state of the job, which goes on.
#[utoipa::path(
    post,
    path = "/ogc/processes/{process}/execution",
    tag = super::TAG,
    params(
        ("process" = String, Path, description = "Name of the process, which is `simulation`"),
        ("Prefer" = Option<String>, Header, description = "`respond-async`: answer at once; `wait=30`: wait at most these seconds, 60 at most and unless given (RFC 7240)"),
        ("Idempotency-Key" = Option<String>, Header, description = "A name for this request, 1 to 255 visible ASCII characters"),
    ),
    request_body = ExecuteDocument,
    responses(
        (status = 200, description = "The results, or the bare outcome if it alone is asked for", body = ResultsDocument,
         headers(("Link" = String, description = "To the job (`monitor`)"))),
        (status = 201, description = "The job was accepted and has not ended", body = StatusInfoDocument,
         headers(
            ("Location" = String, description = "Where the job is"),
            ("Preference-Applied" = String, description = "`respond-async`, if it was preferred"))),
        (status = 204, description = "The results are in the headers `Link`",
         headers(("Link" = String, description = "To each output (`item`), and to the job (`monitor`)"))),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "There is no such process, or the job was dismissed", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "A request with this Idempotency-Key is being answered", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The request or the scenario breaks rules (`errors` has them all), or the Idempotency-Key came with another request", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many jobs wait, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 500, description = "The job has failed: the problem is the job's; or a defect", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn execute(
    State(jobs): State<JobService>,
    caller: Caller,
    _: NamedProcess,
    base: Base,
    (uri, headers, right): (Uri, HeaderMap, StreamRight),
    ScenarioText(text): ScenarioText,
) -> Result<Response, Problem> {
    let preferences = Preferences::of(&headers);
    let request = ExecuteRequest::read(&text)?;
    let key = idempotency::key(&headers, &format!("{uri}\n{text}"))?;
    // Taken before the job is: who may not wait is told so before anything is stored.
    let place = match preferences.wait.is_zero() {
        true => None,
        false => Some(right.enter()?),
    };
    let submission = accept(&jobs, &caller, (request.scenario, key.clone())).await?;
    let id = submission.jobs.first().copied();
    let accepted = created(&jobs, &caller, (submission, key), &base).await?;
    let mut ended = None;
    if let Some(id) = id {
        ended = ended_within(&jobs, id, preferences).await?;
    }
    drop(place);
    match ended {
        Some(job) => results::answer(job, &request.answer, &base),
        None => Ok(not_waited_for(accepted, preferences)),
    }
}

/// The job of a request: that of the first one with its key, or a new one in the queue.
async fn accept(
    jobs: &JobService,
    caller: &Caller,
    (scenario, key): (String, Option<Key>),
) -> Result<Submission, Problem> {
    if let Some(key) = &key
        && let Some(former) = jobs.former_request(caller.name(), key).await?
    {
        return Ok(former);
    }
    let new = validated(jobs, caller, (scenario, Vec::new())).await;
    let new = new.map_err(|error| Problem::from(error).under(SCENARIO))?;
    Ok(queued(jobs, caller, (Some(new), key)).await?)
}

/// The answer that the job was accepted, kept for repetitions of a request with a key.
async fn created(
    jobs: &JobService,
    caller: &Caller,
    (submission, key): (Submission, Option<Key>),
    base: &Base,
) -> Result<KeptAnswer, Problem> {
    if let Some(kept) = submission.answer {
        return Ok(kept);
    }
    let id = submission.jobs.first();
    let id = id.ok_or_else(|| Problem::internal("a request without jobs"))?;
    let job = named(jobs, &id.to_string()).await?;
    let location = base.at(format_args!("/ogc/jobs/{id}"));
    let state = StatusInfoDocument::of(job.summary, base);
    let answer = idempotency::answer(StatusCode::CREATED, Some(location), &state)?;
    Ok(match &key {
        Some(key) => jobs.keep_answer(caller.name(), key, answer).await,
        None => answer,
    })
}

/// The job, if it ends while its client waits.
async fn ended_within(
    jobs: &JobService,
    id: JobId,
    preferences: Preferences,
) -> Result<Option<Job>, Problem> {
    if preferences.wait.is_zero() {
        return Ok(None);
    }
    jobs.wait_for_end(id, preferences.wait).await?;
    let job = jobs.job(id).await?;
    Ok(job.filter(|job| job.summary.status.is_final()))
}

fn not_waited_for(accepted: KeptAnswer, preferences: Preferences) -> Response {
    let mut response = idempotency::response(accepted);
    if preferences.respond_async {
        let applied = HeaderValue::from_static("respond-async");
        response.headers_mut().insert("preference-applied", applied);
    }
    response
}
