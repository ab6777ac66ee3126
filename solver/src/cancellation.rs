//! Request to give a run up within a sub-step.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Request to give a run up, shared with those who may make it. It is never withdrawn.
///
/// A sub-step may take many seconds (bodies in contact divide it into thousands of their own), so
/// the run looks for the request within it. What it leaves behind is no state of the scene: it can
/// neither be saved nor run on.
#[derive(Debug, Clone, Default)]
pub struct Cancellation(Arc<AtomicBool>);

impl Cancellation {
    /// Makes the request.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// True once the request is made.
    pub fn is_asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
