//! How a body moves, in a word.

use super::Mode;
use super::means::Means;
use super::motion::Motion;
use super::recorder::REST_SPEED;
use crate::rigid::Body;

/// A body on walls and other bodies for less of the time than this saltates.
const SUPPORTED_SHARE: f64 = 0.5;
/// A surface speed from turning above this share of the centre's speed is rolling.
const ROLLING_SHARE: f64 = 0.5;

/// The mode of a body that moves like this at a sample time.
pub(super) fn mode(body: &Body, motion: &Motion, means: &Means) -> Mode {
    let speed = motion.velocity.norm();
    let turning = motion.angular_velocity.norm() * body.shape.bounding_radius();
    if !body.is_free() || speed.max(turning) < REST_SPEED {
        Mode::Resting
    } else if !is_supported(body, means) {
        Mode::Saltating
    } else if turning > ROLLING_SHARE * speed {
        Mode::Rolling
    } else {
        Mode::Sliding
    }
}

fn is_supported(body: &Body, means: &Means) -> bool {
    if means.duration == 0.0 {
        return body.is_supported();
    }
    means.supported >= SUPPORTED_SHARE * means.duration
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec3;
    use crate::rigid::fixture::cuboid;

    /// Mode of a body that was on something for such a share of the time.
    fn mode_of(speed: f64, turning: f64, supported: f64) -> Mode {
        let mut body = cuboid([0.04; 3]);
        body.state.momentum.x = body.mass * speed;
        let spin = turning / body.shape.bounding_radius();
        body.state.angular_momentum = body.inertia * Vec3::new(0.0, spin, 0.0);
        let means = Means {
            duration: 1.0,
            supported,
            ..Means::default()
        };
        mode(&body, &Motion::of(&body), &means)
    }

    #[test]
    fn modes_tell_how_a_body_moves() {
        assert_eq!(mode_of(5e-4, 5e-4, 1.0), Mode::Resting);
        assert_eq!(mode_of(0.5, 0.1, 1.0), Mode::Sliding);
        assert_eq!(mode_of(0.5, 0.4, 0.5), Mode::Rolling);
        assert_eq!(mode_of(0.0, 0.4, 1.0), Mode::Rolling);
        assert_eq!(mode_of(0.5, 0.4, 0.4), Mode::Saltating);
        assert_eq!(mode_of(0.5, 0.0, 0.0), Mode::Saltating);
    }
}
