//! Snapshots of the flow.

use super::access::Caller;
use super::archive::{Archive, attachment};
use super::etag;
use super::named_job::{NamedJob, find};
use super::pieces::Pieces;
use super::problem::Problem;
use super::query::Query;
use crate::jobs::JobService;
use crate::jobs::job::JobId;
use crate::jobs::store::StoreError;
use crate::results::flow::FlowDocument;
use crate::results::vtk;
use crate::results::zip::ZipWriter;
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

/// Export the snapshots of the flow for ParaView
///
/// A ZIP archive of all snapshots so far: `flow.pvd`, the file to open, and one `.vtp`
/// file per snapshot.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/flow.zip",
    tag = "results",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The archive", body = Archive, content_type = "application/zip"),
    )
)]
pub(super) async fn flow_archive(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
) -> Result<Response, Problem> {
    let job = find(&jobs, &caller, &id).await?.summary.id;
    let times_s = jobs.snapshot_times(job).await?;
    let mut archive = ZipWriter::default();
    let mut head = Vec::new();
    archive.begin("flow.pvd", &mut head);
    archive.data(vtk::pvd(&times_s).as_bytes(), &mut head);
    archive.end(&mut head);
    let packing = Packing {
        jobs,
        job,
        times_s,
        next: 0,
        archive,
        head,
    };
    let kind = [(header::CONTENT_TYPE, "application/zip")];
    let name = attachment(&format!("{job}-flow.zip"));
    let body = packing.into_begun_body().await?;
    Ok((kind, name, body).into_response())
}

/// Stream of snapshots to a client: it holds one of them at a time.
struct Packing {
    jobs: JobService,
    job: JobId,
    times_s: Vec<f64>,
    next: usize,
    archive: ZipWriter,
    /// The file that names the others, until it is sent.
    head: Vec<u8>,
}

impl Pieces for Packing {
    const NAME: &'static str = "archive";

    /// The next file, or the archive's end.
    async fn piece(&mut self) -> Result<Option<Bytes>, StoreError> {
        let mut out = std::mem::take(&mut self.head);
        let place = self.next;
        self.next += 1;
        if place > self.times_s.len() {
            return Ok(None);
        }
        let Some(&time_s) = self.times_s.get(place) else {
            std::mem::take(&mut self.archive).finish(&mut out);
            return Ok(Some(out.into()));
        };
        let snapshot = self.jobs.snapshot(self.job, Some(time_s)).await?;
        let snapshot = snapshot.ok_or_else(|| StoreError::Row {
            job: self.job.to_string(),
            what: "a snapshot that was there before",
        })?;
        self.archive.begin(&vtk::file_name(place), &mut out);
        self.archive.data(vtk::vtp(&snapshot).as_bytes(), &mut out);
        self.archive.end(&mut out);
        Ok(Some(out.into()))
    }
}
