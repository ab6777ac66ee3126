//! Port between jobs and their database: operations that a driver must implement, and
//! that `tests/conformance.rs` tests.

use super::{
    AttemptStart, Claim, Claimant, Dismissal, Event, FailedAttempt, FormerRequest, JobCounts,
    JobPage, KeptAnswer, Key, KeyRetention, Lease, NewResults, Page, Removal, Renewal, Returned,
    StoreError, StoredChunk, StoredState, Submission, Submitted, TerrainStore,
};
use crate::jobs::failure::Failure;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::results::FlowSnapshot;
use crate::results::columns::{Selection, TrajectoryColumns};
use crate::results::terrain::{MapQuantity, StoredMap};
use crate::runs::Progress;
use async_trait::async_trait;
use std::time::Duration;

type Answer<T> = Result<T, StoreError>;

/// A database of jobs, and of the terrains that they name. Every call is one transaction, applied whole or not at
/// all, and on disk when it returns.
///
/// # Errors
/// Any operation may fail with [`StoreError`], by the kinds of
/// [`StoreErrorKind`](super::StoreErrorKind); one that fails has changed nothing, except that
/// a failed commit may have reached the disk. Operations that read jobs also fail with
/// [`StoreError::Row`] if a row is unreadable, those that read blocks with
/// [`StoreError::Block`] if a block is corrupt.
#[async_trait]
pub trait JobStore: TerrainStore {
    // The queue.

