//! Snapshots of the flow.

use super::access::Caller;
use super::archive::{Archive, attachment};
use super::etag;
use super::named_job::{NamedJob, find};
use super::pieces::Pieces;
use super::problem::Problem;
use super::query::Query;
use crate::jobs::{ExportError, FlowExport, JobService};
use crate::results::flow::FlowDocument;
use axum::body::Bytes;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use utoipa::ToSchema;

/// The flow at one instant.
#[derive(ToSchema)]
#[expect(
    dead_code,
    reason = "a type of the contract: the document is written by its own code"
)]
#[schema(as = FlowSnapshot)]
struct FlowSchema {
    /// The job.
    #[schema(format = "uuid")]
    job_id: String,
    /// Simulated time [s].
    time_s: f64,
    /// Number of points in the flow at that time.
    points: u64,
    /// Thinning factor: one in this many points is kept.
    thinning: u32,
    /// Position of each kept point [m].
    position_m: Vec<[f32; 3]>,
    /// Speed of each kept point [m/s].
    speed_m_s: Vec<f32>,
}

/// Get a snapshot of the flow
///
/// The stored snapshot nearest to a time: position and speed of at most 5000
/// points.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/flow",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("time_s" = Option<f64>, Query, description = "Simulated time [s]; the latest snapshot unless given"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The snapshot", body = FlowSchema),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such job, or no snapshot yet", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn flow(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let time_s = query.number("time_s", "s");
    query.finish()?;
    let job_id = find(&jobs, &caller, &id).await?.summary.id;
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
    etag::json(&headers, &document)
}

/// Export flow, bodies and channel for ParaView
///
/// A ZIP archive of VTK files in binary: `flow.pvd`, the file to open, and for each snapshot so far
/// an `.vtm` with the blocks `flow` (points with their speed), `bodies` (surfaces of triangles with
/// index, mode, velocity and angular velocity of the body, and the speed of each point) and
/// `channel` (bed and walls, the same at all instants). Between two samples positions are
/// interpolated linearly, orientations by slerp.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/flow.zip",
    tag = "results",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The archive", body = Archive, content_type = "application/zip"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn flow_archive(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
) -> Result<Response, Problem> {
    let job = find(&jobs, &caller, &id).await?;
    let kind = [(header::CONTENT_TYPE, "application/zip")];
    let name = attachment(&format!("{}-flow.zip", job.summary.id));
    let export = jobs.flow_export(job, &caller.share()).await?;
    let body = export.into_begun_body().await?;
    Ok((kind, name, body).into_response())
}

impl Pieces for FlowExport {
    const NAME: &'static str = "archive";
    type Error = ExportError;

    async fn piece(&mut self) -> Result<Option<Bytes>, ExportError> {
        Ok(self.next().await?.map(Bytes::from))
    }
}

impl From<ExportError> for Problem {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Store(error) => error.into(),
            ExportError::Admission(error) => error.into(),
            ExportError::Document(_) => Self::internal(&error),
        }
    }
}
