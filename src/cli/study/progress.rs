//! Progress of a study for people.

use crate::cli::arguments::Quiet;
use std::time::{Duration, Instant};

/// Time between two notes on progress.
const NOTE_PAUSE: Duration = Duration::from_secs(5);

/// Notes on how many members have ended, and how long the others take.
pub(in crate::cli) struct MemberNotes {
    quiet: Quiet,
    began: (Instant, u64),
    noted: Instant,
}

impl MemberNotes {
    /// Notes from now on, when so many members have ended.
    pub(in crate::cli) fn new(quiet: Quiet, done: u64) -> Self {
        let now = Instant::now();
        Self {
            quiet,
            began: (now, done),
            noted: now,
        }
    }

    /// Notes that so many of all members have ended, if a note is due.
    pub(in crate::cli) fn show(&mut self, done: u64, all: u64) {
        if self.noted.elapsed() < NOTE_PAUSE {
            return;
        }
        self.noted = Instant::now();
        let (began, before) = self.began;
        let pace = began.elapsed().as_secs_f64() / done.saturating_sub(before).max(1) as f64;
        let to_go = (pace * all.saturating_sub(done) as f64).ceil();
        let (minutes, seconds) = ((to_go / 60.0) as u64, (to_go % 60.0) as u64);
        self.quiet.note(&format!(
            "{done} of {all} members, {minutes}:{seconds:02} min to go"
        ));
    }
}
