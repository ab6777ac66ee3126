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
    /// Mass that has left through the open end [kg].
    pub(super) outflow: f64,
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

    /// Adds the present places; returns the time since the first of those of the last `rest_time`
    /// [s], if nothing but creep has been seen for so long.
    pub(super) fn add(&mut self, now: Places, rest_time: f64) -> Option<f64> {
        let time_s = now.time_s;
        let due = time_s - rest_time;
        self.0.push_back(now);
        while self.0.get(1).is_some_and(|next| next.time_s <= due) {
            self.0.pop_front();
        }
        let first = self.0.front()?.time_s;
        (first <= due).then_some(time_s - first)
    }

    /// Largest distance between two places of the deposit's front, or of its mass centre if that is
    /// greater [m]; `None` without a flow. What trembles or turns back has come nowhere since the
    /// first of its places.
    pub(super) fn deposit_range(&self) -> Option<f64> {
        let places = || self.0.iter().filter_map(|places| places.deposit);
        let range = |of: usize| {
            let least = places().map(|deposit| deposit[of]).reduce(f64::min)?;
            let most = places().map(|deposit| deposit[of]).reduce(f64::max)?;
            Some(most - least)
        };
        Some(range(0)?.max(range(1)?))
    }

    /// Mass that left through the open end [kg].
    pub(super) fn outflow(&self) -> f64 {
        let ends = self.0.front().zip(self.0.back());
        ends.map_or(0.0, |(first, last)| last.outflow - first.outflow)
    }

    /// Largest distance between two places of a body [m].
    pub(super) fn body_range(
        &self,
        body: usize,
        distance: impl Fn(&Motion, &Motion) -> f64,
    ) -> f64 {
        let pairs = self.0.iter().enumerate().flat_map(|(later, one)| {
            let earlier = self.0.iter().take(later);
            earlier.map(|other| (&one.bodies[body], &other.bodies[body]))
        });
        let ways = pairs.map(|(one, other)| distance(one, other));
        ways.fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(time_s: f64, front: f64) -> Places {
        Places {
            time_s,
            deposit: Some([front, 0.1]),
            outflow: 2.0 * time_s,
            bodies: Vec::new(),
        }
    }

    // A front at 1 mm/s, looked at every 10 ms with a rest time of 25 ms.
    #[test]
    fn creep_is_the_range_of_places_since_a_rest_time_ago() {
        let mut creep = Creep::default();
        for look in 0..10 {
            let time = 0.01 * f64::from(look);
            let lasted = creep.add(places(time, 1e-3 * time), 0.025);
            assert_eq!(lasted.is_some(), look >= 3, "{look}");
            if let Some(lasted) = lasted {
                let way = creep.deposit_range().expect("a flow");
                assert!((way - 3e-5).abs() < 1e-9, "{way}");
                assert!((lasted - 0.03).abs() < 1e-9);
                assert!((creep.outflow() - 0.06).abs() < 1e-9);
            }
        }
        creep.forget();
        assert_eq!(creep.add(places(1.0, 0.0), 0.025), None);
    }

    // Back at its first place after a rest time.
    #[test]
    fn a_front_that_turns_back_has_crept() {
        let mut creep = Creep::default();
        for (time, front) in [(0.0, 0.0), (0.1, -1e-4), (0.2, -2e-4), (0.3, 0.0)] {
            creep.add(places(time, front), 0.3);
        }
        assert_eq!(creep.deposit_range(), Some(2e-4));
    }
}
