//! The job named by a path.

use super::jobs::unknown_job;
use super::problem::Problem;
use axum::extract::{FromRequestParts, Path};
use axum::http::request::Parts;

/// The `{id}` of a path, as received. An `{id}` that is not text names no job.
pub(super) struct NamedJob(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for NamedJob {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Path::from_request_parts(parts, state)
            .await
            .map(|Path(id)| Self(id))
            .map_err(|_| unknown_job(parts.uri.path()))
    }
}
