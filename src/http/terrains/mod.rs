//! Terrains: rasters that clients upload and scenarios name.

mod documents;
mod named;
mod reading;
mod removal;
mod upload;

use super::services::Services;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Requests that are answered at once.
pub(super) fn quick() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(reading::list_terrains))
        .routes(routes!(reading::terrain_file))
        .routes(routes!(reading::show_terrain, removal::remove_terrain))
}

/// Requests whose time the limits of uploads and the admission pool limit.
pub(super) fn uploading() -> OpenApiRouter<Services> {
    OpenApiRouter::new().routes(routes!(upload::upload_terrain))
}
