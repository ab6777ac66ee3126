//! Answers of a study as files: tables, maps, pictures.

use super::named::{NamedStudy, readable};
use crate::http::access::Caller;
use crate::http::archive::{Archive, Svg, attachment};
use crate::http::problem::Problem;
use crate::http::query::Query;
use crate::http::services::Services;
use crate::jobs::JobService;
use crate::studies::StudyService;
use crate::studies::export::{self, ExportError, MemberTable};
use axum::extract::{FromRequestParts, RawQuery};
use axum::http::header;
use axum::http::request::Parts;
use axum::response::{IntoResponse, Response};
use scree_studies::answers::{Answer, Measures, RestDistribution};
use scree_studies::{Ensemble, Member, Question, Study};

/// Study of which a file is asked for, and what it is made with.
pub(in crate::http) struct Asked {
    jobs: JobService,
    studies: StudyService,
    caller: Caller,
    id: String,
}

impl FromRequestParts<Services> for Asked {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &Services) -> Result<Self, Problem> {
        let NamedStudy(id) = NamedStudy::from_request_parts(parts, state).await?;
        let caller = Caller::from_request_parts(parts, state).await?;
        Ok(Self {
            jobs: state.jobs.clone(),
            studies: state.studies.clone(),
            caller,
            id,
        })
    }
}

/// A study and its members that have an outcome.
struct Known<'a> {
    ensemble: Ensemble<'a>,
    members: Vec<Member>,
}

impl Asked {
    /// Makes a file in the caller's place in the admission pool.
    async fn make(
        self,
        make: impl FnOnce(&Known) -> Result<Vec<u8>, Problem> + Send + 'static,
    ) -> Result<Vec<u8>, Problem> {
        let stored = readable(&self.studies, &self.caller, &self.id).await?;
        let place = self.jobs.enter(&self.caller.share())?;
        let members = self.studies.outcomes(stored.id).await?;
        let made = place.work(move |_| {
            let study: Study = serde_json::from_str(stored.document.get())
                .map_err(|error| Problem::internal(&error))?;
            let ensemble = Ensemble::of(&study)
                .map_err(|_| Problem::internal("a stored study breaks rules"))?;
            make(&Known { ensemble, members })
        });
        made.await?
    }
}

impl Known<'_> {
    fn table(&self) -> MemberTable {
        MemberTable::of(&self.ensemble, &self.members)
    }

    /// The first question of a kind from this place on, and its answer.
    fn answer<T>(
        &self,
        asked: Option<usize>,
        what: &str,
        of_kind: impl Fn(Answer) -> Option<T>,
        is_of_kind: impl Fn(&Question) -> bool,
    ) -> Result<(usize, T), Problem> {
        let mut questions = self.ensemble.study().questions.iter().enumerate();
        let found = questions.find(|(place, question)| {
            is_of_kind(question) && asked.is_none_or(|asked| asked == *place)
        });
        let answer = found.and_then(|(place, question)| {
            let answer = Answer::of(&self.ensemble, &self.members, question);
            Some((place, of_kind(answer)?))
        });
        answer.ok_or_else(|| {
            let detail = match asked {
                Some(place) => format!("question {place} of the study has no {what}"),
                None => format!("no question of the study has a {what}"),
            };
            Problem::not_found("no-answer", detail)
        })
    }

    fn rest(&self, asked: Option<usize>) -> Result<(usize, RestDistribution), Problem> {
        let rest = |answer| match answer {
            Answer::Rest(rest) => Some(rest),
            _ => None,
        };
        let is_rest = |question: &Question| matches!(question, Question::Rest(_));
        self.answer(asked, "resting place", rest, is_rest)
    }

    fn sensitivity(&self, asked: Option<usize>) -> Result<(usize, Measures), Problem> {
        let measures = |answer| match answer {
            Answer::Sensitivity(measures) => measures,
            _ => None,
        };
        let is_it = |question: &Question| matches!(question, Question::Sensitivity(_));
        self.answer(asked, "sensitivity", measures, is_it)
    }
}

impl From<ExportError> for Problem {
    fn from(error: ExportError) -> Self {
        Self::internal(&error)
    }
}

/// Value of `question`.
fn question(query: Option<&str>) -> Result<Option<usize>, Problem> {
    let mut query = Query::new(query);
    let question = query.whole("question", 0..=usize::from(u16::MAX));
    query.finish()?;
    Ok(question)
}

