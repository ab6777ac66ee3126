//! Creep of a deposit and of the bodies in it: how far they went in the last rest time, and how far
//! that would take them (docs/method.md, equation 63).

use super::motion::Motion;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Places of a deposit and of the bodies at one time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Places {
    pub(super) time_s: f64,
    /// Front and mass centre along the channel [m]; `None` without a flow.
    pub(super) deposit: Option<[f64; 2]>,
    pub(super) bodies: Vec<Motion>,
}

/// Places at the checks for an early stop since nothing but creep has been seen, back to the last
/// one that is a rest time ago.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Creep(VecDeque<Places>);

impl Creep {
    /// Forgets all places: something moves.
    pub(super) fn forget(&mut self) {
        self.0.clear();
    }

    /// Adds the present places; returns the time [s] and the places a rest time ago, if nothing but
    /// creep has been seen for so long.
    pub(super) fn since(&mut self, now: Places, rest_time: f64) -> Option<&Places> {
        let due = now.time_s - rest_time;
        self.0.push_back(now);
        while self.0.get(1).is_some_and(|next| next.time_s <= due) {
            self.0.pop_front();
        }
        self.0.front().filter(|first| first.time_s <= due)
    }
}

impl Places {
    /// Distance that the deposit creeps on in `left` [s] at the mean speed since `before` [m]: that
    /// of its front or of its mass centre, whichever is greater; `None` without a flow.
    pub(super) fn deposit_goes_on(&self, before: &Self, left: f64) -> Option<f64> {
        let (now, then) = (self.deposit?, before.deposit?);
        let way = now.iter().zip(then).map(|(now, then)| (now - then).abs());
        let rate = way.fold(0.0, f64::max) / (self.time_s - before.time_s);
        Some(rate * left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(time_s: f64, front: f64) -> Places {
        Places {
            time_s,
            deposit: Some([front, 0.1]),
            bodies: Vec::new(),
        }
    }

    // A front at 1 mm/s, looked at every 10 ms with a rest time of 25 ms.
    #[test]
    fn creep_is_the_mean_since_a_rest_time_ago() {
        let mut creep = Creep::default();
        for look in 0..10 {
            let time = 0.01 * f64::from(look);
            let now = places(time, 1e-3 * time);
            let before = creep.since(now.clone(), 0.025);
            assert_eq!(before.is_some(), look >= 3, "{look}");
            if let Some(before) = before {
                let way = now.deposit_goes_on(before, 2.0).expect("a flow");
                assert!((way - 2e-3).abs() < 1e-9, "{way}");
                assert!((now.time_s - before.time_s - 0.03).abs() < 1e-9);
            }
        }
        creep.forget();
        assert_eq!(creep.since(places(1.0, 0.0), 0.025), None);
    }
}
