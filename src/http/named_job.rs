//! The job named by a path.

use super::access::Caller;
use super::problem::Problem;
use crate::jobs::JobService;
use crate::jobs::job::Job;
use crate::jobs::submit::excerpt;
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

/// The job of this name.
pub(super) async fn named(jobs: &JobService, id: &str) -> Result<Job, Problem> {
    let named = id.parse().map_err(|_| unknown_job(id))?;
    jobs.job(named).await?.ok_or_else(|| unknown_job(id))
}

/// The job of this name, if the caller may read it.
pub(super) async fn find(jobs: &JobService, caller: &Caller, id: &str) -> Result<Job, Problem> {
    let job = named(jobs, id).await?;
    caller.must_read(job.submitter.as_deref())?;
    Ok(job)
}

pub(super) fn unknown_job(id: &str) -> Problem {
    Problem::not_found("unknown-job", format!("there is no job {}", excerpt(id)))
}
