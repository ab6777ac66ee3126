//! Jobs: submit, list, look at, dismiss.

use super::contract::ScenarioDocument;
use super::documents::{JobDocument, JobPageDocument};
use super::named_job::NamedJob;
use super::problem::Problem;
use super::query::Query;
use super::scenario_body::{ScenarioText, malformed};
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::store::Page;
use crate::jobs::submit::ScenarioError;
use crate::jobs::{Dismissed, Jobs, SubmitError};
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};

/// Jobs of one page, unless the client says otherwise.
const DEFAULT_LIMIT: u32 = 20;

/// Most jobs of one page.
const LARGEST_LIMIT: u32 = 100;

/// Submit a scenario
///
/// The body is the bare scenario. The job is on disk when the answer comes.
#[utoipa::path(
    post,
    path = "/v1/jobs",
    tag = "jobs",
    request_body = ScenarioDocument,
    responses(
        (status = 202, description = "The job was accepted", body = JobDocument,
         headers(("Location" = String, description = "Where the job is"))),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The scenario breaks rules; `errors` has them all", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn submit(
    State(jobs): State<Jobs>,
    ScenarioText(text): ScenarioText,
) -> Result<Response, Problem> {
    let job = jobs.submit(&text).await?;
    let location = format!("/v1/jobs/{}", job.summary.id);
    let document = Json(JobDocument::from(job));
    Ok((
        StatusCode::ACCEPTED,
        [(header::LOCATION, location)],
        document,
    )
        .into_response())
}

/// List jobs, newest first
#[utoipa::path(
    get,
    path = "/v1/jobs",
    tag = "jobs",
    params(
        ("status" = Option<JobStatus>, Query, description = "Only jobs of this state"),
        ("limit" = Option<u32>, Query, minimum = 1, maximum = 100, description = "Most jobs of the page; 20 unless given"),
        ("cursor" = Option<String>, Query, description = "`next_cursor` of the page before"),
    ),
    responses(
        (status = 200, description = "A page of jobs", body = JobPageDocument),
        (status = 422, description = "A parameter is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn list(
    State(jobs): State<Jobs>,
    RawQuery(query): RawQuery,
) -> Result<Json<JobPageDocument>, Problem> {
    let page = read_page(query.as_deref())?;
    // One more than asked for tells whether there is a next page.
    let mut found = jobs
        .page(Page {
            limit: page.limit + 1,
            ..page
        })
        .await?;
    let more = found.len() > page.limit as usize;
    found.truncate(page.limit as usize);
    let last = found.last().filter(|_| more);
    let next_cursor = last.map(|job| cursor::write(job.sequence));
    Ok(Json(JobPageDocument {
        jobs: found.into_iter().map(Into::into).collect(),
        next_cursor,
    }))
}

/// Look at a job
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    params(("id" = String, Path, description = "Identity of the job")),
    responses(
        (status = 200, description = "The job", body = JobDocument),
        (status = 404, description = "There is no such job", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn show(
    State(jobs): State<Jobs>,
    NamedJob(id): NamedJob,
) -> Result<Json<JobDocument>, Problem> {
    Ok(Json(find(&jobs, &id).await?.into()))
}

/// Dismiss a job
///
/// A waiting job never starts; a running one stops within half a second and
/// keeps what it recorded. Dismissing it again changes nothing.
#[utoipa::path(
    delete,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    params(("id" = String, Path, description = "Identity of the job")),
    responses(
        (status = 200, description = "The job, dismissed", body = JobDocument),
        (status = 404, description = "There is no such job", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "The job had ended otherwise", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn dismiss(
    State(jobs): State<Jobs>,
    NamedJob(id): NamedJob,
) -> Result<Json<JobDocument>, Problem> {
    match jobs.dismiss(parse_id(&id)?).await? {
        Dismissed::Done(job) => Ok(Json((*job).into())),
        Dismissed::Unknown => Err(unknown_job(&id)),
        Dismissed::TooLate(status) => Err(Problem::new(
            StatusCode::CONFLICT,
            "job-ended",
            "The job has ended",
            format!(
                "job {id} is {}: it can't be dismissed any more",
                status.word()
            ),
        )),
    }
}

/// The job of this id, or the problem that there is none.
pub(super) async fn find(jobs: &Jobs, id: &str) -> Result<Job, Problem> {
    jobs.job(parse_id(id)?)
        .await?
        .ok_or_else(|| unknown_job(id))
}

fn parse_id(id: &str) -> Result<JobId, Problem> {
    id.parse().map_err(|_| unknown_job(id))
}

pub(super) fn unknown_job(id: &str) -> Problem {
    Problem::not_found("unknown-job", format!("there is no job {id}"))
}

fn read_page(query: Option<&str>) -> Result<Page, Problem> {
    let mut query = Query::new(query);
    let words = JobStatus::ALL.map(JobStatus::word).join(", ");
    let page = Page {
        status: query.word("status", &format!("one of {words}"), JobStatus::from_word),
        limit: query
            .whole("limit", 1..=LARGEST_LIMIT)
            .unwrap_or(DEFAULT_LIMIT),
        before: query.word("cursor", "the next_cursor of another page", cursor::read),
    };
    query.finish()?;
    Ok(page)
}

impl From<SubmitError> for Problem {
    fn from(error: SubmitError) -> Self {
        match error {
            SubmitError::Scenario(error) => error.into(),
            SubmitError::Store(error) => error.into(),
        }
    }
}

impl From<ScenarioError> for Problem {
    fn from(error: ScenarioError) -> Self {
        match error {
            ScenarioError::Invalid(violations) => Self::invalid_scenario(violations),
            error @ ScenarioError::Malformed { .. } => malformed(&error.to_string()),
        }
    }
}

/// The place in the list after which a page begins; opaque to clients.
mod cursor {
    pub(super) fn write(sequence: i64) -> String {
        format!("j{sequence:x}")
    }

    pub(super) fn read(text: &str) -> Option<i64> {
        i64::from_str_radix(text.strip_prefix('j')?, 16).ok()
    }
}
