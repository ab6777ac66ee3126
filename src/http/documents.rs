//! What the service answers with.

use super::contract::{OutcomeDocument, ScenarioDocument};
use crate::jobs::failure::Failure;
use crate::jobs::job::{Job, JobStatus, JobSummary};
use crate::jobs::progress::Progress;
use jiff::Timestamp;
use serde::Serialize;
use serde_json::value::RawValue;
use utoipa::ToSchema;

/// A job.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Job)]
pub(super) struct JobDocument {
    /// Identity.
    #[schema(format = "uuid")]
    pub id: String,
    /// State.
    pub status: JobStatus,
    /// When it was accepted (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// When a worker took it up; null before.
    #[schema(required = true, format = "date-time")]
    pub started: Option<String>,
    /// When it ended; null before.
    #[schema(required = true, format = "date-time")]
    pub finished: Option<String>,
    /// How often a worker took it up.
    pub attempt: u32,
    /// Version of the solver that runs it, or checked it if it has not started.
    pub solver_version: String,
    /// The scenario with every default filled in.
    #[schema(value_type = ScenarioDocument)]
    pub scenario: Box<RawValue>,
    /// How far it is.
    pub progress: Progress,
    /// The answer; null unless successful.
    #[schema(required = true, value_type = Option<OutcomeDocument>)]
    pub outcome: Option<Box<RawValue>>,
    /// Why it failed; null unless failed.
    #[schema(required = true, value_type = Option<Failure>)]
    pub problem: Option<Box<RawValue>>,
}

/// A job, without its scenario and its answer.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = JobSummary)]
pub(super) struct JobSummaryDocument {
    /// Identity.
    #[schema(format = "uuid")]
    pub id: String,
    /// State.
    pub status: JobStatus,
    /// The scenario's title.
    pub title: String,
    /// When it was accepted (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// When a worker took it up; null before.
    #[schema(required = true, format = "date-time")]
    pub started: Option<String>,
    /// When it ended; null before.
    #[schema(required = true, format = "date-time")]
    pub finished: Option<String>,
    /// How far it is.
    pub progress: Progress,
}

/// A page of jobs, newest first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = JobPage)]
pub(super) struct JobPageDocument {
    /// The jobs of this page.
    pub jobs: Vec<JobSummaryDocument>,
    /// To be sent as `cursor` for the next page; null on the last.
    #[schema(required = true)]
    pub next_cursor: Option<String>,
}

/// That the service is well.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Health)]
pub(super) struct HealthDocument {
    /// Always "ok": a service that is not well answers with a problem.
    pub status: &'static str,
    /// Version of the service.
    pub version: &'static str,
}

impl From<Job> for JobDocument {
    fn from(job: Job) -> Self {
        let summary = JobSummaryDocument::from(job.summary);
        Self {
            id: summary.id,
            status: summary.status,
            created: summary.created,
            started: summary.started,
            finished: summary.finished,
            attempt: job.attempt,
            solver_version: job.solver_version,
            scenario: job.scenario,
            progress: summary.progress,
            outcome: job.outcome,
            problem: job.problem,
        }
    }
}

impl From<JobSummary> for JobSummaryDocument {
    fn from(job: JobSummary) -> Self {
        Self {
            id: job.id.to_string(),
            status: job.status,
            title: job.title,
            created: rfc3339(job.created),
            started: job.started.map(rfc3339),
            finished: job.finished.map(rfc3339),
            progress: job.progress,
        }
    }
}

/// RFC 3339 in UTC, always to the millisecond, so that times sort as text.
fn rfc3339(time: Timestamp) -> String {
    format!("{time:.3}")
}
