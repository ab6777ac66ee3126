//! Requests with an Idempotency-Key: the same key brings the same answer.

use crate::jobs::job::JobId;

/// An Idempotency-Key, and the body of its request.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Key {
    /// The key.
    pub text: String,
    /// BLAKE3 of the request.
    pub request_hash: [u8; 32],
}

/// The first request with a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum FormerRequest {
    /// It was another request.
    Other,
    /// It was the same request.
    Same {
        /// Its jobs, in its order; none if it was answered with a finished job.
        jobs: Vec<JobId>,
        /// The answer it got; `None` if the service died before there was one.
        answer: Option<KeptAnswer>,
    },
}

/// Answer to a request with a key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KeptAnswer {
    /// HTTP status.
    pub status: u16,
    /// Location of the job.
    pub location: Option<String>,
    /// JSON of the answer.
    pub body: String,
}

/// Retention of keys whose jobs have all been removed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KeyRetention {
    /// Operating time since the removal [ms].
    pub age_ms: i64,
    /// Space of those of one submitter; beyond it the oldest are forgotten sooner.
    pub bytes: u64,
}
