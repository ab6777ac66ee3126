//! Thresholds of motion, by the size of the moving body or flow: a scene L times as large that
//! runs √L times as long has the same answer (Froude's law).

use crate::method::METHOD;
use crate::rigid::Body;
use serde::{Deserialize, Serialize};

/// Distance of a body's centre from its start at onset [sizes].
const ONSET_DISTANCE: f64 = 1.0 / 40.0;
/// Speed below which a body is at rest [√(g size)].
const REST_SPEED: f64 = 1.6e-3;

/// Size of a body or a flow, and its speed scale.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Scale {
    /// Size [m].
    size: f64,
    /// √(g size) [m/s].
    speed: f64,
}

impl Scale {
    /// Scale of this size [m] under gravity [m/s²], which is positive in every scenario.
    pub(super) fn of(size: f64, gravity: f64) -> Self {
        Self {
            size,
            speed: (gravity * size).sqrt(),
        }
    }

    /// Scale of a body: the side of a cube of its volume.
    pub(super) fn of_body(body: &Body, gravity: f64) -> Self {
        Self::of(body.shape.volume().cbrt(), gravity)
    }

    /// √(g size) [m/s].
    pub(super) fn speed(&self) -> f64 {
        self.speed
    }

    /// Distance of a body from its start at onset [m].
    pub(super) fn onset_distance(&self) -> f64 {
        ONSET_DISTANCE * self.size
    }

    /// Speed below which a body is at rest [m/s].
    pub(super) fn rest_speed(&self) -> f64 {
        REST_SPEED * self.speed
    }

    /// Time of rest after which a body has come to rest [s].
    pub(super) fn rest_time(&self) -> f64 {
        METHOD.early_stop.rest_time * self.size / self.speed
    }

    /// Distance at the rest speed in the rest time [m].
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
