//! Memory of the jobs that run at the same time: one waits until there is room for it, in the order
//! in which they asked, so that small ones do not keep a large one out.

use std::collections::VecDeque;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time between two looks whether a job that waits is to give up.
const LOOK: Duration = Duration::from_millis(100);

/// Memory that jobs share.
#[derive(Debug)]
pub(super) struct MemoryBudget {
    bytes: u64,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    reserved: u64,
    waiting: VecDeque<u64>,
    tickets: u64,
}

/// Memory reserved for a job, until this is dropped.
#[derive(Debug)]
pub(super) struct Reservation {
    budget: Arc<MemoryBudget>,
    bytes: u64,
}

impl MemoryBudget {
    pub(super) fn new(bytes: u64) -> Self {
        Self {
            bytes,
            state: Mutex::default(),
            changed: Condvar::new(),
        }
    }

    /// Reserves memory, once there is as much; `None` if the job gives up first. One that needs
    /// more than there is runs alone.
    pub(super) fn reserve(
        self: &Arc<Self>,
        bytes: u64,
        gives_up: impl Fn() -> bool,
    ) -> Option<Reservation> {
        let bytes = bytes.min(self.bytes);
        let mut state = self.state();
        let ticket = state.tickets;
        state.tickets += 1;
        state.waiting.push_back(ticket);
        loop {
            let next = state.waiting.front() == Some(&ticket);
            let fits = next && bytes <= self.bytes - state.reserved;
            if fits || gives_up() {
                state.waiting.retain(|waiting| *waiting != ticket);
                state.reserved += if fits { bytes } else { 0 };
                self.changed.notify_all();
                return fits.then(|| Reservation {
                    budget: Arc::clone(self),
                    bytes,
                });
            }
            let waited = self.changed.wait_timeout(state, LOOK);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        // Every critical section leaves the state consistent, even if it panics.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Reservation {
    fn drop(&mut self) {
        self.budget.state().reserved -= self.bytes;
        self.budget.changed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::thread;

    fn budget() -> Arc<MemoryBudget> {
        Arc::new(MemoryBudget::new(100))
    }

    fn waits(budget: &Arc<MemoryBudget>, count: usize) {
        while budget.state().waiting.len() < count {
            thread::yield_now();
        }
    }

    #[test]
    fn a_large_job_is_not_kept_out_by_small_ones_that_come_later() {
        let budget = budget();
        let small = budget.reserve(60, || false).unwrap();
        let large = {
            let budget = Arc::clone(&budget);
            thread::spawn(move || budget.reserve(90, || false))
        };
        waits(&budget, 1);
        let later = {
            let budget = Arc::clone(&budget);
            thread::spawn(move || budget.reserve(20, || false))
        };
        waits(&budget, 2);
        // There is room for the later one, but it is not its turn.
        assert_eq!(budget.state().reserved, 60);
        drop(small);
        let large = large.join().unwrap();
        assert_eq!(budget.state().reserved, 90);
        drop(large);
        assert!(later.join().unwrap().is_some());
        assert_eq!(budget.state().reserved, 0);
    }

    #[test]
    fn one_that_gives_up_leaves_its_place() {
        let budget = budget();
        let all = budget.reserve(1000, || false).unwrap();
        assert_eq!(budget.state().reserved, 100);
        let stop = Arc::new(AtomicBool::new(false));
        let waiting = {
            let (budget, stop) = (Arc::clone(&budget), Arc::clone(&stop));
            thread::spawn(move || budget.reserve(10, || stop.load(Ordering::Relaxed)))
        };
        waits(&budget, 1);
        stop.store(true, Ordering::Relaxed);
        assert!(waiting.join().unwrap().is_none());
        drop(all);
        assert!(budget.reserve(100, || false).is_some());
    }
}
