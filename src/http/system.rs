//! The service itself: its health, its contract, and unknown routes.

use super::documents::HealthDocument;
use super::problem::Problem;
use crate::jobs::JobService;
use crate::jobs::store::StoreError;
use crate::jobs::submit::excerpt;
use axum::Json;
use axum::extract::State;
use axum::http::{Method, StatusCode, Uri};

/// Check that the service is healthy
///
/// It is if the database answers.
#[utoipa::path(
    get,
    path = "/healthz",
    tag = "service",
    responses(
        (status = 200, description = "It is", body = HealthDocument),
        (status = 503, description = "The database does not answer", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn health(
    State(jobs): State<JobService>,
) -> Result<Json<HealthDocument>, Problem> {
    match jobs.ping().await {
        Ok(()) => Ok(Json(HealthDocument {
            status: "ok",
            version: env!("CARGO_PKG_VERSION"),
        })),
        Err(error) => Err(unavailable(&error)),
    }
}

/// Check that the service can accept jobs
///
/// Performs a real write to the database that needs the space of a job.
#[utoipa::path(
    get,
    path = "/readyz",
    tag = "service",
    responses(
        (status = 200, description = "It can", body = HealthDocument),
        (status = 503, description = "It can't", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn ready(State(jobs): State<JobService>) -> Result<Json<HealthDocument>, Problem> {
    match &*jobs.probe().await {
        Ok(()) => Ok(Json(HealthDocument {
            status: "ok",
            version: env!("CARGO_PKG_VERSION"),
        })),
        Err(error) => Err(unavailable(error)),
    }
}

fn unavailable(error: &StoreError) -> Problem {
    let reason = error.to_string();
    Problem {
        status: StatusCode::SERVICE_UNAVAILABLE.as_u16(),
        // The operator asks here what is wrong.
        detail: reason,
        ..error.into()
    }
}

pub(super) async fn no_such_route(uri: Uri) -> Problem {
    Problem::not_found(
        "unknown-route",
        format!("there is nothing at {}", excerpt(uri.path())),
    )
}

pub(super) async fn wrong_method(method: Method, uri: Uri) -> Problem {
    Problem::new(
        StatusCode::METHOD_NOT_ALLOWED,
        "method-not-allowed",
        "Method not allowed",
        format!(
            "{} can't be asked to {}",
            excerpt(uri.path()),
            excerpt(method.as_str())
        ),
    )
}
