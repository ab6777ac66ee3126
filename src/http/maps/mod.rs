//! Results of a job on a terrain for geographic programs.

mod documents;

use super::access::Caller;
use super::archive::attachment;
use super::etag::{self, Tag};
use super::named_job::{NamedJob, find};
use super::pieces::off_the_answering_threads;
use super::problem::Problem;
use super::query::Query;
use super::shares::StreamRight;
use crate::jobs::submit::excerpt;
use crate::jobs::{AskedCoordinates, JobService, TerrainResultsError};
use crate::results::terrain::{MapQuantity, StoredMap};
use axum::extract::{FromRequestParts, Path, RawQuery, State};
use axum::http::request::Parts;
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use documents::{MapDocument, MapFile, MapLinks, MapListDocument};

/// Format of a map's file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum MapFormat {
    GeoTiff,
    Ascii,
}

/// The `{id}` and the `{file}` of a path, as received.
pub(super) struct NamedFile {
    job: String,
    file: String,
}

impl<S: Send + Sync> FromRequestParts<S> for NamedFile {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Path::from_request_parts(parts, state)
            .await
            .map(|Path((job, file))| Self { job, file })
            .map_err(|_| unknown_file(parts.uri.path()))
    }
}

fn unknown_file(file: &str) -> Problem {
    let names: Vec<_> = MapQuantity::ALL
        .iter()
        .map(|quantity| quantity.name())
        .collect();
    let detail = format!(
        "{} is no map: there are {}, each with .tif or .asc",
        excerpt(file),
        names.join(", ")
    );
    Problem::not_found("unknown-map", detail)
}

/// List the maps of a job's flow
///
/// Maps of a job on a terrain, once it has succeeded: largest flow height, largest speed, arrival time,
/// and deposit, the flow height at the end.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/maps",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The maps", body = MapListDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such job, or it has no terrain", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn list_maps(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let job = find(&jobs, &caller, &id).await?;
    let quantities = jobs.flow_maps(&job).await?;
    let job_id = job.summary.id.to_string();
    let link = |name: &str, ending: &str| format!("/v1/jobs/{job_id}/maps/{name}.{ending}");
    let map = |quantity: MapQuantity| MapDocument {
        name: quantity.name(),
        unit: quantity.unit(),
        links: MapLinks {
            geotiff: link(quantity.name(), "tif"),
            ascii: link(quantity.name(), "asc"),
        },
    };
    let document = MapListDocument {
        maps: quantities.into_iter().map(map).collect(),
        job_id: job_id.clone(),
    };
    etag::json(&headers, &document)
}

/// Get a map of a job's flow
///
/// In the coordinates of the job's height map. `flow_height_max.tif` is the largest flow height [m],
/// `flow_speed_max.tif` the largest magnitude of the depth-averaged velocity [m/s],
/// `arrival_time.tif` the first time at which the flow is as high as half the distance of its points
/// [s], `deposit.tif` the flow height at the end [m]; with `.asc` they are ESRI ASCII grids, which
/// name no coordinate reference system. Where no flow ever was there is no value.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/maps/{file}",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("file" = String, Path, description = "Name of the map, with `.tif` or `.asc`"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The map", content((MapFile = "image/tiff"), (MapFile = "text/plain")),
         headers(("Content-Disposition" = String, description = "Name of the file in which the answer is kept"))),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such job or map, or the job has no terrain", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn map_file(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedFile { job: id, file }: NamedFile,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let job = find(&jobs, &caller, &id).await?;
    let (quantity, format) = read_name(&file).ok_or_else(|| unknown_file(&file))?;
    let map = jobs.flow_map(&job, quantity).await?;
    let map = map.ok_or_else(|| {
        let detail = format!("job {id} has no map {file}: it has not succeeded, or has no flow");
        Problem::not_found("no-map", detail)
    })?;
    let tag = Tag::of(&[&map.file.checksum[..], file.as_bytes()].concat());
    if let Some(unchanged) = tag.unchanged(&headers) {
        return Ok(unchanged);
    }
    let (media_type, body) = off_the_answering_threads(move || written(map, format))
        .await
        .map_err(|error| Problem::internal(&error))??;
    let kind = [(header::CONTENT_TYPE, media_type)];
    let name = attachment(&format!("{}-{file}", job.summary.id));
    Ok(etag::varied(
        (tag.header(), kind, name, body).into_response(),
    ))
}

fn read_name(file: &str) -> Option<(MapQuantity, MapFormat)> {
    let (name, ending) = file.split_once('.')?;
    let format = match ending {
        "tif" => MapFormat::GeoTiff,
        "asc" => MapFormat::Ascii,
        _ => return None,
    };
    Some((MapQuantity::named(name)?, format))
}

fn written(
    map: StoredMap,
    format: MapFormat,
) -> Result<(&'static str, Vec<u8>), TerrainResultsError> {
    Ok(match format {
        MapFormat::GeoTiff => ("image/tiff", map.geotiff()?),
        MapFormat::Ascii => ("text/plain", map.ascii()?.into_bytes()),
    })
}

/// Get tracks and outlines of a job on a terrain
///
/// A GeoJSON feature collection (RFC 7946). `kind` in the properties of a feature is `release` (with
/// `release`, its index, `time_s` and `thickness_m`), `inundated_area`, `deposit`, `track` (the way of
/// a body's centre; with `body`, its index, `times_s` and `elevations_m` of the positions) or
/// `final_position` (with `body`, `time_s`, `elevation_m`, `peak_speed_m_s`, `stop_time_s`,
/// `displacement_m` and `burial_depth_m`).
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/tracks.geojson",
    tag = "results",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the job"),
        ("coordinates" = Option<String>, Query, description = "`wgs84`: longitude and latitude, for a height map that names its coordinate reference system; `map`: easting and northing of the height map, which the member `crs` names; `wgs84` if it is left out"),
    ),
    responses(
        (status = 200, description = "The features", body = serde_json::Value, content_type = "application/geo+json"),
        (status = 404, description = "There is no such job, it has no terrain or no outcome, or its height map has no longitudes and latitudes", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "There are no such coordinates", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn tracks(
    State(jobs): State<JobService>,
    caller: Caller,
    NamedJob(id): NamedJob,
    right: StreamRight,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let asked = query.word("coordinates", "wgs84 or map", |word| match word {
        "wgs84" => Some(AskedCoordinates::Wgs84),
        "map" => Some(AskedCoordinates::Map),
        _ => None,
    });
    query.finish()?;
    let job = find(&jobs, &caller, &id).await?;
    // Taken before: no more records are in memory than there are places.
    let place = jobs.enter(&caller.share())?;
    let tracks = jobs.tracks(job).await?;
    right.end_turn();
    let asked = asked.unwrap_or(AskedCoordinates::Wgs84);
    let made = place.work(move |_| tracks.geojson(&jobs, asked)).await??;
    let kind = [(header::CONTENT_TYPE, "application/geo+json")];
    Ok((kind, made).into_response())
}

impl From<TerrainResultsError> for Problem {
    fn from(error: TerrainResultsError) -> Self {
        match error {
            TerrainResultsError::NoTerrain => Self::not_found("no-terrain", error.to_string()),
            TerrainResultsError::NoOutcome => Self::not_found("no-tracks", error.to_string()),
            TerrainResultsError::Coordinates(error) => {
                Self::not_found("no-longitudes", error.to_string())
            }
            TerrainResultsError::Store(error) => error.into(),
            TerrainResultsError::Scenario(_)
            | TerrainResultsError::Map(_)
            | TerrainResultsError::Document(_) => Self::internal(&error),
        }
    }
}
