//! Jobs: get, dismiss, remove.

use super::access::Caller;
use super::choice::Remove;
use super::documents::JobDocument;
use super::etag;
use super::named_job::{NamedJob, find, named, unknown_job};
use super::problem::Problem;
use super::query::Query;
use super::shares::StreamRight;
use crate::jobs::job::{Job, JobId};
use crate::jobs::store::Removal;
use crate::jobs::{Dismissed, JobService};
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use std::time::Duration;

/// Longest time for which a request may wait for the end of a job [s].
pub(super) const LONGEST_WAIT_S: u32 = 60;

/// Get a job
///
/// With `wait` the answer comes once the job has ended or that time has passed.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("wait" = Option<String>, Query, description = "Seconds to wait for the job's end, as `30s`; at most `60s`"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The job", body = JobDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(super) async fn show(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    right: StreamRight,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let wait_s = read_wait(&mut query);
    query.finish()?;
    let job = find(&jobs, &caller, &id).await?;
    let Some(seconds) = wait_s else {
        return etag::json(&headers, &JobDocument::from(job));
    };
    let longest = Duration::from_secs(u64::from(seconds));
    let place = right.enter()?;
    jobs.wait_for_end(job.summary.id, longest).await?;
    drop(place);
    etag::json(
        &headers,
        &JobDocument::from(find(&jobs, &caller, &id).await?),
    )
}

/// Dismiss or remove a job
///
/// A dismissed job that waits never starts; a running one stops within half a
/// second and keeps its records. A second dismissal changes nothing. With
/// `remove=ended` a job that has ended is removed with all its results.
#[utoipa::path(
    delete,
    path = "/v1/jobs/{id}",
    tag = "jobs",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("remove" = inline(Option<Remove>), Query, description = "Remove the job, which must have ended"),
    ),
    responses(
        (status = 200, description = "The job, dismissed", body = JobDocument),
        (status = 204, description = "The job is removed"),
        (status = 403, description = "The job is another's", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "The job had ended otherwise; or is to be removed and has not ended", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn dismiss(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let remove: Option<Remove> = query.choice("remove");
    query.finish()?;
    if remove.is_some() {
        let job = changeable(&jobs, &caller, &id).await?;
        return removed(&jobs, job, &id).await;
    }
    let job = dismissed(&jobs, &caller, &id).await?;
    Ok(Json(JobDocument::from(job)).into_response())
}

/// The job of this name, if the caller may change it.
async fn changeable(jobs: &JobService, caller: &Caller, id: &str) -> Result<JobId, Problem> {
    let job = named(jobs, id).await?;
    caller.may_change(job.submitter.as_deref())?;
    Ok(job.summary.id)
}

/// Dismisses the job of this name.
pub(super) async fn dismissed(
    jobs: &JobService,
    caller: &Caller,
    id: &str,
) -> Result<Job, Problem> {
    let job = changeable(jobs, caller, id).await?;
    match jobs.dismiss(job).await? {
        Dismissed::Done(job) => Ok(*job),
        Dismissed::Unknown => Err(unknown_job(id)),
        Dismissed::TooLate(status) => Err(Problem::conflict(
            "job-ended",
            "The job has ended",
            format!(
                "job {id} is {}: it can't be dismissed any more",
                status.word()
            ),
        )),
    }
}

async fn removed(jobs: &JobService, job: JobId, id: &str) -> Result<Response, Problem> {
    match jobs.remove(job).await? {
        Removal::Removed => Ok(StatusCode::NO_CONTENT.into_response()),
        Removal::Unknown => Err(unknown_job(id)),
        Removal::Active => Err(Problem::conflict(
            "job-active",
            "The job has not ended",
            format!("job {id} has not ended: dismiss it first"),
        )),
    }
}

/// Value of `wait` [s].
fn read_wait(query: &mut Query) -> Option<u32> {
    let text = query.take("wait")?;
    let seconds = |number: &str| number.parse().ok().filter(|&s: &u32| s <= LONGEST_WAIT_S);
    if let Some(seconds) = text.strip_suffix('s').and_then(seconds) {
        return Some(seconds);
    }
    let rule = format!("0s <= x <= {LONGEST_WAIT_S}s");
    let rule = match seconds(&text) {
        Some(number) => format!("{rule}; did you mean {number}s?"),
        None => rule,
    };
    query.refuse("wait", &text, &rule, Some("s"));
    None
}
