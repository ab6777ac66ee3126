//! Pauses between repetitions of a request.

use std::time::{Duration, Instant};

/// First pause, where the service names none.
const FIRST: Duration = Duration::from_millis(100);

/// Longest pause, where the service names none.
const LONGEST: Duration = Duration::from_secs(5);

/// Pauses from the first failure of a request on: each twice the one before.
#[derive(Debug)]
pub(super) struct Pauses {
    end: Instant,
    next: Duration,
}

impl Pauses {
    /// Pauses from now on, for so long.
    pub(super) fn new(patience: Duration, now: Instant) -> Self {
        Self {
            end: now + patience,
            next: FIRST,
        }
    }

    /// The next pause, or the one that the service asks for; none once it would end too late.
    pub(super) fn next(&mut self, asked: Option<Duration>, now: Instant) -> Option<Duration> {
        let pause = asked.unwrap_or(self.next);
        if asked.is_none() {
            self.next = (2 * self.next).min(LONGEST);
        }
        (now + pause <= self.end).then_some(pause)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pauses_grow_to_their_limit_and_end_with_the_patience() {
        let now = Instant::now();
        let mut pauses = Pauses::new(Duration::from_secs(10), now);
        let millis: Vec<u128> = (0..8)
            .filter_map(|_| pauses.next(None, now))
            .map(|pause| pause.as_millis())
            .collect();
        assert_eq!(millis, [100, 200, 400, 800, 1600, 3200, 5000, 5000]);
        let late = now + Duration::from_secs(6);
        assert_eq!(pauses.next(None, late), None);
    }

    #[test]
    fn a_pause_that_the_service_asks_for_is_kept_unless_it_is_too_long() {
        let now = Instant::now();
        let mut pauses = Pauses::new(Duration::from_secs(10), now);
        let asked = |seconds| Some(Duration::from_secs(seconds));
        assert_eq!(pauses.next(asked(10), now), asked(10));
        assert_eq!(pauses.next(asked(11), now), None);
        assert_eq!(pauses.next(None, now), Some(FIRST));
    }
}
