//! Trajectories, written to the client while they are read chunk by chunk.

use super::access::Caller;
use super::archive::{Archive, attachment};
use super::named_job::{NamedJob, find};
use super::pieces::Pieces;
use super::problem::Problem;
use super::query::Query;
use super::reading::Reading;
use crate::jobs::JobService;
use crate::results::columns::{Selection, TrajectoryColumns};
use crate::results::table::{Field, Format, Heading};
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use utoipa::ToSchema;

/// The trajectory of one body.
#[derive(ToSchema)]
#[expect(
    dead_code,
    reason = "a type of the contract: the document is written by its own code"
)]
#[schema(as = Trajectory)]
struct TrajectorySchema {
    /// The job.
    #[schema(format = "uuid")]
    job_id: String,
    /// Index of the body in the scenario.
    body: u32,
    /// Columns with one entry per sample.
    columns: TrajectoryColumns,
}

/// Samples that fit an archive without ZIP64: 4 GiB of 269 bytes, and headers.
const LARGEST_ARCHIVE: usize = 15_000_000;

/// Requested part of a trajectory.
struct Part {
    body: usize,
    selection: Selection,
    fields: Vec<Field>,
}

/// Part of a trajectory that is asked for.
#[derive(utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "a type of the contract: the query has a reader of its own"
)]
struct PartParameters {
    /// Index of the body in the scenario.
    #[param(default = 0)]
    body: Option<u32>,
    /// First simulated time [s].
    from_s: Option<f64>,
    /// Last simulated time [s].
    to_s: Option<f64>,
    /// One sample in how many, counted from the first in the range.
    #[param(minimum = 1, default = 1)]
    stride: Option<u32>,
    /// Columns, in this order; all unless given.
    #[param(inline, explode = false)]
    fields: Option<Vec<Field>>,
}

/// Read a body's trajectory
///
/// As one JSON document by columns, as NDJSON, CSV or NumPy's NPZ: `format`, or
/// else the first of `Accept` that is one of these. Both ends of the time range
/// are inclusive. The trajectory is empty before the job starts and grows while it runs.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/trajectory",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        PartParameters,
        ("format" = inline(Option<Format>), Query, description = "Format of the answer; wins over `Accept`"),
    ),
    responses(
        (status = 200, description = "The trajectory", content(
            (TrajectorySchema = "application/json"),
            (String = "application/x-ndjson"),
            (String = "text/csv"),
            (Archive = "application/zip"),
        )),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let format = query.choice("format");
    let format = format.unwrap_or_else(|| accepted(&headers));
    answer(jobs, &caller, &id, (query, format)).await
}

/// Read a body's trajectory as CSV
///
/// A line per sample; the components of a vector have columns of their own.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/trajectory.csv",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        PartParameters,
    ),
    responses(
        (status = 200, description = "The trajectory", body = String, content_type = "text/csv"),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory_csv(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let query = Query::new(query.as_deref());
    answer(jobs, &caller, &id, (query, Format::Csv)).await
}

/// Read a body's trajectory as NDJSON
///
/// An object per sample, each on a line of its own.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/trajectory.ndjson",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        PartParameters,
    ),
    responses(
        (status = 200, description = "The trajectory", body = String, content_type = "application/x-ndjson"),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory_ndjson(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let query = Query::new(query.as_deref());
    answer(jobs, &caller, &id, (query, Format::Ndjson)).await
}

/// Read a body's trajectory as NumPy arrays
///
/// A ZIP archive of one array per column, for `numpy.load`.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/trajectory.npz",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        PartParameters,
    ),
    responses(
        (status = 200, description = "The trajectory", body = Archive, content_type = "application/zip"),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory_npz(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let query = Query::new(query.as_deref());
    answer(jobs, &caller, &id, (query, Format::Npz)).await
}

/// The part of a trajectory that a query asks for, in this format.
async fn answer(
    jobs: JobService,
    caller: &Caller,
    id: &str,
    (query, format): (Query, Format),
) -> Result<Response, Problem> {
    let part = read_part(query)?;
    let job = find(&jobs, caller, id).await?;
    if part.body >= job.bodies {
        return Err(unknown_body(part.body, job.bodies));
    }
    let id = job.summary.id;
    let range = jobs.range(id, part.body, part.selection).await?;
    let rows = match format {
        Format::Npz => jobs.count_samples(&range).await?,
        Format::Json | Format::Ndjson | Format::Csv => 0,
    };
    if rows > LARGEST_ARCHIVE {
        return Err(too_large_for_npz(rows));
    }
    let heading = Heading {
        job_id: Some(id.to_string()),
        body: part.body,
        rows,
    };
    let name = match format {
        // A document is looked at, the others are kept.
        Format::Json => None,
        _ => Some(format!("{id}-trajectory-{}.{}", part.body, format.word())),
    };
    let kind = [(header::CONTENT_TYPE, format.media_type())];
    let reading = Reading::new(jobs, range, format.writer(&heading, part.fields));
    let body = reading.into_begun_body().await?;
    Ok((kind, name.as_deref().map(attachment), body).into_response())
}

fn read_part(mut query: Query) -> Result<Part, Problem> {
    let body = query.whole("body", 0..=u32::MAX).unwrap_or(0);
    let (from_s, to_s) = query.time_range();
    let stride = query.whole("stride", 1..=u32::MAX).unwrap_or(1);
    let fields = query.choices("fields");
    query.finish()?;
    Ok(Part {
        body: body as usize,
        selection: Selection {
            from_s,
            to_s,
            stride: stride as usize,
        },
        fields: fields.unwrap_or_else(Field::all),
    })
}

/// The first format that `Accept` names; JSON if it names none.
fn accepted(headers: &HeaderMap) -> Format {
    let lists = headers.get_all(header::ACCEPT).into_iter();
    let lists = lists.filter_map(|list| list.to_str().ok());
    let mut kinds = lists.flat_map(|list| list.split(','));
    let of_kind = |kind: &str| {
        let essence = kind.split(';').next().unwrap_or_default().trim();
        Format::ALL
            .into_iter()
            .find(|format| format.media_type().eq_ignore_ascii_case(essence))
    };
    kinds.find_map(of_kind).unwrap_or(Format::Json)
}

fn too_large_for_npz(rows: usize) -> Problem {
    let mut query = Query::new(None);
    let rule = format!(
        "json, ndjson or csv for {rows} samples; npz with a stride or a range that leaves at most {LARGEST_ARCHIVE}"
    );
    query.refuse("format", "npz", &rule, None);
    match query.finish() {
        Err(problem) => problem,
        Ok(()) => Problem::internal("a refusal was lost"),
    }
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
