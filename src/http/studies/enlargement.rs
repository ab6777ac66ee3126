//! Enlargement of a study.

use super::documents::StudyDocument;
use super::named::{NamedStudy, changeable, unknown_study};
use super::submission::full;
use super::validation::{INVALID_STUDY, validated};
use crate::http::access::Caller;
use crate::http::field_errors::FieldError;
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::http::scenario_body::{ScenarioText, read_envelope};
use crate::jobs::JobService;
use crate::jobs::store::Enlarged;
use crate::studies::StudyService;
use axum::Json;
use axum::extract::{RawQuery, State};
use axum::http::StatusCode;
use scree_studies::{Accuracy, Design, FinerLevel, Question, Stop, Study};
use serde::Deserialize;
use serde_json::Value;
use utoipa::ToSchema;

/// Changes to a study; what is left out stays.
#[derive(Debug, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
#[schema(as = StudyChanges)]
pub(super) struct ChangesDocument {
    /// A design that has the present one's members first.
    design: Option<Design>,
    /// Levels that begin with the present ones' cell sizes.
    finer_levels: Option<Vec<FinerLevel>>,
    /// Another accuracy; it replaces a stopping rule.
    accuracy: Option<Accuracy>,
    /// Another stopping rule; it replaces an accuracy.
    stop: Option<Stop>,
    /// Other questions.
    questions: Option<Vec<Question>>,
}

impl ChangesDocument {
    fn applied(self, study: &Study) -> Result<Study, Problem> {
        let design = match self.design {
            Some(design) if !study.design.can_be_enlarged_to(&design) => {
                let allowed =
                    "a design of the same kind and seed that has the present one's members first";
                return Err(not_larger("/design", allowed));
            }
            Some(design) => design,
            None => study.design.clone(),
        };
        // The one excludes the other, so either of them replaces both.
        let (accuracy, stop) = match (self.accuracy, self.stop) {
            (None, None) => (study.accuracy.clone(), study.stop),
            given => given,
        };
        let changed = Study {
            design,
            finer_levels: self
                .finer_levels
                .unwrap_or_else(|| study.finer_levels.clone()),
            accuracy,
            stop,
            questions: self.questions.unwrap_or_else(|| study.questions.clone()),
            ..study.clone()
        };
        if !study.levels_go_on_in(&changed) {
            let allowed = "levels of which the first have the present ones' cell sizes";
            return Err(not_larger("/finer_levels", allowed));
        }
        Ok(changed)
    }
}

fn not_larger(pointer: &str, allowed: &str) -> Problem {
    let fault = FieldError::of_body(pointer, Value::Null, allowed);
    let status = StatusCode::UNPROCESSABLE_ENTITY;
    Problem {
        errors: vec![fault],
        ..Problem::new(status, INVALID_STUDY.0, INVALID_STUDY.1, allowed)
    }
}

/// Enlarge a study
///
/// With a larger design no run is lost: its first members are those there already. A study that
/// has ended successfully goes on. Its levels, its accuracy, its stopping rule and its questions may
/// be changed, too.
#[utoipa::path(
    patch,
    path = "/v1/studies/{id}",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    request_body = ChangesDocument,
    responses(
        (status = 200, description = "The study, which runs", body = StudyDocument),
        (status = 400, description = "The body is not JSON", body = Problem, content_type = "application/problem+json"),
        (status = 403, description = "The study is another's", body = Problem, content_type = "application/problem+json"),
        (status = 408, description = "The body took too long", body = Problem, content_type = "application/problem+json"),
        (status = 409, description = "The study has failed or is dismissed, or was changed meanwhile", body = Problem, content_type = "application/problem+json"),
        (status = 413, description = "The body is too large", body = Problem, content_type = "application/problem+json"),
        (status = 415, description = "The body is not declared as JSON", body = Problem, content_type = "application/problem+json"),
        (status = 422, description = "The study breaks rules (`errors` has them all)", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many studies run, or too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
        (status = 507, description = "The disk is full", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn enlarge_study(
    State(jobs): State<JobService>,
    State(studies): State<StudyService>,
    caller: Caller,
    NamedStudy(id): NamedStudy,
    RawQuery(query): RawQuery,
    ScenarioText(text): ScenarioText,
) -> Result<Json<StudyDocument>, Problem> {
    Query::new(query.as_deref()).finish()?;
    let stored = changeable(&studies, &caller, &id).await?;
    let changes: ChangesDocument = read_envelope(&text, INVALID_STUDY)?;
    let changed = changes.applied(&stored.study()?)?;
    let study = validated(&jobs, &caller, changed).await?;
    let document = serde_json::to_string(&study).map_err(|error| Problem::internal(&error))?;
    match studies.enlarge(&stored, &document).await? {
        Enlarged::Done => {}
        Enlarged::Changed => {
            let detail = format!("study {id} was changed meanwhile: read it, and change it again");
            let title = "The study was changed";
            return Err(Problem::conflict("study-changed", title, detail));
        }
        Enlarged::Full(running) => return Err(full(running, studies.room())),
        Enlarged::Unknown => return Err(unknown_study(&id)),
        Enlarged::Ended(status) => {
            let detail = format!("study {id} is {}: it can't go on", status.word());
            let title = "The study has ended";
            return Err(Problem::conflict("study-ended", title, detail));
        }
    }
    let stored = studies.study(stored.id).await?;
    let stored = stored.ok_or_else(|| unknown_study(&id))?;
    Ok(Json(StudyDocument::from(stored)))
}
