//! Members of a study.

use super::documents::{MemberDocument, MemberPageDocument};
use super::named::{NamedStudy, readable};
use crate::http::access::Caller;
use crate::http::etag;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::jobs::store::ListedMember;
use crate::studies::StudyService;
use axum::extract::{RawQuery, State};
use axum::http::HeaderMap;
use axum::response::Response;
use scree_studies::Ensemble;
use serde_json::value::RawValue;

/// Default number of members per page.
const DEFAULT_LIMIT: u32 = 100;

/// Largest number of members per page.
const LARGEST_LIMIT: u32 = 1_000;

/// List the members of a study
///
/// In the order of its design, those on one level: values of the inputs, job and outcome in short.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/members",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("level" = Option<u32>, Query, description = "Level of the cells, 0 the coarsest; 0 if left out"),
        ("from" = Option<u64>, Query, description = "Number of the first member of the page"),
        ("limit" = Option<u32>, Query, description = "Most members of the page", minimum = 1, maximum = 1000),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "A page of members", body = MemberPageDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(in crate::http) async fn list_members(
    State(studies): State<StudyService>,
    caller: Caller,
    NamedStudy(id): NamedStudy,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let from = query.whole("from", 0..=u64::from(u32::MAX)).unwrap_or(0);
    let level = query.whole("level", 0..=u32::MAX).unwrap_or(0);
    let limit = query.whole("limit", 1..=LARGEST_LIMIT);
    let limit = limit.unwrap_or(DEFAULT_LIMIT);
    query.finish()?;
    let stored = readable(&studies, &caller, &id).await?;
    let mut found = studies.members(stored.id, (level, from), limit + 1).await?;
    let next = found.get(limit as usize).map(|member| member.member);
    found.truncate(limit as usize);
    let members = stored.with_ensemble(|ensemble| {
        let members = found.into_iter().map(|member| document(ensemble, member));
        members.collect::<Result<_, _>>()
    });
    let members = members??;
    etag::json(&headers, &MemberPageDocument { members, next })
}

fn document(ensemble: &Ensemble, member: ListedMember) -> Result<MemberDocument, Problem> {
    let values = ensemble.values(member.member);
    let outcome = member.outcome.map(RawValue::from_string).transpose();
    Ok(MemberDocument {
        level: member.level,
        member: member.member,
        values: values.map_err(|error| Problem::internal(&error))?,
        job: member.job.map(|job| job.to_string()),
        status: member.status,
        outcome: outcome.map_err(|error| Problem::internal(&error))?,
    })
}
