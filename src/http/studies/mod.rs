//! Studies: one scenario with uncertain inputs.

mod documents;
mod ending;
mod enlargement;
mod exports;
mod members;
mod named;
mod plan;
mod reading;
mod submission;
mod validation;

use super::services::Services;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Requests that are answered at once.
pub(super) fn quick() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(reading::list))
        .routes(routes!(reading::answers))
        .routes(routes!(members::list))
        .routes(routes!(exports::members_csv))
        .routes(routes!(exports::members_npz))
        .routes(routes!(exports::rest_geojson))
        .routes(routes!(exports::rest_tiff))
        .routes(routes!(exports::rest_picture))
        .routes(routes!(exports::sensitivity_picture))
        .routes(routes!(exports::scatter_picture))
}

/// Requests whose time the admission pool limits.
pub(super) fn submitting() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(submission::submit))
        .routes(routes!(plan::plan))
        .routes(routes!(
            reading::show,
            enlargement::enlarge,
            ending::dismiss
        ))
}
