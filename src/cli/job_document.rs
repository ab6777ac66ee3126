//! A job, as a client of the service reads it.

use super::failure::Failure;
use scree::runs::Progress;
use scree_solver::record::Outcome;
use serde::Deserialize;
use serde_json::value::RawValue;

/// Kind of a failure of the computation.
const NUMERICAL: &str = "urn:scree:failure:numerical";
/// Kind of a failure of the scenario: too large to set up.
const SETUP: &str = "urn:scree:failure:setup";

/// Fields of a job that clients read. Parts that are handed on stay as they were received.
#[derive(Debug, Deserialize)]
pub(super) struct Job {
    pub(super) id: String,
    pub(super) status: String,
    pub(super) progress: Progress,
    pub(super) scenario: Box<RawValue>,
    pub(super) outcome: Option<Box<RawValue>>,
    problem: Option<Problem>,
}

/// Reason that a job or a study failed.
#[derive(Debug, Deserialize)]
pub(super) struct Problem {
    #[serde(rename = "type")]
    kind: String,
    detail: String,
}

impl Job {
    /// True if the job neither runs nor waits.
    pub(super) fn has_ended(&self) -> bool {
        !matches!(self.status.as_str(), "accepted" | "running")
    }

    /// Outcome of a job that has ended.
    ///
    /// # Errors
    /// The job gave none, or one of another version.
    pub(super) fn end(&self) -> Result<Outcome, Failure> {
        if let Some(problem) = &self.problem {
            return Err(problem.failure());
        }
        match &self.outcome {
            Some(outcome) if self.status == "successful" => serde_json::from_str(outcome.get())
                .map_err(|error| {
                    let what =
                        "the outcome is not understood; the service may be of another version";
                    Failure::other(what, error)
                }),
            _ => Err(Failure::Other(format!("the job ended as {}", self.status))),
        }
    }
}

impl Problem {
    /// Failure of a command that was to have an answer, as of `scree run`.
    pub(super) fn failure(&self) -> Failure {
        let detail = self.detail.clone();
        match self.kind.as_str() {
            NUMERICAL => Failure::Numerical(detail),
            SETUP => Failure::Input(detail),
            _ => Failure::Other(detail),
        }
    }
}
