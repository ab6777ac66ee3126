//! Submission of jobs: one request, all of its jobs or none.

use super::{FormerRequest, Key};
use crate::jobs::submit::NewJob;

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
}
