//! Time at which a body comes to rest.

use super::motion::Motion;
use super::scale::Scale;
use serde::{Deserialize, Serialize};

/// Criterion of a body's rest by its place. Speed alone is not sufficient: a body that trembles
/// on its contacts is fast and goes nowhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Settling {
    /// Motion and time [s] when it last left its place.
    place: Motion,
    came: f64,
    /// Time at which it stopped, if it stays in this place [s].
    stopped: Option<f64>,
    /// Time since which it has been slow without a break [s].
    slow_since: Option<f64>,
    /// Time since which it has been at rest [s].
    rests_since: Option<f64>,
    /// True if it was ever not at rest.
    moved: bool,
}

/// Measures for a body's rest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    pub(super) scale: Scale,
    /// Bounding radius of the body [m].
    pub(super) radius: f64,
}

impl Measure {
    /// True if no place of a body with this motion is faster than one at rest.
    pub(super) fn is_slow(&self, motion: &Motion) -> bool {
        let turning = motion.angular_velocity.norm() * self.radius;
        motion.velocity.norm() + turning < self.scale.rest_speed()
    }

    /// Distance of a body from its place, turning included [m].
    pub(super) fn distance(&self, place: &Motion, motion: &Motion) -> f64 {
        let turned = place.orientation.angle_to(&motion.orientation) * self.radius;
        (motion.position - place.position).norm() + turned
    }

    /// True if a body has left its place.
    fn has_left(&self, place: &Motion, motion: &Motion) -> bool {
        self.distance(place, motion) > self.scale.rest_distance()
    }

    /// True if a body came so far from its place in `time` [s] that it was not at rest.
    fn travelled(&self, place: &Motion, motion: &Motion, time: f64) -> bool {
        self.distance(place, motion) >= self.scale.rest_speed() * time
    }
}

impl Settling {
    /// State at the start of a run.
    pub(super) fn start(motion: &Motion, measure: &Measure) -> Self {
        let slow = measure.is_slow(motion).then_some(0.0);
        Self {
            place: *motion,
            came: 0.0,
            stopped: slow,
            slow_since: slow,
            rests_since: slow,
            moved: slow.is_none(),
        }
    }

    /// Adds the motion of the body at the end of a sub-step.
    pub(super) fn take_in(&mut self, motion: &Motion, measure: &Measure, time_s: f64) {
        let stayed = time_s - self.came;
        if measure.is_slow(motion) {
            self.slow_since.get_or_insert(time_s);
            // A trembling body is slow at its turning points, and stopped when it came.
            let travelled = measure.travelled(&self.place, motion, stayed);
            let stopped = if travelled { time_s } else { self.came };
            self.stopped.get_or_insert(stopped);
        } else {
            self.slow_since = None;
        }
        let long = stayed >= measure.scale.rest_time();
        if measure.has_left(&self.place, motion) {
            // A body that takes so long to leave its place creeps, and counts as at rest.
            if !long {
                self.rests_since = None;
                self.moved = true;
            }
            (self.place, self.came) = (*motion, time_s);
            self.stopped = self.slow_since.map(|_| time_s);
        } else if long && self.rests_since.is_none() {
            self.rests_since = Some(self.stopped.unwrap_or(self.came));
        }
    }

    /// True if it is at rest.
    pub(super) fn rests(&self) -> bool {
        self.rests_since.is_some()
    }

    /// True if it has been at rest for the rest time.
    pub(super) fn rests_long(&self, measure: &Measure, time_s: f64) -> bool {
        let long = |since: f64| time_s - since >= measure.scale.rest_time();
        self.rests_since.is_some_and(long)
    }

    /// True if it was ever not at rest.
    pub(super) fn moved(&self) -> bool {
        self.moved
    }

    /// Time at which it came to rest [s], the end being now; `None` if it moves, or never did.
    pub(super) fn stop_time(&self) -> Option<f64> {
        self.rests_since.or(self.slow_since).filter(|_| self.moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::rigid::fixture::cuboid;
    use std::f64::consts::TAU;

    /// A cube with this motion along x, every tenth of a millisecond to the end.
    fn watched(end: f64, place_and_speed: impl Fn(f64) -> (f64, f64)) -> Settling {
        let body = cuboid([0.04; 3]);
        let measure = Measure {
            scale: Scale::of_body(&body, 9.81),
            radius: body.shape.bounding_radius(),
        };
        let at = |time: f64| {
            let (x, speed) = place_and_speed(time);
            Motion {
                position: Vec3::x() * x,
                velocity: Vec3::x() * speed,
                ..Motion::of(&body)
            }
        };
        let mut settling = Settling::start(&at(0.0), &measure);
        for step in 1..=(end * 1e4) as u32 {
            let time = f64::from(step) * 1e-4;
            settling.take_in(&at(time), &measure, time);
        }
        settling
    }

    /// Slides at 0.4 m/s, slowed by 4 m/s², until 0.1 s.
    fn slide(time: f64) -> (f64, f64) {
        let left = (0.1 - time).max(0.0);
        (0.02 - 2.0 * left * left, 4.0 * left)
    }

    // The speed is 1 mm/s a quarter of a millisecond before it stands.
    #[test]
    fn what_slides_to_rest_has_stopped_when_it_stands() {
        let stop = watched(0.5, slide).stop_time().expect("it stands");
        assert!((stop - 0.1).abs() < 4e-4, "{stop}");
        // For a long or a short time, it is slow to the end.
        let stop = watched(0.12, slide).stop_time().expect("it stands");
        assert!((stop - 0.1).abs() < 4e-4, "{stop}");
        assert_eq!(watched(0.05, slide).stop_time(), None);
    }

    // 20 µm at 200 Hz are 25 mm/s.
    #[test]
    fn trembling_is_rest() {
        let trembling = |time: f64| {
            let (x, speed) = slide(time);
            let phase = TAU * 200.0 * time;
            (
                x + 2e-5 * phase.sin(),
                speed + 2e-5 * TAU * 200.0 * phase.cos(),
            )
        };
        let settling = watched(1.0, trembling);
        let stop = settling.stop_time().expect("it goes nowhere");
        assert!((stop - 0.1).abs() < 0.01, "{stop}");
        assert!(settling.rests());
        // It never moved if it only ever trembled.
        let never = |time: f64| (2e-5 * (TAU * 200.0 * time).cos(), 0.0);
        assert_eq!(watched(1.0, never).stop_time(), None);
        assert!(!watched(1.0, never).moved());
    }

    // Half a millimetre a second.
    #[test]
    fn creeping_is_rest_and_a_pause_is_none() {
        let creeping = |time: f64| {
            let (x, speed) = slide(time);
            let crept = (time - 0.1).max(0.0) * 5e-4;
            (x + crept, speed + if crept > 0.0 { 5e-4 } else { 0.0 })
        };
        let stop = watched(2.0, creeping).stop_time().expect("it creeps");
        assert!((stop - 0.1).abs() < 4e-4, "{stop}");
        let pausing = |time: f64| {
            if time < 0.5 {
                slide(time)
            } else {
                slide(time - 0.5)
            }
        };
        let stop = watched(1.0, pausing).stop_time().expect("it stands");
        assert!((stop - 0.6).abs() < 4e-4, "{stop}");
    }
}
