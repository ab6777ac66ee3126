//! Answers of a study as files: tables, maps, pictures.

use super::asked::AskedStudy;
use crate::http::archive::{Archive, Svg, attachment};
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::studies::export::{self, ExportError};
use axum::extract::RawQuery;
use axum::http::header;
use axum::response::{IntoResponse, Response};

impl From<ExportError> for Problem {
    fn from(error: ExportError) -> Self {
        Self::internal(&error)
    }
}

/// Question about a resting place that is asked for.
#[derive(utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "a type of the contract: the query has a reader of its own"
)]
struct QuestionParameter {
    /// Place of the question in the study; the first about a resting place if left out
    question: Option<u32>,
}

/// Value of `question`.
fn question(query: Option<&str>) -> Result<Option<usize>, Problem> {
    let mut query = Query::new(query);
    let question = query.whole("question", 0..=usize::from(u16::MAX));
    query.finish()?;
    Ok(question)
}

fn file(contents: Vec<u8>, (kind, name): (&'static str, &str)) -> Response {
    let kind = [(header::CONTENT_TYPE, kind)];
    (kind, attachment(name), contents).into_response()
}

fn picture(contents: Vec<u8>) -> Response {
    ([(header::CONTENT_TYPE, "image/svg+xml")], contents).into_response()
}

/// Get the members of a study as CSV
///
/// A row for each member that has ended: its inputs, the reason of its failure, and the quantities
/// of its outcome, those of bodies as `body0.displacement_m`. Empty: it did not happen.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/members.csv",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The table", body = String, content_type = "text/csv"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_members_csv(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let name = format!("study-{}.csv", asked.id());
    let made = asked.make(|outcomes| Ok(export::members_as_csv(&outcomes.table()).into()));
    Ok(file(made.await?, ("text/csv; charset=utf-8", &name)))
}

/// Get the members of a study as NPZ
///
/// The numbers of the table, an array of 64-bit floats for each column; NaN where there is none.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/members.npz",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The arrays", body = Archive, content_type = "application/zip"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_members_npz(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let name = format!("study-{}.npz", asked.id());
    let made = asked.make(|outcomes| Ok(export::members_as_npz(&outcomes.table())));
    Ok(file(made.await?, ("application/zip", &name)))
}

/// Get the regions of resting places as GeoJSON
///
/// In local coordinates in metres: x downstream and y across in a channel, x east and y north of the
/// south-western corner of the height map on a terrain.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.geojson",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        QuestionParameter,
    ),
    responses(
        (status = 200, description = "The regions", body = serde_json::Value, content_type = "application/geo+json"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_rest_geojson(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |outcomes| {
        let (_, rest) = outcomes.rest(place)?;
        Ok(export::rest_as_geojson(&rest).to_string())
    });
    let kind = [(header::CONTENT_TYPE, "application/geo+json")];
    Ok((kind, made.await?).into_response())
}

/// Get the density of resting places as GeoTIFF
///
/// One band of 32-bit floats [1/m²], in local coordinates: x downstream and y across in a
/// channel, x east and y north of the height map's corner on a terrain.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.tif",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        QuestionParameter,
    ),
    responses(
        (status = 200, description = "The image", body = Archive, content_type = "image/tiff"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_rest_tiff(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let name = format!("study-{}.tif", asked.id());
    let made = asked.make(move |outcomes| {
        let (_, rest) = outcomes.rest(place)?;
        let too_few = || Problem::not_found("no-answer", "too few members have come to rest");
        let density = rest.density.as_ref().ok_or_else(too_few)?;
        Ok(export::density_as_geotiff(density).map_err(ExportError::from)?)
    });
    Ok(file(made.await?, ("image/tiff", &name)))
}

/// Draw where a body comes to rest
///
/// Regions, resting places of the members, and the place at the start, seen from above.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.svg",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        QuestionParameter,
    ),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_rest(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |outcomes| {
        let (place, rest) = outcomes.rest(place)?;
        let map = export::map(outcomes.ensemble, &outcomes.members, (place, &rest));
        Ok(map.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}

/// Draw what a quantity depends on
///
/// A bar with its uncertainty for each input, the largest on top.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/sensitivity.svg",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("question" = Option<u32>, Query, description = "Place of the question in the study; the first about a sensitivity if left out"),
    ),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_sensitivity(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |outcomes| {
        let (place, measures) = outcomes.sensitivity(place)?;
        let tornado = export::tornado(outcomes.ensemble.study(), (place, &measures));
        Ok(tornado.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}

/// Draw quantities of the members against their inputs
///
/// Run-out, and displacement, resting place across and peak speed of the first body.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/scatter.svg",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_scatter(
    asked: AskedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let made = asked.make(|outcomes| {
        let drawn = export::scatter(outcomes.ensemble, &outcomes.members);
        Ok(drawn.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}
