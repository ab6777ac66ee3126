//! The state of a job, in the words of the standard.

use super::super::documents::rfc3339;
use super::links::{Base, JSON, Link, relation};
use super::process;
use crate::jobs::job::{JobStatus, JobSummary};
use serde::Serialize;
use utoipa::ToSchema;

/// State of a job.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StatusInfo)]
pub(super) struct StatusInfoDocument {
    /// The process, always `simulation`.
    #[serde(rename = "processID")]
    process_id: &'static str,
    /// Kind of job, always `process`.
    #[serde(rename = "type")]
    kind: &'static str,
    /// Identifier.
    #[serde(rename = "jobID")]
    #[schema(format = "uuid")]
    job_id: String,
    /// State.
    status: JobStatus,
    /// The scenario's title; absent if it is empty.
    #[serde(skip_serializing_if = "String::is_empty")]
    #[schema(required = false)]
    message: String,
    /// Time of acceptance.
    #[schema(format = "date-time")]
    created: String,
    /// Time of the last claim by a worker; absent before the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = String, required = false, format = "date-time")]
    started: Option<String>,
    /// Time at which the job ended; absent before.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schema(value_type = String, required = false, format = "date-time")]
    finished: Option<String>,
    /// Time of the last change of the state.
    #[schema(format = "date-time")]
    updated: String,
    /// Share of the run that is done [%].
    #[schema(minimum = 0, maximum = 100)]
    progress: u8,
    /// Links to the job and, once it has ended, to its results.
    links: Vec<Link>,
}

impl StatusInfoDocument {
    pub(super) fn of(job: JobSummary, base: &Base) -> Self {
        let updated = job.finished.or(job.started).unwrap_or(job.created);
        Self {
            process_id: process::ID,
            kind: "process",
            job_id: job.id.to_string(),
            status: job.status,
            links: links(&job, base),
            progress: percent(job.status, job.progress.fraction),
            message: job.title,
            created: rfc3339(job.created),
            started: job.started.map(rfc3339),
            finished: job.finished.map(rfc3339),
            updated: rfc3339(updated),
        }
    }
}

fn links(job: &JobSummary, base: &Base) -> Vec<Link> {
    let at = format!("/ogc/jobs/{}", job.id);
    let results = format!("{at}/results");
    let results = match job.status {
        JobStatus::Successful => Some(base.json(results, relation::RESULTS, "Results of the job")),
        JobStatus::Failed => Some(Link {
            media_type: "application/problem+json",
            ..base.json(results, relation::EXCEPTIONS, "Reason of the failure")
        }),
        JobStatus::Accepted | JobStatus::Running | JobStatus::Dismissed => None,
    };
    let own_form = Link {
        href: base.at(format_args!("/v1/jobs/{}", job.id)),
        rel: "alternate",
        media_type: JSON,
        title: "The job with scenario, plan and provenance",
    };
    let own = base.json(&at, "self", "State of the job");
    [own, own_form].into_iter().chain(results).collect()
}

/// Whole percent; 100 means that the job was computed to its end.
fn percent(status: JobStatus, fraction: f64) -> u8 {
    if status == JobStatus::Successful {
        return 100;
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "it is clamped to the range"
    )]
    let percent = (fraction * 100.0).clamp(0.0, 99.0) as u8;
    percent
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_successful_job_is_done() {
        assert_eq!(percent(JobStatus::Successful, 0.4), 100);
        assert_eq!(percent(JobStatus::Running, 0.0), 0);
        assert_eq!(percent(JobStatus::Running, 0.499), 49);
        assert_eq!(percent(JobStatus::Failed, 1.0), 99);
    }
}
