//! Studies: one scenario with uncertain inputs.

mod asked;
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
        .routes(routes!(reading::list_studies))
        .routes(routes!(reading::study_answers))
        .routes(routes!(members::list_members))
        .routes(routes!(exports::study_members_csv))
        .routes(routes!(exports::study_members_npz))
        .routes(routes!(exports::study_rest_geojson))
        .routes(routes!(exports::study_rest_tiff))
        .routes(routes!(exports::draw_study_rest))
        .routes(routes!(exports::draw_study_sensitivity))
        .routes(routes!(exports::draw_study_scatter))
}

/// Requests whose time the admission pool limits.
pub(super) fn submitting() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(submission::submit_study))
        .routes(routes!(plan::plan_study))
        .routes(routes!(
            reading::show_study,
            enlargement::enlarge_study,
            ending::dismiss_study
        ))
}
