//! Time of day.

use jiff::Timestamp;
use std::fmt::Debug;

/// Source of the time of day, which may jump: durations within the process are
/// measured otherwise.
pub trait Clock: Debug + Send + Sync {
    /// Now.
    fn now(&self) -> Timestamp;
}

/// The system's clock.
#[derive(Debug, Clone, Copy, Default)]
pub struct SystemClock;

impl Clock for SystemClock {
    fn now(&self) -> Timestamp {
        Timestamp::now()
    }
}
