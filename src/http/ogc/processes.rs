//! The list of processes, and the description of one.

use super::super::problem::Problem;
use super::super::query::Query;
use super::exceptions::no_such_process;
use super::links::{Base, Link};
use super::process::{self, DescriptionDocument, Process, SummaryDocument};
use crate::jobs::submit::excerpt;
use axum::extract::{FromRequestParts, Path, RawQuery};
use axum::http::request::Parts;
use axum::{Extension, Json};
use serde::Serialize;
use utoipa::ToSchema;

/// Largest number of processes in a list.
const LARGEST_LIMIT: u32 = 100;

/// The processes.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ProcessList)]
pub(super) struct ProcessListDocument {
    /// Each in short.
    processes: Vec<SummaryDocument>,
    /// Link to this list.
    links: Vec<Link>,
}

/// List the processes
///
/// There is one.
#[utoipa::path(
    get,
    path = "/ogc/processes",
    tag = super::TAG,
    params(("limit" = Option<u32>, Query, minimum = 1, maximum = 100, description = "Most processes of the list; there is one")),
    responses((status = 200, description = "The processes", body = ProcessListDocument)),
)]
pub(super) async fn process_list(
    base: Base,
    RawQuery(query): RawQuery,
) -> Result<Json<ProcessListDocument>, Problem> {
    let mut query = Query::new(query.as_deref());
    query.whole("limit", 1..=LARGEST_LIMIT);
    query.finish()?;
    Ok(Json(ProcessListDocument {
        processes: vec![process::summary(&base)],
        links: vec![base.json("/ogc/processes", "self", "This list")],
    }))
}

/// Describe a process
///
/// Input and outcome have the schemas of this contract, in OpenAPI 3.0 and without references, as
/// the standard asks.
#[utoipa::path(
    get,
    path = "/ogc/processes/{process}",
    tag = super::TAG,
    params(("process" = String, Path, description = "Name of the process, which is `simulation`")),
    responses(
        (status = 200, description = "The description", body = DescriptionDocument),
        (status = 404, description = "There is no such process", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn process_description(
    base: Base,
    Extension(process): Extension<Process>,
    _: NamedProcess,
) -> Json<DescriptionDocument> {
    Json(process.description(&base))
}

/// The process that a path names; there is one.
pub(super) struct NamedProcess;

impl<S: Send + Sync> FromRequestParts<S> for NamedProcess {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let path = Path::from_request_parts(parts, state).await;
        let name = path.map_or_else(|_| String::new(), |Path(name): Path<String>| name);
        if name == process::ID {
            return Ok(Self);
        }
        let detail = format!(
            "there is no process \"{}\": the only one is \"{}\"",
            excerpt(&name),
            process::ID
        );
        Err(no_such_process(detail))
    }
}
