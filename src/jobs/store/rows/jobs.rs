//! Jobs, in short and whole.

use super::broken;
use crate::jobs::job::{Attempt, Job, JobStatus, JobSummary, Provenance};
use crate::jobs::store::{ListedJob, StoreError};
use crate::runs::Progress;
use jiff::Timestamp;
use serde_json::value::RawValue;
use sqlx::FromRow;

/// Columns of a job's summary.
#[derive(Debug, FromRow)]
struct SummaryRow {
    sequence: i64,
    id: String,
    status: String,
    title: String,
    created_ms: i64,
    started_ms: Option<i64>,
    finished_ms: Option<i64>,
    fraction: f64,
    simulated_time_s: f64,
    steps: i64,
    substeps: i64,
    point_steps_per_s: f64,
    eta_s: Option<f64>,
    /// A JSON list.
    labels: String,
}

/// Columns that a list shows.
#[derive(Debug, FromRow)]
pub(in super::super) struct ListedRow {
    #[sqlx(flatten)]
    summary: SummaryRow,
    outcome: Option<String>,
}

/// All columns of a job.
#[derive(Debug, FromRow)]
pub(in super::super) struct JobRow {
    #[sqlx(flatten)]
    summary: SummaryRow,
    bodies: i64,
    attempt: i64,
    threads: Option<i64>,
    solver_version: String,
    solver_commit: String,
    instructions: String,
    scenario_hash: String,
    submitter: Option<String>,
    scenario: String,
    plan: Option<String>,
    outcome: Option<String>,
    fingerprint: Option<String>,
    problem: Option<String>,
}

impl ListedRow {
    /// Size of the outcome [bytes].
    pub(in super::super) fn outcome_bytes(&self) -> usize {
        self.outcome.as_ref().map_or(0, String::len)
    }

    pub(in super::super) fn read(self) -> Result<ListedJob, StoreError> {
        let summary = self.summary.read()?;
        let outcome = self.outcome.map(RawValue::from_string).transpose();
        let outcome = outcome.map_err(|_| broken(&summary.id.to_string(), "outcome"))?;
        Ok(ListedJob { summary, outcome })
    }
}

impl SummaryRow {
    fn read(self) -> Result<JobSummary, StoreError> {
        let progress = self.progress();
        let broken = |what| broken(&self.id, what);
        let time = |ms| Timestamp::from_millisecond(ms).map_err(|_| broken("a time"));
        Ok(JobSummary {
            id: self.id.parse().map_err(|_| broken("id"))?,
            sequence: self.sequence,
            status: JobStatus::from_word(&self.status).ok_or_else(|| broken("status"))?,
            created: time(self.created_ms)?,
            started: self.started_ms.map(time).transpose()?,
            finished: self.finished_ms.map(time).transpose()?,
            title: self.title,
            progress,
            labels: serde_json::from_str(&self.labels).map_err(|_| broken("labels"))?,
        })
    }

    fn progress(&self) -> Progress {
        Progress {
            fraction: self.fraction,
            simulated_time_s: self.simulated_time_s,
            steps: self.steps.unsigned_abs(),
            substeps: self.substeps.unsigned_abs(),
            point_steps_per_s: self.point_steps_per_s,
            eta_s: self.eta_s,
        }
    }
}

impl JobRow {
    pub(in super::super) fn read(self, attempts: Vec<Attempt>) -> Result<Job, StoreError> {
        let id = self.summary.id.clone();
        let broken = |what| broken(&id, what);
        let json = |text: String, what| RawValue::from_string(text).map_err(|_| broken(what));
        Ok(Job {
            summary: self.summary.read()?,
            bodies: usize::try_from(self.bodies).map_err(|_| broken("bodies"))?,
            attempts,
            attempt: u32::try_from(self.attempt).map_err(|_| broken("attempt"))?,
            submitter: self.submitter,
            provenance: Provenance {
                scenario_hash: self.scenario_hash,
                solver_version: self.solver_version,
                solver_commit: started(self.solver_commit),
                instructions: started(self.instructions),
                threads: self
                    .threads
                    .map(u32::try_from)
                    .transpose()
                    .map_err(|_| broken("threads"))?,
                fingerprint: self.fingerprint,
            },
            scenario: json(self.scenario, "scenario")?,
            plan: self.plan.map(|text| json(text, "plan")).transpose()?,
            outcome: self.outcome.map(|text| json(text, "outcome")).transpose()?,
            problem: self.problem.map(|text| json(text, "problem")).transpose()?,
        })
    }
}

/// A text that is empty until a worker claims the job.
fn started(text: String) -> Option<String> {
    (!text.is_empty()).then_some(text)
}
