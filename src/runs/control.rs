//! Requests from outside to a run while it goes on.

use scree_solver::Cancellation;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Point at which a run is to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stop {
    /// At the end of the scenario.
    AtTheEnd,
    /// Once its state is saved, at the end of the current step.
    OnceSaved,
    /// Within the current sub-step, whose records are lost.
    AtOnce,
}

/// Requests to a run: to stop, which is never withdrawn, and to take so many threads.
#[derive(Debug, Default)]
pub struct RunControl {
    once_saved: AtomicBool,
    /// 0 for as many as it has.
    threads: AtomicUsize,
    /// 0 for any number.
    most_threads: AtomicUsize,
    /// Asked for a stop at once: the solver looks for it within a sub-step.
    at_once: Cancellation,
}

impl RunControl {
    /// Asks for a stop at once.
    pub fn raise(&self) {
        self.ask(Stop::AtOnce);
    }

    /// Asks for a stop; the earlier of two requests counts.
    pub fn ask(&self, stop: Stop) {
        match stop {
            Stop::AtTheEnd => {}
            Stop::OnceSaved => self.once_saved.store(true, Ordering::Relaxed),
            Stop::AtOnce => self.at_once.ask(),
        }
    }

    /// The request for a stop at once, for the solver.
    pub(super) fn cancellation(&self) -> Cancellation {
        self.at_once.clone()
    }

    /// The stop asked for.
    pub fn asked(&self) -> Stop {
        if self.at_once.is_asked() {
            Stop::AtOnce
        } else if self.once_saved.load(Ordering::Relaxed) {
            Stop::OnceSaved
        } else {
            Stop::AtTheEnd
        }
    }

    /// True if a stop was asked for.
    pub fn is_raised(&self) -> bool {
        self.asked() > Stop::AtTheEnd
    }

    /// Asks for this number of solver threads from the end of the current step on; the results
    /// do not depend on it.
    pub fn ask_for_threads(&self, threads: usize) {
        self.threads.store(threads, Ordering::Relaxed);
    }

    /// Sets the largest number of solver threads, whatever is asked for.
    pub fn limit_threads(&self, most: usize) {
        self.most_threads.store(most, Ordering::Relaxed);
    }

    /// The number of solver threads to take, if any was asked for.
    pub fn threads(&self) -> Option<usize> {
        let asked = self.threads.load(Ordering::Relaxed);
        let most = self.most_threads.load(Ordering::Relaxed);
        let threads = if most > 0 { asked.min(most) } else { asked };
        (threads > 0).then_some(threads)
    }
}
