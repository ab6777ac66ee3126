//! Time of day, and time that passes.

use jiff::Timestamp;
use std::fmt::Debug;
use std::time::{Duration, Instant};

/// Source of the time of day, which may jump, and of time that passes, which does not.
pub trait Clock: Debug + Send + Sync {
    /// Now.
    fn now(&self) -> Timestamp;

    /// Time that has passed since some moment of this process; durations are measured by it.
    fn uptime(&self) -> Duration;
}

/// The system's clock.
#[derive(Debug, Clone, Copy)]
pub struct SystemClock {
    started: Instant,
}

impl Default for SystemClock {
    fn default() -> Self {
        Self {
            started: Instant::now(),
        }
    }
}

impl Clock for SystemClock {
    fn now(&self) -> Timestamp {
        Timestamp::now()
    }

    fn uptime(&self) -> Duration {
        self.started.elapsed()
    }
}
