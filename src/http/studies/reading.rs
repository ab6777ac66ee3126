//! Studies and their answers, read.

use super::asked::AskedStudy;
use super::documents::{StudyDocument, StudyPageDocument, StudySummaryDocument};
use super::named::{NamedStudy, readable};
use crate::http::access::Caller;
use crate::http::etag;
use crate::http::paging::{PagedList, cut_to_page, read_limit};
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::jobs::store::StudyPage;
use crate::studies::StudyService;
use crate::studies::study::StudyStatus;
use axum::extract::{RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use scree_studies::Answers;

/// List studies, newest first
///
/// A page at a time: `next_cursor` of one is the `cursor` of the next, with the same filter.
#[utoipa::path(
    get,
    path = "/v1/studies",
    tag = "studies",
    params(
        ("status" = Option<StudyStatus>, Query, description = "Only studies of this state"),
        ("limit" = Option<u32>, Query, description = "Most studies of the page", minimum = 1, maximum = 100),
        ("cursor" = Option<String>, Query, description = "`next_cursor` of the page before"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "A page of studies", body = StudyPageDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(in crate::http) async fn list_studies(
    State(studies): State<StudyService>,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let status = query.choice("status");
    let before = PagedList::STUDIES.read_cursor(&mut query);
    let limit = read_limit(&mut query);
    query.finish()?;
    let page = StudyPage {
        status,
        before,
        limit: limit + 1,
    };
    let mut found = studies.studies(&page).await?;
    let next_cursor =
        cut_to_page(&mut found, limit).map(|study| PagedList::STUDIES.cursor(study.sequence));
    let document = StudyPageDocument {
        next_cursor,
        studies: found.iter().map(StudySummaryDocument::from).collect(),
    };
    etag::json(&headers, &document)
}

/// Get a study
///
/// Its state, its document as enlarged last, and how many of its members have been made and have
/// ended.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The study", body = StudyDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(in crate::http) async fn show_study(
    State(studies): State<StudyService>,
    caller: Caller,
    NamedStudy(id): NamedStudy,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let study = readable(&studies, &caller, &id).await?;
    etag::json(&headers, &StudyDocument::from(study))
}

/// Get the answers of a study
///
/// From the members that have ended so far, each with its uncertainty: members that failed, wait or
/// run could have come out in any way, and widen the bounds.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/answers",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The answers", body = Answers),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_answers(
    asked: AskedStudy,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let answers = asked.make(|outcomes| Ok(outcomes.answers())).await?;
    etag::json(&headers, &answers)
}
