//! A job as it is known outside the database.

use super::progress::Progress;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::fmt;
use std::str::FromStr;
use utoipa::ToSchema;
use uuid::Uuid;

/// Identity of a job: a UUID of version 7, so that identities sort by age.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct JobId(Uuid);

impl JobId {
    /// A new identity.
    pub fn new() -> Self {
        Self(Uuid::now_v7())
    }
}

impl Default for JobId {
    fn default() -> Self {
        Self::new()
    }
}

impl fmt::Display for JobId {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.hyphenated().fmt(formatter)
    }
}

impl FromStr for JobId {
    type Err = uuid::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Uuid::try_parse(text).map(Self)
    }
}

/// State of a job, in the words of OGC API – Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum JobStatus {
    /// Waiting for a worker.
    Accepted,
    /// Being computed.
    Running,
    /// Computed to the end; has an outcome.
    Successful,
    /// Ended without an answer; has a problem.
    Failed,
    /// Called off; what was computed by then is kept.
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

    /// The state's word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Running => "running",
            Self::Successful => "successful",
            Self::Failed => "failed",
            Self::Dismissed => "dismissed",
        }
    }

    /// True if a job never leaves it.
    pub fn is_final(self) -> bool {
        matches!(self, Self::Successful | Self::Failed | Self::Dismissed)
    }

    /// The state of this word.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}

/// A job without its scenario and its answer, as lists show it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobSummary {
    /// Identity.
    pub id: JobId,
    /// Order of submission.
    pub sequence: i64,
    /// State.
    pub status: JobStatus,
    /// The scenario's title.
    pub title: String,
    /// When it was accepted.
    pub created: Timestamp,
    /// When a worker took it up; none before.
    pub started: Option<Timestamp>,
    /// When it ended; none before.
    pub finished: Option<Timestamp>,
    /// How far it is.
    pub progress: Progress,
    /// Its labels, in order.
    pub labels: Vec<String>,
}

/// One time that a worker took a job up.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// The how manieth, from 1.
    pub attempt: u32,
    /// Service whose worker it was.
    pub owner: String,
    /// When it began.
    pub started: Timestamp,
    /// Simulated time of the saved state it went on from [s]; none: from the
    /// start.
    pub resumed_from_s: Option<f64>,
    /// When it ended; none while it goes on.
    pub ended: Option<Timestamp>,
    /// How it ended, in a word.
    pub ending: Option<String>,
    /// More about that.
    pub detail: Option<String>,
}

/// What has to be the same for the same answer, and how to tell.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub struct Provenance {
    /// BLAKE3 of the scenario's JSON with every default filled in, as the job
    /// shows it, 64 hexadecimal digits.
    pub scenario_hash: String,
    /// Version of the solver that runs it, or checked it if it has not started.
    pub solver_version: String,
    /// Commit of the program that runs it; null before the start.
    #[schema(required = true)]
    pub solver_commit: Option<String>,
    /// Instructions of its fast path (baseline, AVX2, AVX-512); null before the
    /// start.
    #[schema(required = true)]
    pub instructions: Option<String>,
    /// Solver threads; null before the start. Results do not depend on it.
    #[schema(required = true)]
    pub threads: Option<u32>,
    /// Fingerprint of all that the run recorded, 64 hexadecimal digits: equal
    /// fingerprints, equal bits. Null unless successful.
    #[schema(required = true)]
    pub fingerprint: Option<String>,
}

/// A whole job.
#[derive(Debug, Clone)]
pub struct Job {
    /// What lists show.
    pub summary: JobSummary,
    /// Bodies in the scenario.
    pub bodies: usize,
    /// How often a worker took it up.
    pub attempt: u32,
    /// Those times, the first first.
    pub attempts: Vec<Attempt>,
    /// Name of the access token it came with; none where no token is asked for.
    pub submitter: Option<String>,
    /// What the answer comes from.
    pub provenance: Provenance,
    /// The scenario's JSON with every default filled in.
    pub scenario: Box<RawValue>,
    /// The plan's JSON; none for jobs from before there were plans.
    pub plan: Option<Box<RawValue>>,
    /// The outcome's JSON, once successful.
    pub outcome: Option<Box<RawValue>>,
    /// The failure's JSON, once failed.
    pub problem: Option<Box<RawValue>>,
}
