//! Renews the leases of running jobs on a thread of its own, so that busy
//! workers don't lose their jobs. Also reclaims jobs whose lease, held by
//! another service, has run out, removes jobs after their retention time, and does the
//! upkeep of the store.

use super::pool::Equipment;
use super::store::{KeyRetention, Renewal, StoreError};
use crate::config::Retention;
use std::io;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};
use tracing::{error, info, warn};

/// Most transactions at a heartbeat in which keys are forgotten: leases and the end of the service
/// don't wait for a long list.
const ROUNDS_OF_FORGETTING: usize = 20;

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
                let mut upkeep = Upkeep::default();
                let mut outage = Outage::default();
                // Nothing is ever sent: a closed channel marks the end.
                while ended.recv_timeout(beat) == Err(RecvTimeoutError::Timeout) {
                    equipment.reclaim_former_jobs();
                    renew_leases(&equipment, &mut outage);
                    remove_old(&equipment);
                    upkeep.perform(&equipment);
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

/// Time without the database.
#[derive(Debug, Default)]
struct Outage {
    last_seen: Option<Instant>,
}

impl Outage {
    fn note(&mut self) {
        self.last_seen = Some(Instant::now());
    }

    /// True if others may not have been able to renew their leases since: those look as if they had
    /// run out, and are left for as long as a lease lasts.
    fn is_recent(&self, lease: Duration) -> bool {
        self.last_seen.is_some_and(|seen| seen.elapsed() < lease)
    }
}

fn renew_leases(equipment: &Equipment, outage: &mut Outage) {
    for run in equipment.registry.runs() {
        let progress = run.board.read();
        let renewed = equipment
            .store
            .renew(run.lease, equipment.queue.lease_duration(), &progress);
        match equipment.runtime.block_on(renewed) {
            Ok(Renewal::Held) => {}
            Ok(renewal) => {
                info!(id = %run.lease.job, ?renewal, "the job is not to go on");
                run.control.raise();
            }
            Err(error) => {
                warn!(id = %run.lease.job, %error, "a lease can't be renewed now");
                outage.note();
            }
        }
    }
    if outage.is_recent(equipment.queue.lease_duration()) {
        // Without the database this fails, and the outage goes on.
        if equipment.runtime.block_on(equipment.store.ping()).is_err() {
            outage.note();
        }
        return;
    }
    match reclaim_expired(equipment) {
        Ok(0) => {}
        Ok(count) => {
            warn!(count, "took back jobs whose lease had run out");
            equipment.registry.announce();
        }
        Err(error) => {
            warn!(%error, "leases that ran out can't be looked for now");
            outage.note();
        }
    }
}

/// Removes jobs after their retention time.
fn remove_old(equipment: &Equipment) {
    let retention = equipment.retention.as_ref();
    let Some(age) = retention.and_then(Retention::ended_jobs) else {
        return;
    };
    let age_ms = milliseconds(age);
    match equipment
        .runtime
        .block_on(equipment.store.remove_ended(age_ms))
    {
        Ok(0) => {}
        Ok(count) => info!(count, "removed jobs that ended long ago"),
        Err(error) => warn!(%error, "old jobs can't be removed now"),
    }
}

/// Forgets the keys that have outlived their jobs for long, or in too large a number.
async fn forget_keys(equipment: &Equipment) -> Result<(), StoreError> {
    let Some(retention) = &equipment.retention else {
        return Ok(());
    };
    let kept = KeyRetention {
        age_ms: milliseconds(retention.keys()),
        bytes: retention.keys_bytes,
    };
    for _ in 0..ROUNDS_OF_FORGETTING {
        if equipment.store.forget_keys(kept).await? == 0 {
            break;
        }
    }
    Ok(())
}

fn milliseconds(time: Duration) -> i64 {
    i64::try_from(time.as_millis()).unwrap_or(i64::MAX)
}

/// Upkeep of the store; the log has the beginning and the end of a time without it.
#[derive(Debug, Default)]
struct Upkeep {
    failing: bool,
}

impl Upkeep {
    fn perform(&mut self, equipment: &Equipment) {
        let maintained = equipment.runtime.block_on(async {
            forget_keys(equipment).await?;
            equipment.store.maintain().await
        });
        match &maintained {
            Ok(()) if self.failing => info!("the database can be written again"),
            Err(error) if !self.failing => error!(%error, "the database can't be written"),
            Ok(()) | Err(_) => {}
        }
        self.failing = maintained.is_err();
    }
}

fn reclaim_expired(equipment: &Equipment) -> Result<usize, StoreError> {
    let expired = equipment.store.reclaim_expired(&equipment.name);
    equipment.runtime.block_on(expired)
}
