//! Results: trajectories and snapshots of the flow.

use super::contract::{FlowSchema, TrajectorySchema};
use super::jobs::find;
use super::named_job::NamedJob;
use super::problem::Problem;
use super::query::Query;
use super::tagged;
use crate::jobs::Jobs;
use crate::results::columns::Selection;
use crate::results::flow::FlowDocument;
use crate::results::json::TrajectoryPieces;
use axum::body::{Body, Bytes};
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use futures_util::stream;

/// Read a body's trajectory
///
/// Both ends of the time range are inclusive. The columns are empty before the
/// job starts and grow while it runs.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/trajectory",
    tag = "results",
    params(
        ("id" = String, Path, description = "Identity of the job"),
        ("body" = Option<u32>, Query, description = "Index of the body in the scenario; 0 unless given"),
        ("from_s" = Option<f64>, Query, description = "First simulated time [s]"),
        ("to_s" = Option<f64>, Query, description = "Last simulated time [s]"),
        ("stride" = Option<u32>, Query, minimum = 1, description = "One sample in how many, counted from the first in the range; 1 unless given"),
    ),
    responses(
        (status = 200, description = "The trajectory", body = TrajectorySchema),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "A parameter is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory(
    State(jobs): State<Jobs>,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let (body, selection) = read_selection(query.as_deref())?;
    let job = find(&jobs, &id).await?;
    if body >= job.bodies {
        return Err(unknown_body(body, job.bodies));
    }
    let job_id = job.summary.id;
    let columns = jobs.trajectory(job_id, body, selection).await?;
    let pieces = TrajectoryPieces::new(Some(&job_id.to_string()), body, columns);
    let body = Body::from_stream(stream::iter(pieces.map(|piece| piece.map(Bytes::from))));
    Ok(([(header::CONTENT_TYPE, "application/json")], body).into_response())
}

/// Look at the flow
///
/// The stored snapshot nearest to a time: position and speed of at most 5000
/// points.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/flow",
    tag = "results",
    params(
        ("id" = String, Path, description = "Identity of the job"),
        ("time_s" = Option<f64>, Query, description = "Simulated time [s]; the latest snapshot unless given"),
    ),
    responses(
        (status = 200, description = "The snapshot", body = FlowSchema),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such job, or no snapshot yet", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "A parameter is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn flow(
    State(jobs): State<Jobs>,
    NamedJob(id): NamedJob,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let time_s = query.number("time_s", "s");
    query.finish()?;
    let job_id = find(&jobs, &id).await?.summary.id;
    let snapshot = jobs.snapshot(job_id, time_s).await?;
    let snapshot = snapshot.ok_or_else(|| {
        Problem::not_found(
            "no-snapshot",
            format!("job {id} has no snapshot of the flow yet"),
        )
    })?;
    let document = FlowDocument {
        job_id: Some(job_id.to_string()),
        snapshot,
    };
    tagged::json(&headers, &document)
}

fn read_selection(query: Option<&str>) -> Result<(usize, Selection), Problem> {
    let mut query = Query::new(query);
    let body = query.whole("body", 0..=u32::MAX).unwrap_or(0);
    let from_s = query.number("from_s", "s");
    let to_s = query.number("to_s", "s");
    let stride = query.whole("stride", 1..=u32::MAX).unwrap_or(1);
    if let (Some(from_s), Some(to_s)) = (from_s, to_s)
        && to_s < from_s
    {
        query.refuse(
            "to_s",
            &to_s.to_string(),
            &format!("x >= from_s = {from_s}"),
            Some("s"),
        );
    }
    query.finish()?;
    Ok((
        body as usize,
        Selection {
            from_s,
            to_s,
            stride: stride as usize,
        },
    ))
}

fn unknown_body(body: usize, bodies: usize) -> Problem {
    let detail = match bodies {
        0 => format!("there is no body {body}: the scenario has none"),
        1 => format!("there is no body {body}: the scenario has one, body 0"),
        _ => format!(
            "there is no body {body}: the scenario has 0 to {}",
            bodies - 1
        ),
    };
    Problem::not_found("unknown-body", detail)
}
