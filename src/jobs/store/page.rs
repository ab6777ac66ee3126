//! Selection and removal of jobs by clients.

use crate::jobs::job::JobStatus;

/// Selection of jobs for a list, newest first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// Only jobs of this state.
    pub status: Option<JobStatus>,
    /// Only jobs with this label.
    pub label: Option<String>,
    /// Only jobs submitted before the one with this sequence number.
    pub before: Option<i64>,
    /// At most this many.
    pub limit: u32,
}

/// Largest number of jobs removed at once: a long list must not delay submissions.
pub(super) const REMOVED_AT_ONCE: u32 = 20;

/// Result of a request to remove a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Removal {
    /// The job does not exist.
    Unknown,
    /// The job is removed, with its results.
    Removed,
    /// The job has not ended.
    Active,
}
