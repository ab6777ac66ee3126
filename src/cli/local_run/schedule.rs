//! When the state of a run is saved.

use std::time::{Duration, Instant};

/// Time until the first state.
const FIRST: Duration = Duration::from_secs(1);

/// Longest pause between two states: the most that a crash loses, apart from slow disks.
const LONGEST: Duration = Duration::from_secs(60);

/// Saving takes at most one in this many parts of the time.
const SHARE: u32 = 50;

/// Schedule of saved states. The pause grows with the run, so that a crash loses at most half of
/// it and at most [`LONGEST`].
#[derive(Debug)]
pub(super) struct Schedule {
    began: Instant,
    asked: Instant,
    due: Instant,
}

impl Schedule {
    /// The schedule of a run that begins now.
    pub(super) fn new() -> Self {
        let now = Instant::now();
        Self {
            began: now,
            asked: now,
            due: now + FIRST,
        }
    }

    /// True if a state is due.
    pub(super) fn is_due(&mut self) -> bool {
        self.asked = Instant::now();
        self.asked >= self.due
    }

    /// Sets the time of the next state, after one has been saved.
    pub(super) fn saved(&mut self) {
        let now = Instant::now();
        self.due = now + pause(now - self.began, now - self.asked);
    }
}

/// Pause after a state of this age of the run, whose saving took `cost`.
fn pause(age: Duration, cost: Duration) -> Duration {
    age.clamp(FIRST, LONGEST).max(cost * SHARE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_grow_with_the_run_and_with_the_cost() {
        let seconds = Duration::from_secs;
        assert_eq!(pause(seconds(0), seconds(0)), FIRST);
        assert_eq!(pause(seconds(8), seconds(0)), seconds(8));
        assert_eq!(pause(seconds(3600), seconds(0)), LONGEST);
        assert_eq!(pause(seconds(3600), seconds(2)), seconds(100));
    }
}
