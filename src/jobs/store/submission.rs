//! Submission of jobs: one request, all of its jobs or none.

use super::{FormerRequest, Key, StudySubmitted};
use crate::jobs::submit::NewJob;
use crate::terrains::TerrainHash;

/// Contents of one request.
#[derive(Debug, Clone, Copy)]
pub struct Submission<'a> {
    /// Its jobs, in the order in which they are to run.
    pub jobs: &'a [NewJob],
    /// Name of the access token of the request.
    pub submitter: Option<&'a str>,
    /// Its Idempotency-Key.
    pub key: Option<&'a Key>,
    /// Capacity for jobs that wait.
    pub room: Room,
}

/// Largest number of jobs that may wait, those of the request included; or of studies that may run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Room {
    /// Of all submitters together.
    pub queue: u32,
    /// Of this submitter.
    pub submitter: Option<u32>,
}

/// Result of a submission.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Submitted {
    /// The jobs wait.
    Accepted,
    /// The key came before.
    Before(FormerRequest),
    /// The queue is full: number of waiting jobs.
    QueueFull(u32),
    /// The quota is used up: number of jobs of this submitter that wait or run.
    QuotaSpent(u32),
    /// A job names this terrain, which does not exist, or not any more.
    NoTerrain(TerrainHash),
}

impl Submission<'_> {
    /// Result of the submission while so many jobs wait, if the queue has no room for it.
    pub(super) fn beyond_queue(&self, waiting: i64) -> Option<Submitted> {
        let waiting = count(waiting);
        let is_full = waiting.saturating_add(self.coming()) > self.room.queue;
        is_full.then_some(Submitted::QueueFull(waiting))
    }

    /// Result of the submission while so many jobs of its submitter wait or run, if they have no room
    /// for it.
    pub(super) fn beyond_quota(&self, own: i64) -> Option<Submitted> {
        let own = count(own);
        let quota = self.room.submitter?;
        (own.saturating_add(self.coming()) > quota).then_some(Submitted::QuotaSpent(own))
    }

    fn coming(&self) -> u32 {
        u32::try_from(self.jobs.len()).unwrap_or(u32::MAX)
    }
}

impl Room {
    /// Result of the submission of a study while so many run, of all and of its submitter, if there is
    /// no room for it.
    pub(super) fn beyond_studies(&self, (all, own): (i64, i64)) -> Option<StudySubmitted> {
        let (all, own) = (count(all), count(own));
        if all >= self.queue {
            return Some(StudySubmitted::Full(all));
        }
        let is_spent = self.submitter.is_some_and(|most| own >= most);
        is_spent.then_some(StudySubmitted::QuotaSpent(own))
    }
}

/// A number of rows, as databases count.
fn count(rows: i64) -> u32 {
    u32::try_from(rows).unwrap_or(u32::MAX)
}

/// Origin of a job.
#[derive(Debug, Clone, Copy)]
pub(super) enum Origin {
    /// A request, by its number if it had an Idempotency-Key.
    Request(Option<i64>),
    /// A study, of which it is a member.
    Study,
}

impl Origin {
    pub(super) fn keyed_request(self) -> Option<i64> {
        match self {
            Self::Request(number) => number,
            Self::Study => None,
        }
    }

    /// Jobs of a higher number wait until none of a lower one does.
    pub(super) fn priority(self) -> i64 {
        match self {
            Self::Request(_) => 0,
            Self::Study => 1,
        }
    }
}
