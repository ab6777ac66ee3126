//! Trajectories, written to the client while they are read chunk by chunk.

use super::access::Caller;
use super::named_job::{NamedJob, find};
use super::pieces::Pieces;
use super::problem::Problem;
use super::query::Query;
use crate::jobs::store::StoreError;
use crate::jobs::{JobService, TrajectoryRange};
use crate::results::columns::{Selection, Selector, TrajectoryColumns};
use crate::results::table::{Field, Format, Heading, Writer};
use axum::body::Bytes;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use std::collections::BTreeSet;
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
struct TrajectoryQuery {
    body: usize,
    selection: Selection,
    format: Format,
    fields: Vec<Field>,
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
        ("id" = String, Path, description = "Identity of the job"),
        ("body" = Option<u32>, Query, description = "Index of the body in the scenario; 0 unless given"),
        ("from_s" = Option<f64>, Query, description = "First simulated time [s]"),
        ("to_s" = Option<f64>, Query, description = "Last simulated time [s]"),
        ("stride" = Option<u32>, Query, minimum = 1, description = "One sample in how many, counted from the first in the range; 1 unless given"),
        ("format" = Option<String>, Query, description = "json, ndjson, csv or npz; wins over `Accept`"),
        ("fields" = Option<String>, Query, description = "Names of columns, with commas between them; all unless given"),
    ),
    responses(
        (status = 200, description = "The trajectory", content(
            (TrajectorySchema = "application/json"),
            (String = "application/x-ndjson"),
            (String = "text/csv"),
            (Vec<u8> = "application/zip"),
        )),
        (status = 404, description = "There is no such job or body", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "A parameter is not allowed", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn trajectory(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let query = read_query(query.as_deref(), &headers)?;
    let job = find(&jobs, &caller, &id).await?;
    if query.body >= job.bodies {
        return Err(unknown_body(query.body, job.bodies));
    }
    let id = job.summary.id;
    let range = jobs.range(id, query.body, query.selection).await?;
    let rows = match query.format {
        Format::Npz => jobs.count_samples(&range).await?,
        Format::Json | Format::Ndjson | Format::Csv => 0,
    };
    if rows > LARGEST_ARCHIVE {
        return Err(too_large_for_npz(rows));
    }
    let heading = Heading {
        job_id: Some(id.to_string()),
        body: query.body,
        rows,
    };
    let kind = [(header::CONTENT_TYPE, query.format.media_type())];
    let reading = Reading::new(jobs, range, query.format.writer(&heading, query.fields));
    Ok((kind, reading.into_begun_body().await?).into_response())
}

/// Stream of a trajectory to a client: it holds one chunk at a time.
struct Reading {
    jobs: JobService,
    range: TrajectoryRange,
    writer: Box<dyn Writer>,
    pass: usize,
    /// Position in the pass; none before the first pass.
    place: Option<(i64, Selector)>,
}

impl Reading {
    fn new(jobs: JobService, range: TrajectoryRange, writer: Box<dyn Writer>) -> Self {
        Self {
            jobs,
            range,
            writer,
            pass: 0,
            place: None,
        }
    }
}

impl Pieces for Reading {
    const NAME: &'static str = "trajectory";

    async fn piece(&mut self) -> Result<Option<Bytes>, StoreError> {
        let mut out = Vec::new();
        while out.is_empty() && self.pass < self.writer.passes() {
            let (from_sample, mut selector) = match self.place.take() {
                Some(place) => place,
                None => {
                    self.writer.begin(self.pass, &mut out);
                    (0, Selector::new(self.range.selection))
                }
            };
            match self.jobs.next_chunk(&self.range, from_sample).await? {
                Some(chunk) => {
                    let chosen = selector.choose(&chunk.columns);
                    self.writer.rows(self.pass, &chosen, &mut out);
                    self.place = Some((chunk.next_sample, selector));
                }
                None => {
                    self.jobs.check_whole(&self.range).await?;
                    self.writer.end(self.pass, &mut out);
                    self.pass += 1;
                }
            }
        }
        Ok((!out.is_empty()).then_some(out.into()))
    }
}

fn read_query(query: Option<&str>, headers: &HeaderMap) -> Result<TrajectoryQuery, Problem> {
    let mut query = Query::new(query);
    let body = query.whole("body", 0..=u32::MAX).unwrap_or(0);
    let from_s = query.number("from_s", "s");
    let to_s = query.number("to_s", "s");
    let stride = query.whole("stride", 1..=u32::MAX).unwrap_or(1);
    if let (Some(from_s), Some(to_s)) = (from_s, to_s)
        && to_s < from_s
    {
        let rule = format!("x >= from_s = {from_s}");
        query.refuse("to_s", &to_s.to_string(), &rule, Some("s"));
    }
    let format = query.word("format", "json, ndjson, csv or npz", |word| {
        Format::ALL.into_iter().find(|format| format.word() == word)
    });
    let names: Vec<&str> = Field::all().iter().map(|field| field.name()).collect();
    let rule = format!(
        "names with commas between them, each once, of {}",
        names.join(", ")
    );
    let fields = query.word("fields", &rule, |text| {
        let names: Vec<&str> = text.split(',').collect();
        let once = names.iter().collect::<BTreeSet<_>>().len() == names.len();
        let fields = names.into_iter().map(Field::from_name);
        fields.collect::<Option<Vec<_>>>().filter(|_| once)
    });
    query.finish()?;
    Ok(TrajectoryQuery {
        body: body as usize,
        selection: Selection {
            from_s,
            to_s,
            stride: stride as usize,
        },
        format: format.unwrap_or_else(|| accepted(headers)),
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
