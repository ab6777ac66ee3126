//! Keeps the leases of running jobs, on a thread of its own: however busy the
//! workers are, their jobs stay theirs. Also takes back jobs whose lease, with
//! another service, has run out.

use super::pool::Equipment;
use super::store::{Renewal, StoreError};
use std::io;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use tracing::{error, info, warn};

/// The keeper's thread; it ends once this is dropped.
#[derive(Debug)]
pub(super) struct Keeper {
    end: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl Keeper {
    /// Starts the keeper.
    ///
    /// # Errors
    /// The system refuses a thread.
    pub(super) fn start(equipment: Equipment) -> io::Result<Self> {
        let (end, ended) = mpsc::channel();
        let beat = equipment.queue.heartbeat_interval();
        let thread = std::thread::Builder::new()
            .name("keeper".to_owned())
            .spawn(move || {
                // Nothing is ever sent: the end is a closed channel.
                while ended.recv_timeout(beat) == Err(RecvTimeoutError::Timeout) {
                    beat_once(&equipment);
                }
            })?;
        Ok(Self {
            end: Some(end),
            thread: Some(thread),
        })
    }
}

impl Drop for Keeper {
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

fn beat_once(equipment: &Equipment) {
    for run in equipment.bench.runs() {
        let progress = run.board.read();
        let renewed = equipment
            .store
            .renew(run.hold, equipment.queue.lease(), &progress);
        match equipment.runtime.block_on(renewed) {
            Ok(Renewal::Held) => {}
            Ok(renewal) => {
                info!(id = %run.hold.job, ?renewal, "the job is not to go on");
                run.stop.raise();
            }
            Err(error) => warn!(id = %run.hold.job, %error, "a lease can't be renewed now"),
        }
    }
    match take_back(equipment) {
        Ok(0) => {}
        Ok(count) => {
            warn!(count, "took back jobs whose lease had run out");
            equipment.bench.announce();
        }
        Err(error) => warn!(%error, "leases that ran out can't be looked for now"),
    }
}

fn take_back(equipment: &Equipment) -> Result<usize, StoreError> {
    let queue = &equipment.queue;
    equipment.runtime.block_on(
        equipment
            .store
            .take_back_expired(&queue.name, queue.lease()),
    )
}
