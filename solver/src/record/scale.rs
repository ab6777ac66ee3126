//! From where on motion counts, by the size of what moves: a scene L times as large
//! that runs √L times as long has the same answer (Froude's law).

use crate::rigid::Body;
use serde::{Deserialize, Serialize};

/// A body has set off when its centre is this far from where it started [sizes].
const ONSET_DISTANCE: f64 = 1.0 / 40.0;
/// Slower than this is at rest [√(g size)].
const REST_SPEED: f64 = 1.6e-3;
/// At rest for so long without a break is to have come to rest [√(size/g)].
const REST_TIME: f64 = 1.5;

/// Size of a body or a flow, and the speed that goes with it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Scale {
    /// [m].
    size: f64,
    /// √(g size) [m/s].
    speed: f64,
}

impl Scale {
    /// Of this size [m] under gravity [m/s²], which no scenario is without.
    pub(super) fn of(size: f64, gravity: f64) -> Self {
        Self {
            size,
            speed: (gravity * size).sqrt(),
        }
    }

    /// Of a body: the side of a cube of its volume.
    pub(super) fn of_body(body: &Body, gravity: f64) -> Self {
        Self::of(body.shape.volume().cbrt(), gravity)
    }

    /// Distance from its start at which a body has set off [m].
    pub(super) fn onset_distance(&self) -> f64 {
        ONSET_DISTANCE * self.size
    }

    /// Slower than this is at rest [m/s].
    pub(super) fn rest_speed(&self) -> f64 {
        REST_SPEED * self.speed
    }

    /// At rest for so long is to have come to rest [s].
    pub(super) fn rest_time(&self) -> f64 {
        REST_TIME * self.size / self.speed
    }

    /// Distance that the rest speed makes of the rest time [m].
    pub(super) fn rest_distance(&self) -> f64 {
        self.rest_speed() * self.rest_time()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigid::fixture::cuboid;

    // 1 mm, 1 mm/s and a tenth of a second.
    #[test]
    fn a_cube_of_the_laboratory_has_round_numbers() {
        let scale = Scale::of_body(&cuboid([0.04; 3]), 9.81);
        for (found, round) in [
            (scale.onset_distance(), 1e-3),
            (scale.rest_speed(), 1e-3),
            (scale.rest_time(), 0.1),
        ] {
            assert!((found / round - 1.0).abs() < 0.05, "{found} {round}");
        }
    }

    #[test]
    fn lengths_go_with_the_size_and_times_with_its_root() {
        let (small, large) = (Scale::of(0.1, 9.81), Scale::of(0.4, 9.81));
        let ratio = |of: fn(&Scale) -> f64| of(&large) / of(&small);
        assert!((ratio(Scale::onset_distance) - 4.0).abs() < 1e-12);
        assert!((ratio(Scale::rest_speed) - 2.0).abs() < 1e-12);
        assert!((ratio(Scale::rest_time) - 2.0).abs() < 1e-12);
    }
}
