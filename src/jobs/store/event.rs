//! Changes of state, as clients follow them.

use crate::jobs::job::{JobId, JobStatus};

/// Largest number of events read at once.
pub(super) const EVENTS_AT_ONCE: u32 = 100;

/// Change of a job's state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// Sequence number of the event.
    pub sequence: i64,
    /// The job.
    pub job: JobId,
    /// New state of the job.
    pub status: JobStatus,
    /// Number of attempts by then.
    pub attempt: u32,
}
