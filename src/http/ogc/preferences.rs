//! The header `Prefer` (RFC 7240): whether a client waits for the results, and how long.

use super::super::jobs::LONGEST_WAIT_S;
use axum::http::HeaderMap;
use std::time::Duration;

/// Preferences of a client that asks for an execution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Preferences {
    /// True if it prefers an answer before the job has ended.
    pub respond_async: bool,
    /// Time for which the answer waits for the job's end.
    pub wait: Duration,
}

impl Preferences {
    /// The preferences of a request; others than the known ones are ignored, as RFC 7240 asks.
    pub(super) fn of(headers: &HeaderMap) -> Self {
        let mut respond_async = false;
        let mut wait_s = None;
        let lists = headers.get_all("prefer").into_iter();
        let lists = lists.filter_map(|list| list.to_str().ok());
        for preference in lists.flat_map(|list| list.split(',')) {
            let preference = preference.split(';').next().unwrap_or_default().trim();
            match preference.split_once('=') {
                None => respond_async |= preference.eq_ignore_ascii_case("respond-async"),
                Some((name, value)) if name.trim().eq_ignore_ascii_case("wait") => {
                    wait_s = wait_s.or(value.trim().parse().ok());
                }
                Some(_) => {}
            }
        }
        let longest_s = if respond_async { 0 } else { LONGEST_WAIT_S };
        let wait_s = wait_s.unwrap_or(longest_s).min(LONGEST_WAIT_S);
        Self {
            respond_async,
            wait: Duration::from_secs(wait_s.into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_preferences_are_read_and_others_ignored() {
        let of = |lines: &[&str]| {
            let lines = lines.iter().map(|line| {
                let name = axum::http::HeaderName::from_static("prefer");
                (name, line.parse().unwrap())
            });
            let read = Preferences::of(&lines.collect());
            (read.respond_async, read.wait.as_secs())
        };
        assert_eq!(of(&[]), (false, 60));
        assert_eq!(of(&["respond-sync"]), (false, 60));
        assert_eq!(of(&["Respond-Async"]), (true, 0));
        assert_eq!(of(&["respond-async, wait=10"]), (true, 10));
        assert_eq!(of(&["return=minimal", "wait = 5;x=y"]), (false, 5));
        assert_eq!(of(&["wait=3, wait=9"]), (false, 3));
        assert_eq!(of(&["wait=1000"]), (false, 60));
        assert_eq!(of(&["wait=soon"]), (false, 60));
    }
}
