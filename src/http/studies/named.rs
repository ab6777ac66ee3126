//! The study named by a path.

use crate::http::access::Caller;
use crate::http::problem::Problem;
use crate::jobs::submit::excerpt;
use crate::studies::StudyService;
use crate::studies::study::{StoredStudy, UnusableStudy};
use axum::extract::{FromRequestParts, Path};
use axum::http::request::Parts;

/// The `{id}` of a path, as received. An `{id}` that is not text names no study.
pub(super) struct NamedStudy(pub(super) String);

impl<S: Send + Sync> FromRequestParts<S> for NamedStudy {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        Path::from_request_parts(parts, state)
            .await
            .map(|Path(id)| Self(id))
            .map_err(|_| unknown_study(parts.uri.path()))
    }
}

/// The study of this name.
async fn named(studies: &StudyService, id: &str) -> Result<StoredStudy, Problem> {
    let named = id.parse().map_err(|_| unknown_study(id))?;
    let study = studies.study(named).await?;
    study.ok_or_else(|| unknown_study(id))
}

/// The study of this name, if the caller may read it.
pub(super) async fn readable(
    studies: &StudyService,
    caller: &Caller,
    id: &str,
) -> Result<StoredStudy, Problem> {
    let study = named(studies, id).await?;
    caller.must_read(study.submitter.as_deref())?;
    Ok(study)
}

/// The study of this name, if the caller may change it.
pub(super) async fn changeable(
    studies: &StudyService,
    caller: &Caller,
    id: &str,
) -> Result<StoredStudy, Problem> {
    let study = named(studies, id).await?;
    caller.may_change(study.submitter.as_deref())?;
    Ok(study)
}

pub(super) fn unknown_study(id: &str) -> Problem {
    let detail = format!("there is no study {}", excerpt(id));
    Problem::not_found("unknown-study", detail)
}

impl From<UnusableStudy> for Problem {
    fn from(error: UnusableStudy) -> Self {
        Self::internal(&error)
    }
}
