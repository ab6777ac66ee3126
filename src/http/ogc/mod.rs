//! OGC API – Processes, Part 1: Core (OGC 18-062r2) over the same jobs as `/v1`: one process, whose
//! input is a scenario.

mod exceptions;
mod execute_request;
mod execution;
mod jobs;
mod landing;
mod links;
mod oas30;
mod outputs;
mod preferences;
mod process;
mod processes;
mod results;
mod status_info;

pub(super) use process::Process;

use crate::http::services::Services;
use axum::Router;
use axum::routing::get;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Name of the requests' group in the contract.
pub(super) const TAG: &str = "ogc";

/// Requests that are answered at once.
pub(super) fn quick() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(landing::landing_page))
        .routes(routes!(landing::conformance))
        .routes(routes!(processes::process_list))
        .routes(routes!(processes::process_description))
        .routes(routes!(jobs::job_list))
        .routes(routes!(results::job_results))
}

/// The landing page for clients that append to the address of the service. The contract has paths
/// without a final slash.
pub(super) fn beside_the_contract() -> Router<Services> {
    Router::new().route("/ogc/", get(landing::landing_page))
}

/// Requests that may wait for a run.
pub(super) fn waiting() -> OpenApiRouter<Services> {
    OpenApiRouter::new()
        .routes(routes!(execution::execute))
        .routes(routes!(jobs::job_status, jobs::dismiss_job))
}

/// True if a path only describes the process: it reveals nothing about jobs.
pub(super) fn is_description(path: &str) -> bool {
    let fixed = ["/ogc", "/ogc/", "/ogc/conformance", "/ogc/processes"];
    let process = path.strip_prefix("/ogc/processes/");
    fixed.contains(&path) || process.is_some_and(|process| !process.contains('/'))
}
