//! Selection and removal of jobs by clients.

use crate::jobs::job::{JobStatus, JobSummary};
use jiff::Timestamp;
use serde_json::value::RawValue;

/// Selection of jobs for a list, newest first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Page {
    /// Only jobs of these states.
    pub statuses: Vec<JobStatus>,
    /// Only jobs with this label.
    pub label: Option<String>,
    /// True if members of studies are wanted, too.
    pub members: bool,
    /// Only jobs accepted at this time or later.
    pub created_from: Option<Timestamp>,
    /// Only jobs accepted at this time or earlier.
    pub created_to: Option<Timestamp>,
    /// Only jobs submitted before the one with this sequence number.
    pub before: Option<i64>,
    /// At most this many.
    pub limit: u32,
    /// True if the outcomes are wanted, too.
    pub outcomes: bool,
}

/// A page of jobs.
#[derive(Debug)]
pub struct JobPage {
    /// The jobs, newest first.
    pub jobs: Vec<ListedJob>,
    /// True if there are more after these.
    pub more: bool,
}

/// A job of a page.
#[derive(Debug)]
pub struct ListedJob {
    /// The job.
    pub summary: JobSummary,
    /// Its outcome, if that is wanted and it has one.
    pub outcome: Option<Box<RawValue>>,
}

/// Size of the outcomes of a page after which it ends, whatever its limit [bytes].
pub(super) const OUTCOME_BYTES: usize = 1 << 20;

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

/// The first whole millisecond that is not before a time.
pub(super) fn milliseconds_from(time: Timestamp) -> i64 {
    let whole = time.as_millisecond();
    match Timestamp::from_millisecond(whole) {
        Ok(start) if start < time => whole + 1,
        _ => whole,
    }
}
