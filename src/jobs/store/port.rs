//! Port between jobs and their database: operations that a driver must implement, and
//! that `tests/conformance.rs` tests.

use super::{
    AttemptStart, Claim, Claimant, Dismissal, Event, FailedAttempt, JobCounts, Lease, NewResults,
    Page, Removal, Renewal, Returned, Store, StoreError, StoredChunk, StoredState, Submission,
    Submitted,
};
use crate::jobs::failure::Failure;
use crate::jobs::job::{Job, JobId, JobStatus, JobSummary};
use crate::jobs::progress::Progress;
use crate::results::FlowSnapshot;
use crate::results::columns::{Selection, TrajectoryColumns};
use std::time::Duration;

type Answer<T> = Result<T, StoreError>;

macro_rules! port {
    ($($(#[$doc:meta])* fn $name:ident($($argument:ident: $kind:ty),*) -> $answer:ty;)*) => {
        /// A database of jobs. Every call is one transaction, applied whole or not at
        /// all, and on disk when it returns.
        pub trait JobStore: Clone + Send + Sync + 'static {
            $($(#[$doc])* fn $name(&self, $($argument: $kind),*) -> impl Future<Output = Answer<$answer>> + Send;)*
        }

        impl JobStore for Store {
            $(async fn $name(&self, $($argument: $kind),*) -> Answer<$answer> {
                Store::$name(self, $($argument),*).await
            })*
        }
    };
}

port! {
    /// Puts the jobs of a request into the queue, all or none.
    fn submit(submission: &Submission<'_>) -> Submitted;
    /// The newest successful job with a scenario, by version and commit.
    fn finished_like(scenario_hash: &str, solver: (&str, &str)) -> Option<JobId>;
    /// Claims the oldest accepted job that need not wait.
    fn claim(claimant: &Claimant) -> Option<Claim>;
    /// Records the start of an attempt.
    fn begin(lease: Lease, beginning: &AttemptStart, threads: usize) -> bool;
    /// Renews a lease and stores the progress.
    fn renew(lease: Lease, lease_duration: Duration, progress: &Progress) -> Renewal;
    /// Writes results, progress and state.
    fn keep(lease: Lease, results: &NewResults) -> bool;
    /// Ends a job with its outcome.
    fn succeed(lease: Lease, outcome: &str, fingerprint: &str) -> bool;
    /// Ends a job without an answer.
    fn fail(lease: Lease, failure: &Failure) -> bool;
    /// Releases a job because the service stops.
    fn release(lease: Lease) -> bool;
    /// Fails an attempt.
    fn fail_attempt(lease: Lease, failed_attempt: &FailedAttempt) -> Returned;
    /// Reclaims the jobs that a former process of this name left running.
    fn reclaim_own(owner: &str) -> usize;
    /// Reclaims jobs of other services whose lease has run out.
    fn reclaim_expired(owner: &str, longest: Duration) -> usize;
    /// Dismisses a job.
    fn dismiss(id: JobId) -> Dismissal;
    /// Removes a job that has ended.
    fn remove(id: JobId) -> Removal;
    /// Removes some of the jobs that ended at least this long ago [ms].
    fn remove_ended(age_ms: i64) -> u64;
    /// The state of a job, if there is one.
    fn status(id: JobId) -> Option<JobStatus>;
    /// The next events after a number.
    fn events(after: i64, job: Option<JobId>) -> Vec<Event>;
    /// Number of the last event ever.
    fn last_event() -> i64;
    /// Counts jobs.
    fn count_jobs() -> JobCounts;
    /// The job, if there is one.
    fn job(id: JobId) -> Option<Job>;
    /// A page of jobs.
    fn page(page: &Page) -> Vec<JobSummary>;
    /// The saved state of a job.
    fn state(job: JobId) -> Option<StoredState>;
    /// The first chunk from a sample on that overlaps a range.
    fn chunk(job: JobId, body: usize, from_sample: i64, selection: &Selection) -> Option<StoredChunk>;
    /// Number of samples of a body's trajectory.
    fn samples(job: JobId, body: usize) -> usize;
    /// The times of all snapshots so far [s].
    fn snapshot_times(job: JobId) -> Vec<f64>;
    /// The last chunk of a body's trajectory.
    fn last_chunk(job: JobId, body: usize) -> Option<(usize, TrajectoryColumns)>;
    /// The snapshot nearest to a time.
    fn snapshot(job: JobId, time_s: Option<f64>) -> Option<FlowSnapshot>;
}
