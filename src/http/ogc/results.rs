//! Results of a job.

use super::super::access::Caller;
use super::super::named_job::{NamedJob, find};
use super::super::problem::{MEDIA_TYPE_TEXT, Problem};
use super::exceptions::{of_standard, result_not_ready};
use super::execute_request::AnswerForm;
use super::links::{Base, JSON, Link, header_value};
use super::outputs::Output;
use crate::jobs::JobService;
use crate::jobs::documents::Outcome;
use crate::jobs::job::{Job, JobStatus};
use axum::Json;
use axum::extract::State;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde_json::value::RawValue;
use serde_json::{Map, Value};
use utoipa::ToSchema;

/// Results of a job by the names of its outputs.
#[derive(Debug, Default, Serialize, ToSchema)]
#[schema(as = Results)]
pub(super) struct ResultsDocument {
    /// The answer in short.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = OutcomeValue, required = false)]
    outcome: Option<OutcomeValue>,
    /// Trajectory of the first body; absent without a body.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Link, required = false)]
    trajectory: Option<Link>,
    /// Snapshots of the flow.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Link, required = false)]
    flow: Option<Link>,
    /// Picture of the bodies' motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Link, required = false)]
    motion: Option<Link>,
    /// Picture of flow and bodies from above.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = Link, required = false)]
    aerial: Option<Link>,
}

/// An outcome as the value of an output.
#[derive(Debug, Serialize, ToSchema)]
pub(super) struct OutcomeValue {
    /// The outcome.
    #[schema(value_type = Outcome)]
    value: Box<RawValue>,
    /// Its media type.
    #[serde(rename = "mediaType")]
    media_type: &'static str,
}

/// Get the results of a job
///
/// The outcome by value, and links to trajectory, snapshots and pictures.
#[utoipa::path(
    get,
    path = "/ogc/jobs/{id}/results",
    tag = super::TAG,
    params(("id" = String, Path, format = Uuid, description = "Identifier of the job")),
    responses(
        (status = 200, description = "The results", body = ResultsDocument),
        (status = 404, description = "There is no such job, it has not ended, or it was dismissed", body = Problem, content_type = "application/problem+json"),
        (status = 500, description = "The job has failed: the problem is the job's; or a defect", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn job_results(
    State(jobs): State<JobService>,
    caller: Caller,
    base: Base,
    NamedJob(id): NamedJob,
) -> Result<Response, Problem> {
    let job = find(&jobs, &caller, &id).await.map_err(of_standard)?;
    answer(job, &AnswerForm::Document(Output::ALL.to_vec()), &base)
}

/// The results of a job in this form, or the reason why there are none.
pub(super) fn answer(job: Job, form: &AnswerForm, base: &Base) -> Result<Response, Problem> {
    let id = job.summary.id;
    match job.summary.status {
        JobStatus::Successful => Ok(in_form(job, form, base)?),
        JobStatus::Failed => failure(&job),
        JobStatus::Dismissed => Err(Problem::not_found(
            "job-dismissed",
            format!("job {id} was dismissed: /v1/jobs/{id} has what was recorded until then"),
        )),
        JobStatus::Accepted | JobStatus::Running => {
            let word = job.summary.status.word();
            Err(result_not_ready(format!("job {id} is {word}")))
        }
    }
}

fn in_form(job: Job, form: &AnswerForm, base: &Base) -> Result<Response, Problem> {
    let at = base.at(format_args!("/ogc/jobs/{}", job.summary.id));
    let mut response = match form {
        AnswerForm::Document(outputs) => Json(document(job, outputs, base)?).into_response(),
        AnswerForm::RawOutcome => Json(outcome(job)?).into_response(),
        AnswerForm::RawReferences(outputs) => {
            let mut response = StatusCode::NO_CONTENT.into_response();
            let links = outputs
                .iter()
                .filter_map(|output| output.reference(&job, base));
            for link in links.filter_map(|link| header_value(&link.href, link.rel)) {
                response.headers_mut().append(header::LINK, link);
            }
            response
        }
    };
    if let Some(monitor) = header_value(&at, "monitor") {
        response.headers_mut().append(header::LINK, monitor);
    }
    Ok(response)
}

fn document(job: Job, outputs: &[Output], base: &Base) -> Result<ResultsDocument, Problem> {
    let reference = |output: Output| {
        let asked = outputs.contains(&output);
        asked.then(|| output.reference(&job, base)).flatten()
    };
    let references = ResultsDocument {
        outcome: None,
        trajectory: reference(Output::Trajectory),
        flow: reference(Output::Flow),
        motion: reference(Output::Motion),
        aerial: reference(Output::Aerial),
    };
    if !outputs.contains(&Output::Outcome) {
        return Ok(references);
    }
    Ok(ResultsDocument {
        outcome: Some(OutcomeValue {
            value: outcome(job)?,
            media_type: JSON,
        }),
        ..references
    })
}

fn outcome(job: Job) -> Result<Box<RawValue>, Problem> {
    let outcome = job.outcome;
    outcome.ok_or_else(|| Problem::internal("a successful job without an outcome"))
}

/// The problem of a failed job, as the problem of this request.
fn failure(job: &Job) -> Result<Response, Problem> {
    let text = job.problem.as_ref().map_or("null", |problem| problem.get());
    let problem: Map<String, Value> =
        serde_json::from_str(text).map_err(|error| Problem::internal(&error))?;
    let status = StatusCode::INTERNAL_SERVER_ERROR;
    let mut problem = problem;
    problem.insert("status".to_owned(), status.as_u16().into());
    let kind = [(header::CONTENT_TYPE, MEDIA_TYPE_TEXT)];
    Ok((status, kind, Value::from(problem).to_string()).into_response())
}
