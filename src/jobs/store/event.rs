//! Changes of state, as clients follow them.

use crate::jobs::job::{JobId, JobStatus};

/// Largest number of events read at once.
pub const EVENTS_AT_ONCE: u32 = 100;

/// Change of a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// It is in this state now.
    Status(JobStatus),
    /// It was removed. Of its events only this one is left.
    Removed,
}

/// Event: a change of a job, numbered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event {
    /// Sequence number of the event.
    pub sequence: i64,
    /// The job.
    pub job: JobId,
    /// Change of the job.
    pub change: Change,
    /// Number of attempts by then.
    pub attempt: u32,
}

impl Change {
    const REMOVED: &'static str = "removed";

    /// The change that a database calls this.
    pub(super) fn from_word(word: &str) -> Option<Self> {
        if word == Self::REMOVED {
            return Some(Self::Removed);
        }
        JobStatus::from_word(word).map(Self::Status)
    }

    /// True if nothing follows about the job but its removal.
    pub fn is_final(self) -> bool {
        match self {
            Self::Status(status) => status.is_final(),
            Self::Removed => true,
        }
    }
}
