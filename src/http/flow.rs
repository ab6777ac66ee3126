//! Snapshots of the flow.

use super::access::Caller;
use super::archive::{Archive, Frames, attachment};
use super::etag;
use super::named_job::{NamedJob, find};
use super::pieces::{PieceError, Pieces, off_the_answering_threads};
use super::problem::Problem;
use super::query::Query;
use crate::jobs::{ExportError, FlowExport, FlowFrames, JobService};
use crate::results::flow::FlowDocument;
use crate::results::frames;
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
    /// Identifier of each kept point: the same material point has the same in all snapshots.
    point_id: Vec<u32>,
    /// Position of each kept point [m].
    position_m: Vec<[f32; 3]>,
    /// Speed of each kept point [m/s].
    speed_m_s: Vec<f32>,
}

/// Get a snapshot of the flow
///
/// The stored snapshot nearest to a time: position and speed of its points, of which the
/// scenario sets the largest number (`flow_snapshot_points`).
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

/// Read snapshots of the flow in binary
///
/// The stored snapshots of a range of time in a compact form for looking, streamed one after the
/// other, each point in ten bytes; what a snapshot holds is set by `flow_snapshots` and
/// `flow_snapshot_points` of the scenario. Little-endian. The stream begins with the bytes
/// `SCREEFLO`, its version (u32, 1) and the number of frames (u32). Each frame has `time_s` (f64),
/// the number of points in the flow (u64), the number of points in the frame n (u32), the thinning
/// factor (u32), origin and extent of the positions (f32 × 3 each) [m], the largest speed (f32)
/// [m/s], four unused bytes, then five columns of n u16: rank, x, y, z, speed; and zeros up to a
/// multiple of eight bytes. Position = origin + extent · x / 65535, speed = largest speed · speed /
/// 65535. Points of the same rank in two frames are the same material point, and ranks ascend.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/flow.bin",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("from_s" = Option<f64>, Query, description = "Only snapshots at this time or later [s]"),
        ("to_s" = Option<f64>, Query, description = "Only snapshots at this time or earlier [s]"),
    ),
    responses(
        (status = 200, description = "The frames so far", body = Frames, content_type = "application/vnd.scree.flow"),
        (status = 404, description = "There is no such job", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn flow_frames(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let (from_s, to_s) = query.time_range();
    query.finish()?;
    let job = find(&jobs, &caller, &id).await?.summary.id;
    let frames = jobs.flow_frames(job, from_s, to_s).await?;
    let stream = FrameStream {
        head: Some(frames::stream_head(frames.remaining()).into()),
        frames,
    };
    let kind = [(header::CONTENT_TYPE, frames::MEDIA_TYPE)];
    Ok((kind, stream.into_begun_body().await?).into_response())
}

/// Body of the stream of frames: it holds one at a time.
struct FrameStream {
    /// Beginning of the stream, until it is sent.
    head: Option<Bytes>,
    frames: FlowFrames,
}

impl Pieces for FrameStream {
    const NAME: &'static str = "frames";
    type Error = PieceError;

    async fn piece(&mut self) -> Result<Option<Bytes>, PieceError> {
        if let Some(head) = self.head.take() {
            return Ok(Some(head));
        }
        let Some(snapshot) = self.frames.next().await? else {
            return Ok(None);
        };
        let frame = off_the_answering_threads(move || frames::frame(&snapshot)).await?;
        Ok(Some(frame.into()))
    }
}

/// Export flow, bodies and ground for ParaView
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
            ExportError::Document(_) | ExportError::Scenario(_) => Self::internal(&error),
        }
    }
}
