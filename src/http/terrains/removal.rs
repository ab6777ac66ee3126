//! Removal of terrains.

use super::named::{NamedTerrain, named, unknown_terrain};
use crate::http::access::Caller;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::jobs::store::TerrainRemoval;
use crate::terrains::TerrainService;
use axum::extract::{RawQuery, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

/// Remove a terrain
///
/// Refused as long as there is a job or a study that names it, ended ones included. It belongs to the
/// access token with which its file first came.
#[utoipa::path(
    delete,
    path = "/v1/terrains/{hash}",
    tag = "terrains",
    params(("hash" = String, Path, description = "Name of the terrain")),
    responses(
        (status = 204, description = "The terrain is removed"),
        (status = 403, description = "The terrain is another's", body = Problem, content_type = "application/problem+json"),
        (status = 404, description = "There is no such terrain", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "Jobs or studies name the terrain", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn remove_terrain(
    State(terrains): State<TerrainService>,
    caller: Caller,
    NamedTerrain(hash): NamedTerrain,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let terrain = named(&terrains, &hash).await?.stored;
    caller.may_change(terrain.submitter.as_deref())?;
    match terrains.remove(terrain.hash).await? {
        TerrainRemoval::Removed => Ok(StatusCode::NO_CONTENT.into_response()),
        TerrainRemoval::Unknown => Err(unknown_terrain(&hash)),
        TerrainRemoval::InUse { jobs, studies } => {
            let detail =
                format!("{jobs} jobs and {studies} studies name terrain {hash}; remove them first");
            Err(Problem::conflict(
                "terrain-in-use",
                "The terrain is in use",
                detail,
            ))
        }
    }
}