fn file(contents: Vec<u8>, (kind, name): (&'static str, &str)) -> Response {
    let kind = [(header::CONTENT_TYPE, kind)];
    (kind, attachment(name), contents).into_response()
}

fn picture(contents: Vec<u8>) -> Response {
    ([(header::CONTENT_TYPE, "image/svg+xml")], contents).into_response()
}

/// Get the members of a study as CSV
///
/// A row for each member that has ended: its inputs, the reason of its failure, and the quantities
/// of its outcome, those of bodies as `body0.displacement_m`. Empty: it did not happen.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/members.csv",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The table", body = String, content_type = "text/csv"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_members_csv(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let name = format!("study-{}.csv", asked.id);
    let made = asked.make(|known| Ok(export::members_as_csv(&known.table()).into()));
    Ok(file(made.await?, ("text/csv; charset=utf-8", &name)))
}

/// Get the members of a study as NPZ
///
/// The numbers of the table, an array of 64-bit floats for each column; NaN where there is none.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/members.npz",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The arrays", body = Archive, content_type = "application/zip"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_members_npz(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let name = format!("study-{}.npz", asked.id);
    let made = asked.make(|known| Ok(export::members_as_npz(&known.table())));
    Ok(file(made.await?, ("application/zip", &name)))
}

/// Get the regions of resting places as GeoJSON
///
/// In the local coordinates of the channel: x downstream and y across, in metres.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.geojson",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("question" = Option<u32>, Query, description = "Place of the question in the study; the first about a resting place if left out"),
    ),
    responses(
        (status = 200, description = "The regions", body = serde_json::Value, content_type = "application/geo+json"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_rest_geojson(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |known| {
        let (_, rest) = known.rest(place)?;
        Ok(export::rest_as_geojson(&rest).to_string().into())
    });
    let kind = [(header::CONTENT_TYPE, "application/geo+json")];
    Ok((kind, made.await?).into_response())
}

/// Get the density of resting places as GeoTIFF
///
/// One band of 32-bit floats [1/m²], in the local coordinates of the channel.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.tif",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("question" = Option<u32>, Query, description = "Place of the question in the study; the first about a resting place if left out"),
    ),
    responses(
        (status = 200, description = "The image", body = Archive, content_type = "image/tiff"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn study_rest_tiff(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let name = format!("study-{}.tif", asked.id);
    let made = asked.make(move |known| {
        let (_, rest) = known.rest(place)?;
        let too_few = || Problem::not_found("no-answer", "too few members have come to rest");
        let density = rest.density.as_ref().ok_or_else(too_few)?;
        Ok(export::density_as_geotiff(density).map_err(ExportError::from)?)
    });
    Ok(file(made.await?, ("image/tiff", &name)))
}

/// Draw where a body comes to rest
///
/// Regions, resting places of the members, and the place at the start, seen from above.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/rest.svg",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("question" = Option<u32>, Query, description = "Place of the question in the study; the first about a resting place if left out"),
    ),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_rest(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |known| {
        let (place, rest) = known.rest(place)?;
        let map = export::map(&known.ensemble, &known.members, (place, &rest));
        Ok(map.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}

/// Draw what a quantity depends on
///
/// A bar with its uncertainty for each input, the largest on top.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/sensitivity.svg",
    tag = "studies",
    params(
        ("id" = String, Path, format = Uuid, description = "Identifier of the study"),
        ("question" = Option<u32>, Query, description = "Place of the question in the study; the first about a sensitivity if left out"),
    ),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 404, description = "There is no such study, or no such answer", body = Problem, content_type = "application/problem+json"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_sensitivity(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let place = question(query.as_deref())?;
    let made = asked.make(move |known| {
        let (place, measures) = known.sensitivity(place)?;
        let tornado = export::tornado(known.ensemble.study(), (place, &measures));
        Ok(tornado.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}

/// Draw quantities of the members against their inputs
///
/// Run-out, and displacement, resting place across and peak speed of the first body.
#[utoipa::path(
    get,
    path = "/v1/studies/{id}/scatter.svg",
    tag = "studies",
    params(("id" = String, Path, format = Uuid, description = "Identifier of the study")),
    responses(
        (status = 200, description = "The picture", body = Svg, content_type = "image/svg+xml"),
        (status = 429, description = "Too many requests are being read; try again after `Retry-After` seconds", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(in crate::http) async fn draw_study_scatter(
    asked: Asked,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::new(query.as_deref()).finish()?;
    let made = asked.make(|known| {
        let title = &known.ensemble.study().title;
        let drawn = export::scatter(title, &known.table());
        Ok(drawn.map_err(ExportError::from)?.into())
    });
    Ok(picture(made.await?))
}
