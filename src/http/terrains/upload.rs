//! Upload of a terrain. Its file is in memory until it is stored, so only a few come at a time.

use super::documents::{RasterFile, TerrainDocument};
use crate::http::access::Caller;
use crate::http::field_errors::{FieldError, FieldErrors};
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::http::scenario_body::{check_encoding, essence, too_large, too_slow, unsupported};
use crate::quota::UsedUp;
use crate::terrains::{FilePurpose, PutError, TerrainService};
use axum::Json;
use axum::body::Body;
use axum::extract::{RawQuery, Request, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::StreamExt;
use hyper::body::Body as _;
use tokio::time::timeout;

/// Media types of a file; which format it has is seen from its first bytes.
const MEDIA_TYPES: [&str; 3] = ["image/tiff", "text/plain", "application/octet-stream"];

/// Upload a terrain
///
/// The body is the file, a GeoTIFF or an ESRI ASCII grid. The terrain is named by the SHA-256 of the
/// file: who uploads it again gets the same document, and status 200. It is on disk when the answer
/// is sent.
#[utoipa::path(
    post,
    path = "/v1/terrains",
    tag = "terrains",
    params(
        ("purpose" = inline(Option<FilePurpose>), Query, description = "What the values are, and so which are possible; `height-map` if it is left out"),
    ),
    request_body(
        description = "The file",
        content((RasterFile = "image/tiff"), (RasterFile = "application/octet-stream"), (RasterFile = "text/plain")),
    ),
    responses(
        (status = 200, description = "The terrain, which was there already", body = TerrainDocument,
         headers(("Location" = String, description = "Where the terrain is"))),
        (status = 201, description = "The terrain", body = TerrainDocument,
         headers(("Location" = String, description = "Where the terrain is"))),
        (status = 408, description = "The file took too long", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The file is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as a file of these kinds", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The file is no raster for its purpose (`errors` has the cell and its value), or a parameter is not allowed", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many files are being uploaded, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn upload_terrain(
    State(terrains): State<TerrainService>,
    caller: Caller,
    RawQuery(query): RawQuery,
    request: Request,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let purpose: FilePurpose = query.choice("purpose").unwrap_or_default();
    query.finish()?;
    check_media_type(request.headers())?;
    let place = terrains
        .begin_upload(&caller.share())
        .map_err(|used_up| too_many(&used_up))?;
    let file = arrived(&terrains, request.into_body()).await?;
    let put = terrains.put(file, purpose, (caller.name(), &place));
    let (terrain, is_new) = put.await?;
    let status = match is_new {
        true => StatusCode::CREATED,
        false => StatusCode::OK,
    };
    let location = format!("/v1/terrains/{}", terrain.stored.hash);
    let document = Json(TerrainDocument::from(terrain));
    Ok((status, [(header::LOCATION, location)], document).into_response())
}

/// Checks that the body is declared as a file, uncompressed.
fn check_media_type(headers: &HeaderMap) -> Result<(), Problem> {
    if MEDIA_TYPES.contains(&essence(headers).as_str()) {
        return check_encoding(headers);
    }
    Err(unsupported(
        "a terrain is sent as Content-Type: image/tiff, text/plain or application/octet-stream",
    ))
}

/// The file, once it is here. It is refused as soon as it is known to be too large: an announced
/// length before the file is asked for (100 Continue).
async fn arrived(terrains: &TerrainService, body: Body) -> Result<Vec<u8>, Problem> {
    let most = terrains.most_bytes();
    let refused = || too_large("limits.terrain_file_bytes", most);
    let announced = usize::try_from(body.size_hint().lower());
    let announced = announced.ok().filter(|&bytes| bytes <= most);
    let mut file = Vec::with_capacity(announced.ok_or_else(refused)?);
    let mut pieces = body.into_data_stream();
    let arriving = async {
        while let Some(piece) = pieces.next().await {
            let piece = piece.map_err(|error| broken_off(&error))?;
            if file.len() + piece.len() > most {
                return Err(refused());
            }
            file.extend_from_slice(&piece);
        }
        Ok(file)
    };
    timeout(terrains.upload_time(), arriving)
        .await
        .map_err(|_| too_slow("limits.terrain_read_timeout_s"))?
}

fn broken_off(error: &axum::Error) -> Problem {
    Problem::new(
        StatusCode::BAD_REQUEST,
        "incomplete-body",
        "Incomplete body",
        format!("the body broke off: {error}"),
    )
}

fn too_many(used_up: &UsedUp) -> Problem {
    let (kind, detail) = match used_up {
        UsedUp::ByAll(uploads) => (
            "uploads-full",
            format!(
                "{uploads} terrains are being uploaded, as many as limits.terrain_uploads of this \
                 service allows"
            ),
        ),
        UsedUp::ByCaller(uploads) => (
            "uploads-spent",
            format!(
                "{uploads} terrains of this caller are being uploaded, half of \
                 limits.terrain_uploads of this service"
            ),
        ),
    };
    Problem::busy(kind, "Too many uploads", &detail)
}

impl From<PutError> for Problem {
    fn from(error: PutError) -> Self {
        match error {
            PutError::Invalid(violation) => invalid_terrain(FieldError::from(violation).into()),
            PutError::Admission(error) => error.into(),
            PutError::Store(error) => error.into(),
        }
    }
}

/// A file that is no raster for its purpose.
fn invalid_terrain(faults: FieldErrors) -> Problem {
    let status = StatusCode::UNPROCESSABLE_ENTITY;
    let detail = faults.summary();
    Problem {
        errors: faults.into_list(),
        ..Problem::new(status, "invalid-terrain", "Invalid terrain", detail)
    }
}
