//! Pictures of a job's answer.

use super::access::Caller;
use super::archive::Svg;
use super::named_job::{NamedJob, find};
use super::problem::Problem;
use super::query::Query;
use super::shares::StreamRight;
use crate::jobs::{DrawError, JobService, Picture};
use axum::extract::{RawQuery, State};
use axum::http::header;
use axum::response::{IntoResponse, Response};

/// Draw the motion of the bodies
///
/// Displacement and speed of each free body, and the share of its height in the flow, over time,
/// with onset, peak and rest.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/motion.svg",
    tag = "results",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such job, or it has no outcome", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "There are no parameters", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn motion(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    right: StreamRight,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    draw(&jobs, &caller, (&id, Picture::Motion), &right).await
}

/// Draw flow and bodies from above
///
/// In a channel at about six instants: the flow's surface by speed, outline and trail of each body,
/// and the channel. On a terrain its hillshade, the largest flow height, outlines of releases and
/// deposit, and the bodies at the end with their tracks.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/aerial.svg",
    tag = "results",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such job, or it has no outcome", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "There are no parameters", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn aerial(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    right: StreamRight,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    draw(&jobs, &caller, (&id, Picture::Aerial), &right).await
}

/// Reads the records in the request's turn, and draws them in the admission pool.
async fn draw(
    jobs: &JobService,
    caller: &Caller,
    (id, picture): (&str, Picture),
    right: &StreamRight,
) -> Result<Response, Problem> {
    let job = find(jobs, caller, id).await?;
    // Taken before: no more records are in memory than there are places.
    let place = jobs.enter(&caller.share())?;
    let drawing = jobs.drawing(job, picture).await?;
    right.end_turn();
    let drawer = jobs.clone();
    let drawn = place.work(move |_| drawing.draw(&drawer)).await??;
    Ok(([(header::CONTENT_TYPE, "image/svg+xml")], drawn).into_response())
}

impl From<DrawError> for Problem {
    fn from(error: DrawError) -> Self {
        match error {
            DrawError::NoOutcome => Self::not_found("no-picture", error.to_string()),
            DrawError::Store(error) => error.into(),
            DrawError::Document(_)
            | DrawError::Scenario(_)
            | DrawError::Picture(_)
            | DrawError::Map(_) => Self::internal(&error),
        }
    }
}
