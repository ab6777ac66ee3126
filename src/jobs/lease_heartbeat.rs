//! Renews the leases of running jobs on a thread of its own, so that busy
//! workers don't lose their jobs. Also reclaims jobs whose lease, held by
//! another service, has run out, and removes jobs after their retention time.

use super::pool::Equipment;
use super::store::{Renewal, StoreError};
use jiff::Timestamp;
use std::io;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::Instant;
use tracing::{error, info, warn};

/// Difference between the clock and the time that passed above which the clock has jumped [s].
const TRUSTED_S: f64 = 60.0;

/// Thread of the heartbeat; it ends once this is dropped.
#[derive(Debug)]
pub(super) struct LeaseHeartbeat {
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl LeaseHeartbeat {
    /// Starts the thread.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub(super) fn start(equipment: Equipment) -> io::Result<Self> {
        let (end, ended) = mpsc::channel();
        let beat = equipment.queue.heartbeat_interval();
        let thread = std::thread::Builder::new()
            .name("keeper".to_owned())
            .spawn(move || {
                let retention = RetentionTask::new();
                // Nothing is ever sent: a closed channel marks the end.
                while ended.recv_timeout(beat) == Err(RecvTimeoutError::Timeout) {
                    renew_leases(&equipment);
                    retention.remove_old(&equipment);
                }
            })?;
        Ok(Self {
            end: Some(end),
            thread: Some(thread),
        })
    }
}

impl Drop for LeaseHeartbeat {
    fn drop(&mut self) {
        drop(self.end.take());
        if self
            .thread
            .take()
            .is_some_and(|thread| thread.join().is_err())
        {
            error!("the keeper's thread had panicked");
        }
    }
}

fn renew_leases(equipment: &Equipment) {
    for run in equipment.registry.runs() {
        let progress = run.board.read();
        let renewed = equipment
            .store
            .renew(run.lease, equipment.queue.lease_duration(), &progress);
        match equipment.runtime.block_on(renewed) {
            Ok(Renewal::Held) => {}
            Ok(renewal) => {
                info!(id = %run.lease.job, ?renewal, "the job is not to go on");
                run.stop.raise();
            }
            Err(error) => warn!(id = %run.lease.job, %error, "a lease can't be renewed now"),
        }
    }
    match reclaim_expired(equipment) {
        Ok(0) => {}
        Ok(count) => {
            warn!(count, "took back jobs whose lease had run out");
            equipment.registry.announce();
        }
        Err(error) => warn!(%error, "leases that ran out can't be looked for now"),
    }
}

/// Removes jobs after their retention time, if the clock can be trusted.
struct RetentionTask {
    began: Instant,
    wall: Timestamp,
}

impl RetentionTask {
    fn new() -> Self {
        Self {
            began: Instant::now(),
            wall: Timestamp::now(),
        }
    }

    /// A clock that jumped must not remove anything: it is unknown which of its
    /// two times was right.
    fn clock_jumped(&self) -> bool {
        let passed = Timestamp::now().duration_since(self.wall).as_secs_f64();
        (passed - self.began.elapsed().as_secs_f64()).abs() > TRUSTED_S
    }

    fn remove_old(&self, equipment: &Equipment) {
        let Some(age) = equipment.retention.ended_jobs() else {
            return;
        };
        if self.clock_jumped() {
            return;
        }
        let age_ms = i64::try_from(age.as_millis()).unwrap_or(i64::MAX);
        match equipment
            .runtime
            .block_on(equipment.store.remove_ended(age_ms))
        {
            Ok(0) => {}
            Ok(count) => info!(count, "removed jobs that ended long ago"),
            Err(error) => warn!(%error, "old jobs can't be removed now"),
        }
    }
}

fn reclaim_expired(equipment: &Equipment) -> Result<usize, StoreError> {
    let queue = &equipment.queue;
    equipment.runtime.block_on(
        equipment
            .store
            .reclaim_expired(&queue.name, queue.lease_duration()),
    )
}
