//! Dismissal and removal of studies.

use super::documents::StudyDocument;
use super::named::{NamedStudy, changeable, unknown_study};
use crate::http::access::Caller;
use crate::http::choice::Remove;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::jobs::store::{Removal, StudyDismissal};
use crate::studies::StudyService;
use crate::studies::study::StudyId;
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};

/// Dismiss or remove a study
///
/// Its members that wait never start, and those that run stop, unless another study has them,
/// too. With `remove=ended` a study that has ended is removed with its members' jobs, except
/// those that another study has or that were submitted by themselves.
#[utoipa::path(
    delete,
    path = "/v1/studies/{id}",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("remove" = inline(Option<Remove>), Query, description = "Remove the study, which must have ended"),
    ),
    responses(
        (status = 200, description = "The study, dismissed", body = StudyDocument),
        (status = 204, description = "The study is removed"),
        (status = 403, description = "The study is another's", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "The study had ended otherwise; or is to be removed and has not ended", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn dismiss_study(
    State(studies): State<StudyService>,
    caller: Caller,
    NamedStudy(id): NamedStudy,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let mut query = Query::new(query.as_deref());
    let remove: Option<Remove> = query.choice("remove");
    query.finish()?;
    let study = changeable(&studies, &caller, &id).await?.id;
    if remove.is_some() {
        return removed(&studies, study).await;
    }
    match studies.dismiss(study).await? {
        // No document is asked for, so that none can be another.
        StudyDismissal::Done(_) | StudyDismissal::Changed => {}
        StudyDismissal::Unknown => return Err(unknown_study(&id)),
        StudyDismissal::Ended(status) => {
            let detail = format!("study {id} is {}", status.word());
            return Err(Problem::conflict(
                "study-ended",
                "The study has ended",
                detail,
            ));
        }
    }
    let dismissed = studies.study(study).await?;
    let dismissed = dismissed.ok_or_else(|| unknown_study(&id))?;
    Ok(Json(StudyDocument::from(dismissed)).into_response())
}

async fn removed(studies: &StudyService, study: StudyId) -> Result<Response, Problem> {
    match studies.remove(study).await? {
        Removal::Removed => Ok(StatusCode::NO_CONTENT.into_response()),
        Removal::Unknown => Err(unknown_study(&study.to_string())),
        Removal::Active => {
            let detail = format!("study {study} has not ended: dismiss it first");
            Err(Problem::conflict(
                "study-active",
                "The study has not ended",
                detail,
            ))
        }
    }
}
