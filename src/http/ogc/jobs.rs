//! Jobs as the standard shows them: list, state, dismissal.

use super::super::access::Caller;
use super::super::jobs::dismissed;
use super::super::listing::{PageParameters, page_of, read_page};
use super::super::named_job::{NamedJob, find};
use super::super::problem::Problem;
use super::super::query::Query;
use super::exceptions::of_standard;
use super::links::{Base, Link};
use super::process;
use super::status_info::StatusInfoDocument;
use crate::jobs::JobService;
use axum::Json;
use axum::extract::{RawQuery, State};
use form_urlencoded::Serializer;
use serde::Serialize;
use utoipa::ToSchema;

/// A page of jobs, newest first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = JobList)]
pub(super) struct JobListDocument {
    /// The jobs.
    jobs: Vec<StatusInfoDocument>,
    /// Links to this page and to the next one, if there is one.
    links: Vec<Link>,
}

/// List jobs by their state
///
/// Newest first, also those submitted to `/v1/jobs`. A page at a time: the link `next` leads to
/// the next one.
#[utoipa::path(
    get,
    path = "/ogc/jobs",
    tag = super::TAG,
    params(
        ("type" = Option<String>, Query, description = "`process`, the only kind of job"),
        ("processID" = Option<String>, Query, description = "`simulation`, the only process"),
        PageParameters,
    ),
    responses((status = 200, description = "A page of jobs", body = JobListDocument)),
)]
pub(super) async fn job_list(
    State(jobs): State<JobService>,
    base: Base,
    RawQuery(asked): RawQuery,
) -> Result<Json<JobListDocument>, Problem> {
    let mut query = Query::new(asked.as_deref());
    for (name, only) in [("type", "process"), ("processID", process::ID)] {
        query.word(name, only, |word| (word == only).then_some(()));
    }
    let page = read_page(&mut query);
    query.finish()?;
    let (found, next) = page_of(&jobs, &page).await?;
    let at = |query: &str| match query {
        "" => "/ogc/jobs".to_owned(),
        query => format!("/ogc/jobs?{query}"),
    };
    let own = asked.unwrap_or_default();
    let next = next.map(|cursor| at(&with_cursor(&own, &cursor)));
    let next = next.map(|next| base.json(next, "next", "The next page"));
    let own = base.json(at(&own), "self", "This page");
    Ok(Json(JobListDocument {
        jobs: found
            .into_iter()
            .map(|job| StatusInfoDocument::of(job.summary, &base))
            .collect(),
        links: [own].into_iter().chain(next).collect(),
    }))
}

/// The same query for another page.
fn with_cursor(query: &str, cursor: &str) -> String {
    let mut next = Serializer::new(String::new());
    let others = form_urlencoded::parse(query.as_bytes()).filter(|(name, _)| name != "cursor");
    next.extend_pairs(others).append_pair("cursor", cursor);
    next.finish()
}

/// Get the state of a job
///
/// `progress` is in percent; an ended job links to its results.
#[utoipa::path(
    get,
    path = "/ogc/jobs/{id}",
    tag = super::TAG,
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses((status = 200, description = "Its state", body = StatusInfoDocument)),
)]
pub(super) async fn job_status(
    State(jobs): State<JobService>,
    caller: Caller,
    base: Base,
    NamedJob(id): NamedJob,
) -> Result<Json<StatusInfoDocument>, Problem> {
    let job = find(&jobs, &caller, &id).await.map_err(of_standard)?;
    Ok(Json(StatusInfoDocument::of(job.summary, &base)))
}

/// Dismiss a job by its state
///
/// As `DELETE /v1/jobs/{id}` does. A job that was successful or has failed is not dismissed any
/// more, and keeps its results.
#[utoipa::path(
    delete,
    path = "/ogc/jobs/{id}",
    tag = super::TAG,
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The job, dismissed", body = StatusInfoDocument),
        (status = 403, description = "The job is another's", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "The job had ended otherwise", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn dismiss_job(
    State(jobs): State<JobService>,
    caller: Caller,
    base: Base,
    NamedJob(id): NamedJob,
) -> Result<Json<StatusInfoDocument>, Problem> {
    let job = dismissed(&jobs, &caller, &id).await.map_err(of_standard)?;
    Ok(Json(StatusInfoDocument::of(job.summary, &base)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_page_keeps_the_filters() {
        assert_eq!(with_cursor("", "j5"), "cursor=j5");
        let next = with_cursor("status=failed&cursor=j9&limit=2", "j5");
        assert_eq!(next, "status=failed&limit=2&cursor=j5");
    }
}
