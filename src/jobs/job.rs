//! A job as seen outside the database.

use super::identifier::identifier;
use crate::runs::Progress;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

identifier! {
    /// Identifier of a job.
    JobId
}

/// State of a job, in the words of OGC API – Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum JobStatus {
    /// Waiting for a worker.
    Accepted,
    /// Being computed.
    Running,
    /// Computed to the end, with an outcome.
    Successful,
    /// Ended without an answer, with a problem.
    Failed,
    /// Cancelled; the results recorded by then are kept.
    Dismissed,
}

impl JobStatus {
    /// All states, in the order of a job's life.
    pub const ALL: [Self; 5] = [
        Self::Accepted,
        Self::Running,
        Self::Successful,
        Self::Failed,
        Self::Dismissed,
    ];

    /// Name of the state.
    pub fn word(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Running => "running",
            Self::Successful => "successful",
            Self::Failed => "failed",
            Self::Dismissed => "dismissed",
        }
    }

    /// True if a job never leaves this state.
    pub fn is_final(self) -> bool {
        matches!(self, Self::Successful | Self::Failed | Self::Dismissed)
    }

    /// The state with this name.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}

/// A job without its scenario and its answer, as lists show it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobSummary {
    /// Identifier.
    pub id: JobId,
    /// Order of submission.
    pub sequence: i64,
    /// State.
    pub status: JobStatus,
    /// The scenario's title.
    pub title: String,
    /// Time of acceptance.
    pub created: Timestamp,
    /// Time of the last claim by a worker; none before the first.
    pub started: Option<Timestamp>,
    /// Time of the end; none before.
    pub finished: Option<Timestamp>,
    /// Progress of the run.
    pub progress: Progress,
    /// Its labels, in order.
    pub labels: Vec<String>,
}

/// One attempt at a job.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// Number of the attempt, from 1.
    pub attempt: u32,
    /// Name of the service whose worker made the attempt.
    pub owner: String,
    /// Start time.
    pub started: Timestamp,
    /// Simulated time of the saved state from which the attempt resumed [s]; none: it began at
    /// the start.
    pub resumed_from_s: Option<f64>,
    /// End time; none while the attempt continues.
    pub ended: Option<Timestamp>,
    /// Kind of end.
    pub ending: Option<String>,
    /// Details of the end.
    pub detail: Option<String>,
}

/// Provenance: all conditions that must be equal for equal answers, and a fingerprint to compare
/// them.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Provenance {
    /// BLAKE3 of the scenario's JSON with every default filled in, as the job
    /// shows it, 64 hexadecimal digits.
    pub scenario_hash: String,
    /// Version of the solver that runs the job, or that validated it if it has not started.
    pub solver_version: String,
    /// Commit of the program that runs the job; null before the start.
    #[schema(required = true)]
    pub solver_commit: Option<String>,
    /// Instruction set of the kernels (baseline, AVX2, AVX-512); null before the
    /// start.
    #[schema(required = true)]
    pub instructions: Option<String>,
    /// Number of solver threads at the start of the last attempt; null before the start. Jobs that
    /// run at the same time share the cores, so that it changes on the way; results do not depend on
    /// it.
    #[schema(required = true)]
    pub threads: Option<u32>,
    /// Fingerprint of all records of the run, 64 hexadecimal digits: equal
    /// fingerprints mean equal bits. Null unless successful.
    #[schema(required = true)]
    pub fingerprint: Option<String>,
}

/// A full job.
#[derive(Debug, Clone)]
pub struct Job {
    /// Summary, as lists show it.
    pub summary: JobSummary,
    /// Number of bodies in the scenario.
    pub bodies: usize,
    /// Number of attempts, that is claims by a worker.
    pub attempt: u32,
    /// All attempts, in order.
    pub attempts: Vec<Attempt>,
    /// Name of the access token of the submitter; none if none is required.
    pub submitter: Option<String>,
    /// Provenance of the answer.
    pub provenance: Provenance,
    /// The scenario's JSON with every default filled in.
    pub scenario: Box<RawValue>,
    /// The plan's JSON; none for jobs older than plans.
    pub plan: Option<Box<RawValue>>,
    /// The outcome's JSON; none unless successful.
    pub outcome: Option<Box<RawValue>>,
    /// The failure's JSON; none unless failed.
    pub problem: Option<Box<RawValue>>,
}
