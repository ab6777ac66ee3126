//! Documents of the service's answers.

use crate::jobs::documents::{Outcome, Plan, Scenario};
use crate::jobs::failure::Failure;
use crate::jobs::job::{Attempt, Job, JobStatus, JobSummary, Provenance};
use crate::runs::Progress;
use jiff::Timestamp;
use serde::Serialize;
use serde_json::value::RawValue;
use utoipa::ToSchema;

/// A job.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Job)]
pub(super) struct JobDocument {
    /// Identifier.
    #[schema(format = "uuid")]
    pub id: String,
    /// State.
    pub status: JobStatus,
    /// Time of acceptance (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// Time of the last claim by a worker; null while the job waits.
    #[schema(required = true, format = "date-time")]
    pub started: Option<String>,
    /// Time at which the job ended; null before.
    #[schema(required = true, format = "date-time")]
    pub finished: Option<String>,
    /// Number of attempts, that is claims by a worker.
    pub attempt: u32,
    /// All attempts, in order.
    pub attempts: Vec<AttemptDocument>,
    /// Its labels, in order.
    pub labels: Vec<String>,
    /// Name of the access token of the submitter; null if none is required.
    #[schema(required = true)]
    pub submitter: Option<String>,
    /// Provenance of the answer.
    pub provenance: Provenance,
    /// The scenario with every default filled in.
    #[schema(value_type = Scenario)]
    pub scenario: Box<RawValue>,
    /// Plan of the computation and its cost, made at submission; null for jobs
    /// accepted by an older version.
    #[schema(required = true, value_type = Option<Plan>)]
    pub plan: Option<Box<RawValue>>,
    /// Progress so far.
    pub progress: Progress,
    /// The answer; null unless successful.
    #[schema(required = true, value_type = Option<Outcome>)]
    pub outcome: Option<Box<RawValue>>,
    /// Reason of the failure; null unless failed.
    #[schema(required = true, value_type = Option<Failure>)]
    pub problem: Option<Box<RawValue>>,
}

/// One attempt at a job.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Attempt)]
pub(super) struct AttemptDocument {
    /// Number of the attempt, from 1.
    pub attempt: u32,
    /// Name of the service whose worker made the attempt.
    pub owner: String,
    /// Start time (RFC 3339).
    #[schema(format = "date-time")]
    pub started: String,
    /// Simulated time of the saved state from which the attempt resumed [s]; null: it began at
    /// the start.
    #[schema(required = true)]
    pub resumed_from_s: Option<f64>,
    /// End time; null while the attempt continues.
    #[schema(required = true, format = "date-time")]
    pub ended: Option<String>,
    /// Kind of end: successful, failed, dismissed, handed-back (the service
    /// stopped), cut-off (the service died), expired (the lease ran out),
    /// infrastructure (the service could not run the job); null while the attempt continues.
    #[schema(required = true)]
    pub ending: Option<String>,
    /// Details of the end; null if there are none.
    #[schema(required = true)]
    pub detail: Option<String>,
}

/// A job, without its scenario and its answer.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = JobSummary)]
pub(super) struct JobSummaryDocument {
    /// Identifier.
    #[schema(format = "uuid")]
    pub id: String,
    /// State.
    pub status: JobStatus,
    /// The scenario's title.
    pub title: String,
    /// Time of acceptance (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// Time of the last claim by a worker; null before the first.
    #[schema(required = true, format = "date-time")]
    pub started: Option<String>,
    /// Time at which the job ended; null before.
    #[schema(required = true, format = "date-time")]
    pub finished: Option<String>,
    /// Progress so far.
    pub progress: Progress,
    /// Its labels, in order.
    pub labels: Vec<String>,
    /// The answer, null unless successful; only with `include=outcome`.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(required = false, value_type = Option<Outcome>)]
    pub outcome: Option<Option<Box<RawValue>>>,
}

/// A page of jobs, newest first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = JobPage)]
pub(super) struct JobPageDocument {
    /// The jobs of this page.
    pub jobs: Vec<JobSummaryDocument>,
    /// Value of `cursor` for the next page; null on the last page.
    #[schema(required = true)]
    pub next_cursor: Option<String>,
}

/// Health of the service.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = Health)]
pub(super) struct HealthDocument {
    /// Always "ok"; an unhealthy service answers with a problem.
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
            attempts: job.attempts.into_iter().map(Into::into).collect(),
            labels: summary.labels,
            submitter: job.submitter,
            provenance: job.provenance,
            scenario: job.scenario,
            plan: job.plan,
            progress: summary.progress,
            outcome: job.outcome,
            problem: job.problem,
        }
    }
}

impl From<Attempt> for AttemptDocument {
    fn from(attempt: Attempt) -> Self {
        Self {
            attempt: attempt.attempt,
            owner: attempt.owner,
            started: rfc3339(attempt.started),
            resumed_from_s: attempt.resumed_from_s,
            ended: attempt.ended.map(rfc3339),
            ending: attempt.ending,
            detail: attempt.detail,
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
            labels: job.labels,
            outcome: None,
        }
    }
}

/// RFC 3339 in UTC, always to the millisecond, so that times sort as text.
pub(super) fn rfc3339(time: Timestamp) -> String {
    format!("{time:.3}")
}
