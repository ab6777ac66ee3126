//! Terrains and their files, read.

use super::documents::{RasterFile, TerrainDocument, TerrainPageDocument};
use super::named::{NamedTerrain, named};
use crate::http::archive::attachment;
use crate::http::etag;
use crate::http::paging::{PagedList, cut_to_page, read_limit};
use crate::http::pieces::Pieces;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::jobs::store::{StoreError, TerrainPage};
use crate::terrains::{TerrainFile, TerrainService};
use axum::body::Bytes;
use axum::extract::{RawQuery, State};
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};

/// List terrains, newest first
///
/// A page at a time: `next_cursor` of one is the `cursor` of the next.
#[utoipa::path(
    get,
    path = "/v1/terrains",
    tag = "terrains",
    params(
        ("limit" = Option<u32>, Query, description = "Most terrains of the page", minimum = 1, maximum = 100),
        ("cursor" = Option<String>, Query, description = "`next_cursor` of the page before"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "A page of terrains", body = TerrainPageDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
    )
)]
pub(in crate::http) async fn list_terrains(
    State(terrains): State<TerrainService>,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let before = PagedList::TERRAINS.read_cursor(&mut query);
    let limit = read_limit(&mut query);
    query.finish()?;
    let page = TerrainPage {
        before,
        limit: limit + 1,
    };
    let mut found = terrains.terrains(&page).await?;
    let next_cursor = cut_to_page(&mut found, limit)
        .map(|terrain| PagedList::TERRAINS.cursor(terrain.stored.sequence));
    let document = TerrainPageDocument {
        next_cursor,
        terrains: found.into_iter().map(TerrainDocument::from).collect(),
    };
    etag::json(&headers, &document)
}

/// Get a terrain
///
/// Document of a terrain; the file itself is under `/file`.
#[utoipa::path(
    get,
    path = "/v1/terrains/{hash}",
    tag = "terrains",
    params(
        ("hash" = String, Path, description = "Name of the terrain"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The terrain", body = TerrainDocument),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such terrain", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn show_terrain(
    State(terrains): State<TerrainService>,
    NamedTerrain(hash): NamedTerrain,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let terrain = named(&terrains, &hash).await?;
    etag::json(&headers, &TerrainDocument::from(terrain))
}

/// Get the file of a terrain
///
/// Byte for byte as it was uploaded. It is read piece by piece; should the stored file be damaged,
/// the answer breaks off before its end.
#[utoipa::path(
    get,
    path = "/v1/terrains/{hash}/file",
    tag = "terrains",
    params(
        ("hash" = String, Path, description = "Name of the terrain"),
        ("If-None-Match" = Option<String>, Header, description = "The `ETag` of an answer that is there already"),
    ),
    responses(
        (status = 200, description = "The file", content((RasterFile = "image/tiff"), (RasterFile = "text/plain")),
         headers(("Content-Disposition" = String, description = "Name of the file in which the answer is kept"))),
        (status = 304, description = "It is what `If-None-Match` names"),
        (status = 404, description = "There is no such terrain", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn terrain_file(
    State(terrains): State<TerrainService>,
    NamedTerrain(hash): NamedTerrain,
    headers: HeaderMap,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let terrain = named(&terrains, &hash).await?;
    let tag = etag::Tag::of(hash.as_bytes());
    if let Some(unchanged) = tag.unchanged(&headers) {
        return Ok(unchanged);
    }
    let format = terrain.description.format;
    let described = [
        (header::CONTENT_TYPE, format.media_type().to_owned()),
        (header::CONTENT_LENGTH, terrain.stored.bytes.to_string()),
    ];
    let name = format!("terrain-{}.{}", &hash[..8], format.ending());
    let body = terrains.file(&terrain).into_begun_body().await?;
    Ok((tag.header(), described, attachment(&name), body).into_response())
}

impl Pieces for TerrainFile {
    const NAME: &'static str = "terrain";
    type Error = StoreError;

    async fn piece(&mut self) -> Result<Option<Bytes>, StoreError> {
        let piece = self.next_piece().await?;
        Ok(piece.map(Bytes::from))
    }
}
