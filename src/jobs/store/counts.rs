//! Numbers of jobs, for the metrics.

use crate::jobs::job::JobStatus;

/// Numbers of jobs.
#[derive(Debug, Clone, PartialEq)]
pub struct JobCounts {
    /// Jobs of each state, in the order of [`JobStatus::ALL`].
    pub jobs: [(JobStatus, u64); 5],
    /// Number of ended attempts, those at removed jobs included, by kind of end.
    pub attempts: Vec<(String, u64)>,
    /// Length of the database [bytes].
    pub database_bytes: u64,
    /// Time that the oldest waiting job has waited [s]; 0 if none waits.
    pub oldest_waiting_s: f64,
}
