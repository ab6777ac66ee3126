//! Lists of jobs.

use super::choice::Include;
use super::documents::{JobPageDocument, JobSummaryDocument};
use super::etag;
use super::paging::{PagedList, read_limit};
use super::problem::Problem;
use super::query::Query;
use super::submission::LABEL_RULE;
use crate::jobs::JobService;
use crate::jobs::job::JobStatus;
use crate::jobs::store::{ListedJob, Page};
use crate::jobs::submit::label;
use axum::extract::{RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;

/// Page of jobs that is asked for.
#[derive(utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "a type of the contract: the query has a reader of its own"
)]
pub(super) struct PageParameters {
    /// Only jobs of these states.
    #[param(explode = false)]
    status: Option<Vec<JobStatus>>,
    /// Only jobs with this label.
    label: Option<String>,
    /// Members of studies are listed, too, unless this is false.
    #[param(default = true)]
    members: Option<bool>,
    /// Only jobs accepted at this time or later (RFC 3339).
    #[param(format = DateTime)]
    created_from: Option<String>,
    /// Only jobs accepted at this time or earlier (RFC 3339).
    #[param(format = DateTime)]
    created_to: Option<String>,
    /// Most jobs of the page.
    #[param(minimum = 1, maximum = 100, default = 20)]
    limit: Option<u32>,
    /// `next_cursor` of the page before.
    cursor: Option<String>,
}

/// Parts of jobs that are asked for.
#[derive(utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "a type of the contract: the query has a reader of its own"
)]
struct IncludeParameter {
    /// Parts of the jobs that the list has beside their summaries. A page whose outcomes have more
    /// than 1 MiB ends there.
    #[param(inline, explode = false)]
    include: Option<Vec<Include>>,
}

/// List jobs, newest first
///
/// A page at a time: `next_cursor` of one is the `cursor` of the next, with the same filters.
#[utoipa::path(
    get,
    path = "/v1/jobs",
    tag = "jobs",
    params(
        PageParameters,
        IncludeParameter,
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "A page of jobs", body = JobPageDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(super) async fn list(
    State(jobs): State<JobService>,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let include: Option<Vec<Include>> = query.choices("include");
    let outcomes = include.is_some_and(|parts| parts.contains(&Include::Outcome));
    let page = Page {
        outcomes,
        ..read_page(&mut query)
    };
    query.finish()?;
    let (found, next_cursor) = page_of(&jobs, &page).await?;
    let found = found.into_iter().map(|job| JobSummaryDocument {
        outcome: outcomes.then_some(job.outcome),
        ..job.summary.into()
    });
    let document = JobPageDocument {
        jobs: found.collect(),
        next_cursor,
    };
    etag::json(&headers, &document)
}

/// The page that a query asks for, without outcomes.
pub(super) fn read_page(query: &mut Query) -> Page {
    let statuses = query.choices("status");
    let created_from = query.time("created_from");
    let created_to = query.time("created_to");
    if let (Some(from), Some(to)) = (created_from, created_to)
        && to < from
    {
        let rule = format!("x >= created_from = {from}");
        query.refuse("created_to", &to.to_string(), &rule, None);
    }
    Page {
        statuses: statuses.unwrap_or_else(|| JobStatus::ALL.to_vec()),
        label: query.word("label", LABEL_RULE, label),
        members: query.truth("members").unwrap_or(true),
        created_from,
        created_to,
        before: PagedList::JOBS.read_cursor(query),
        limit: read_limit(query),
        outcomes: false,
    }
}

/// The jobs of a page, and the cursor of the next one if there is one.
pub(super) async fn page_of(
    jobs: &JobService,
    page: &Page,
) -> Result<(Vec<ListedJob>, Option<String>), Problem> {
    let found = jobs.page(page).await?;
    let last = found.jobs.last().filter(|_| found.more);
    let next_cursor = last.map(|job| PagedList::JOBS.cursor(job.summary.sequence));
    Ok((found.jobs, next_cursor))
}