    /// Puts the jobs of a request into the queue, all or none, unless its key came before. Terrains
    /// that they name are kept as long as they are.
    async fn submit(&self, submission: &Submission<'_>) -> Answer<Submitted>;

    /// The first request of this submitter with this key, if there was one.
    async fn former_request(
        &self,
        submitter: Option<&str>,
        key: &Key,
    ) -> Answer<Option<FormerRequest>>;

    /// Keeps the answer to a submitted request with a key, unless one is kept, which is returned
    /// then: of two that are made at the same time only the first counts.
    async fn keep_answer(
        &self,
        submitter: Option<&str>,
        key: &Key,
        answer: &KeptAnswer,
    ) -> Answer<Option<KeptAnswer>>;

    /// The newest successful job with a scenario of this hash, run by this solver (version
    /// and commit).
    async fn finished_like(
        &self,
        scenario_hash: &str,
        solver: (&str, &str),
    ) -> Answer<Option<JobId>>;

    /// Claims the oldest accepted job that need not wait after a failed attempt. A job with
    /// failed attempts waits until the service has been up for its waiting time, so that
    /// a service that keeps crashing sooner does not fail the job.
    ///
    /// Jobs behind it that no worker has had before may come with it, as far as they fit into the
    /// claimant's pack. They begin one after the other, and a lease that runs out before its job
    /// has begun is no failed attempt.
    async fn claim(&self, claimant: &Claimant) -> Answer<Vec<Claim>>;

    /// True if no job waits or runs, and no study runs, which could make more. What runs may come
    /// back into the queue. Jobs that are left to others, who have more memory than this [bytes], do
    /// not count as long as they wait.
    async fn is_idle(&self, memory_bytes: u64) -> Answer<bool>;

    /// Dismisses a job. A worker that runs it notices at its next write or
    /// heartbeat; the caller notifies it sooner.
    async fn dismiss(&self, id: JobId) -> Answer<Dismissal>;

    /// Removes a job that has ended, with all that belongs to it.
    async fn remove(&self, id: JobId) -> Answer<Removal>;

    /// Removes some of the jobs that ended at least this long ago [ms] and returns their
    /// number. To be called until it returns 0.
    ///
    /// Counted is time for which a service had the database open: no jump of the time of day
    /// changes it, and time between a stop and the next start is not in it.
    async fn remove_ended(&self, age_ms: i64) -> Answer<u64>;

    /// Forgets some of the keys that are kept no longer and returns their number. To be called
    /// until it returns 0. A key with a job is kept.
    async fn forget_keys(&self, kept: KeyRetention) -> Answer<u64>;

    // Several processes with one database.

    /// Waits until another process may have put jobs into the queue; for ever if none can.
    async fn wait_for_jobs(&self);

    /// Waits until there may be new events.
    async fn wait_for_events(&self);

    /// True if, of the services that share the database, this one drives studies and tells
    /// webhooks, from now on until it loses its session with the database.
    async fn leads(&self) -> Answer<bool>;

    // Leases. Every write of a worker names its lease.

    /// Renews the lease of a running job from now on, and stores its progress.
    async fn renew(
        &self,
        lease: Lease,
        lease_duration: Duration,
        progress: &Progress,
    ) -> Answer<Renewal>;

    /// Reclaims the jobs that a former process of this name left running when it died.
    /// They may be claimed again at once. Returns their number.
    async fn reclaim_own(&self, owner: &str) -> Answer<usize>;

    /// Reclaims jobs of other processes whose lease has run out, and those of this one that it can't
    /// know of, since the answer to its claim got lost. Returns their number.
    ///
    /// Leases and waits are measured by time that passes, not by the time of day.
    async fn reclaim_expired(&self, owner: &str) -> Answer<usize>;

    // Attempts.

    /// Records the start of an attempt and its number of solver threads, and removes
    /// records that don't fit it. `false`, with nothing changed, if the job no
    /// longer runs under this lease.
    async fn begin(&self, lease: Lease, beginning: &AttemptStart, threads: usize) -> Answer<bool>;

    /// Writes results, progress and state of a job. `false`, with nothing written, if
    /// the job no longer belongs to this lease; a job dismissed meanwhile
    /// still takes the worker's results, but no state.
    async fn keep(&self, lease: Lease, results: &NewResults) -> Answer<bool>;

    /// Ends a running job with its outcome (JSON) and the fingerprint of its
    /// records. `false` if it no longer runs under this lease.
    async fn succeed(&self, lease: Lease, outcome: &str, fingerprint: &str) -> Answer<bool>;

    /// Ends a running job without an answer. `false` if it no longer runs under
    /// this lease.
    async fn fail(&self, lease: Lease, failure: &Failure) -> Answer<bool>;

    /// Releases a running job into the queue, with its saved state, because
    /// the service stops. `false` if it no longer runs under this lease.
    async fn release(&self, lease: Lease) -> Answer<bool>;

    /// Fails an attempt at a running job: the job returns to the queue, to
    /// be claimed again after a wait, or fails after too many such attempts.
    async fn fail_attempt(&self, lease: Lease, failed_attempt: &FailedAttempt) -> Answer<Returned>;

    // Reading of jobs.

    /// The job, if there is one.
    async fn job(&self, id: JobId) -> Answer<Option<Job>>;

    /// The state of a job, if there is one.
    async fn status(&self, id: JobId) -> Answer<Option<JobStatus>>;

    /// A page of jobs, newest first.
    async fn page(&self, page: &Page) -> Answer<JobPage>;

    /// The next events after number `after`, of one job or of all, in order; at most a
    /// hundred.
    async fn events(&self, after: i64, job: Option<JobId>) -> Answer<Vec<Event>>;

    /// Number of the last event ever, even if its job was removed; 0
    /// before the first.
    async fn last_event(&self) -> Answer<i64>;

    /// Number of the last event that this webhook's receiver has been told; `None` if it has never
    /// been told any.
    async fn webhook_position(&self, name: &str) -> Answer<Option<i64>>;

    /// Notes the number of the last event that this webhook's receiver has been told.
    async fn note_webhook_position(&self, name: &str, position: i64) -> Answer<()>;

    /// Number of jobs that run, in all processes.
    async fn running_jobs(&self) -> Answer<u64>;

    /// Counts jobs.
    async fn count_jobs(&self) -> Answer<JobCounts>;

    // Reading of records.

    /// Size of a job's results, without the chunks that still grow [bytes].
    async fn results_bytes(&self, job: JobId) -> Answer<u64>;

    /// The saved state of a job, if there is one.
    async fn state(&self, job: JobId) -> Answer<Option<StoredState>>;

    /// The first chunk of a body's trajectory from sample `from_sample` on that
    /// overlaps the selected range. One short query per chunk: no read
    /// transaction outlives it, however slowly the client reads the answer.
    async fn chunk(
        &self,
        job: JobId,
        body: usize,
        from_sample: i64,
        selection: &Selection,
    ) -> Answer<Option<StoredChunk>>;

    /// The last chunk of a body's trajectory, and the index of its first sample.
    async fn last_chunk(
        &self,
        job: JobId,
        body: usize,
    ) -> Answer<Option<(usize, TrajectoryColumns)>>;

    /// Number of samples of a body's trajectory.
    async fn samples(&self, job: JobId, body: usize) -> Answer<usize>;

    /// The times of all snapshots so far [s], ascending.
    async fn snapshot_times(&self, job: JobId) -> Answer<Vec<f64>>;

    /// The snapshot nearest to a time, the earlier of two equally near; without
    /// a time the latest. `None` if there is none yet.
    async fn snapshot(&self, job: JobId, time_s: Option<f64>) -> Answer<Option<FlowSnapshot>>;

    /// The quantities of which a job has maps of its flow.
    async fn flow_maps(&self, job: JobId) -> Answer<Vec<MapQuantity>>;

    /// The map of a quantity, if the job has it.
    async fn flow_map(&self, job: JobId, quantity: MapQuantity) -> Answer<Option<StoredMap>>;

    // Health.

    /// Checks that the database answers. Fails if it does not.
    async fn ping(&self) -> Answer<()>;

    /// Checks with a real write that a job could be stored: allocates space for one, and
    /// writes to the disk. Fails if a job could not be stored.
    async fn probe(&self) -> Answer<()>;

    /// Upkeep, to be done at each heartbeat: notes the time that has passed, fails if what is
    /// written would be lost, and gives space of removed jobs back to the system, a little at
    /// a time.
    async fn maintain(&self) -> Answer<()>;

    /// Closes the database. All that was acknowledged is in it; no operation succeeds
    /// afterwards.
    async fn close(&self);
}
