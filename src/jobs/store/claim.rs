//! Claims of jobs, the leases they give, and how others end them.

use crate::jobs::job::{JobId, JobStatus};
use std::time::Duration;

/// Time after the end of its lease for which a process leaves a job of its own to itself [ms]. By
/// then it has renewed what it knows of: it is one whose claim got lost on the way.
pub(super) const LOST_CLAIM_MS: i64 = 60_000;

/// Claimant of jobs, and the terms of its claims.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claimant {
    /// Name of the service; its next start reclaims at once the jobs it left running.
    pub owner: String,
    /// Duration of a lease unless it is renewed.
    pub lease_duration: Duration,
    /// Program that runs the jobs.
    pub solver: Solver,
    /// Uptime of the service.
    pub up_for: Duration,
    /// Largest pack.
    pub pack: Pack,
    /// Memory that one of its jobs may have [bytes]: what is planned to need more is left to others,
    /// if there can be any.
    pub memory_bytes: u64,
}

/// Size of a pack: jobs that are claimed at once, since each would take less time than its claim is
/// worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pack {
    /// Number of jobs.
    pub jobs: u32,
    /// Their planned work together [point-steps]; the first may have more.
    pub work: u64,
}

impl Pack {
    /// One job, whatever its work.
    pub const SINGLE: Self = Self { jobs: 1, work: 0 };
}

/// The program that runs a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Solver {
    /// Version of the solver.
    pub version: &'static str,
    /// Commit the program was built from.
    pub commit: &'static str,
    /// Instruction set of its kernels.
    pub instructions: &'static str,
}

/// A job that a worker has just claimed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The worker's lease.
    pub lease: Lease,
    /// The scenario's JSON.
    pub scenario: String,
    /// Failed attempts in a row before this attempt.
    pub failed_attempts: u32,
    /// Work that the plan foresees [point-steps]; 0 if the driver does not keep it.
    pub planned_work: u64,
}

/// Lease of one worker on a job: every write by the worker names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lease {
    /// The job.
    pub job: JobId,
    /// Number of the attempt.
    pub attempt: u32,
    /// Fencing token: valid until the job gets another lease.
    pub token: i64,
}

/// Answer to a heartbeat.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Renewal {
    /// The lease is renewed.
    Held,
    /// A client dismissed the job.
    Dismissed,
    /// The job has another lease, or has ended.
    Lost,
}

/// Result of a request to dismiss a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dismissal {
    /// The job does not exist.
    Unknown,
    /// The job is dismissed, by this or an earlier request.
    Dismissed,
    /// The job had already ended in this state.
    Ended(JobStatus),
}
