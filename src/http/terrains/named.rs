//! The terrain named by a path.

use crate::http::problem::Problem;
use crate::jobs::submit::excerpt;
use crate::terrains::{Terrain, TerrainService};
use axum::extract::{FromRequestParts, Path};
use axum::http::request::Parts;

/// The `{hash}` of a path, as received. One that is not text names no terrain.
pub(super) struct NamedTerrain(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for NamedTerrain {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Path::from_request_parts(parts, state)
            .await
            .map(|Path(hash)| Self(hash))
            .map_err(|_| unknown_terrain(parts.uri.path()))
    }
}

/// The terrain of this name. Whoever can name it has its file, or was told of it: its name can't be
/// guessed.
pub(super) async fn named(terrains: &TerrainService, hash: &str) -> Result<Terrain, Problem> {
    let named = hash.parse().map_err(|_| unknown_terrain(hash))?;
    let terrain = terrains.terrain(named).await?;
    terrain.ok_or_else(|| unknown_terrain(hash))
}

pub(super) fn unknown_terrain(hash: &str) -> Problem {
    let detail = format!("there is no terrain {}", excerpt(hash));
    Problem::not_found("unknown-terrain", detail)
}
