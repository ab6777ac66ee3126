//! Prescribed motion: velocity and angular velocity as functions of time
//! (docs/method.md, equation 15a).

use crate::math::Vec3;
use nalgebra::UnitQuaternion;
use std::sync::Arc;

/// Velocity of a body's centre, and its angular velocity, both in channel axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Velocities {
    /// Velocity of the centre [m/s].
    pub linear: Vec3,
    /// Angular velocity [rad/s].
    pub angular: Vec3,
}

/// Velocities at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Knot {
    /// Time [s].
    time: f64,
    velocities: Velocities,
    /// Displacement of the centre since the first knot [m].
    way: Vec3,
}

/// Velocities that are linear in time between knots, and constant before the first and
/// after the last one.
#[derive(Debug, Clone, PartialEq)]
pub struct PrescribedMotion {
    /// At least one knot, in order of time.
    knots: Arc<[Knot]>,
}

impl Velocities {
    /// No motion.
    pub const NONE: Self = Self {
        linear: Vec3::new(0.0, 0.0, 0.0),
        angular: Vec3::new(0.0, 0.0, 0.0),
    };

    /// Bound of the speed of all places within `radius` of the centre [m/s].
    fn fastest(&self, radius: f64) -> f64 {
        self.linear.norm() + self.angular.norm() * radius
    }

    fn between(&self, other: &Self, share: f64) -> Self {
        Self {
            linear: self.linear + (other.linear - self.linear) * share,
            angular: self.angular + (other.angular - self.angular) * share,
        }
    }
}

impl PrescribedMotion {
    /// Constant velocities.
    pub fn constant(velocities: Velocities) -> Self {
        Self::table([(0.0, velocities)])
    }

    /// Velocities at ascending times [s].
    ///
    /// # Panics
    /// Without any, or if the times do not ascend: the reader of a table refuses such a one.
    pub fn table(rows: impl IntoIterator<Item = (f64, Velocities)>) -> Self {
        let mut knots: Vec<Knot> = Vec::new();
        for (time, velocities) in rows {
            let way = knots.last().map_or_else(Vec3::zeros, |last| {
                assert!(last.time < time, "the times of a motion ascend");
                let mean = 0.5 * (last.velocities.linear + velocities.linear);
                last.way + mean * (time - last.time)
            });
            knots.push(Knot {
                time,
                velocities,
                way,
            });
        }
        assert!(!knots.is_empty(), "a motion has velocities");
        Self {
            knots: knots.into(),
        }
    }

    /// Velocities at a time [s].
    pub fn velocities(&self, time: f64) -> Velocities {
        match self.around(time) {
            (Some(before), Some(after)) => {
                let share = (time - before.time) / (after.time - before.time);
                before.velocities.between(&after.velocities, share)
            }
            (Some(only), None) | (None, Some(only)) => only.velocities,
            (None, None) => Velocities::NONE,
        }
    }

    /// Displacement of the centre from time 0 to a time [m], exact.
    pub fn way(&self, time: f64) -> Vec3 {
        self.way_from_first(time) - self.way_from_first(0.0)
    }

    /// Displacement since the first knot; negative before it.
    fn way_from_first(&self, time: f64) -> Vec3 {
        let from = match self.around(time) {
            (Some(before), _) => before,
            (None, Some(first)) => first,
            (None, None) => return Vec3::zeros(),
        };
        let mean = 0.5 * (from.velocities.linear + self.velocities(time).linear);
        from.way + mean * (time - from.time)
    }

    /// Rotation from one time to a later one: the exponential of the integrated angular velocity,
    /// exact while its axis stays and of second order otherwise. `None` if there is none.
    pub fn turn(&self, from: f64, to: f64) -> Option<UnitQuaternion<f64>> {
        let inside = self.knots.iter().map(|knot| knot.time);
        let inside = inside.filter(|time| from < *time && *time < to);
        let (mut angle, mut start) = (Vec3::zeros(), from);
        for end in inside.chain([to]) {
            let both = self.velocities(start).angular + self.velocities(end).angular;
            angle += both * (0.5 * (end - start));
            start = end;
        }
        (angle != Vec3::zeros()).then(|| UnitQuaternion::from_scaled_axis(angle))
    }

    /// Bound of the speed of all places within `radius` of the centre at all times [m/s].
    pub fn fastest(&self, radius: f64) -> f64 {
        let speeds = self
            .knots
            .iter()
            .map(|knot| knot.velocities.fastest(radius));
        speeds.fold(0.0, f64::max)
    }

    /// Bound of the rise of the centre above its start until a time [m].
    pub fn rise(&self, until: f64) -> f64 {
        let inside = self.knots.iter().map(|knot| knot.time);
        let inside = inside.filter(|time| 0.0 < *time && *time < until);
        let (mut rise, mut start) = (0.0, 0.0);
        for end in inside.chain([until.max(0.0)]) {
            let [first, last] = [start, end].map(|time| self.velocities(time).linear.z);
            rise += first.max(last).max(0.0) * (end - start);
            start = end;
        }
        rise
    }

    /// True if nothing moves from a time on.
    pub fn rests_from(&self, time: f64) -> bool {
        let later = self.knots.iter().filter(|knot| knot.time > time);
        let later = later.map(|knot| knot.velocities);
        later
            .chain([self.velocities(time)])
            .all(|velocities| velocities == Velocities::NONE)
    }

    /// True if it never leaves the plane y = 0 nor turns out of it.
    pub fn stays_in_plane(&self) -> bool {
        self.knots.iter().all(|knot| {
            let Velocities { linear, angular } = &knot.velocities;
            linear.y == 0.0 && angular.x == 0.0 && angular.z == 0.0
        })
    }

    /// The knots before and after a time.
    fn around(&self, time: f64) -> (Option<&Knot>, Option<&Knot>) {
        let after = self.knots.partition_point(|knot| knot.time <= time);
        let before = after.checked_sub(1).map(|before| &self.knots[before]);
        (before, self.knots.get(after))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn along(x: f64) -> Velocities {
        Velocities {
            linear: Vec3::new(x, 0.0, 0.0),
            ..Velocities::NONE
        }
    }

    fn about_z(rate: f64) -> Velocities {
        Velocities {
            angular: Vec3::new(0.0, 0.0, rate),
            ..Velocities::NONE
        }
    }

    // 0 until 1 s, up to 4 m/s at 3 s, back to 2 m/s at 4 s.
    fn ramp() -> PrescribedMotion {
        PrescribedMotion::table([(1.0, along(0.0)), (3.0, along(4.0)), (4.0, along(2.0))])
    }

    #[test]
    fn velocities_are_linear_between_knots_and_constant_beyond() {
        let places = [
            (0.0, 0.0),
            (1.0, 0.0),
            (2.0, 2.0),
            (3.0, 4.0),
            (3.5, 3.0),
            (9.0, 2.0),
        ];
        for (time, speed) in places {
            assert_eq!(ramp().velocities(time), along(speed), "at {time}");
        }
    }

    #[test]
    fn the_way_is_the_area_under_the_velocities() {
        let places = [(0.5, 0.0), (2.0, 1.0), (3.0, 4.0), (4.0, 7.0), (6.0, 11.0)];
        for (time, way) in places {
            assert!((ramp().way(time).x - way).abs() < 1e-14, "at {time}");
        }
        // Time 0 may lie between knots, or beyond them.
        let begun = PrescribedMotion::table([(-1.0, along(1.0)), (1.0, along(3.0))]);
        assert!((begun.way(1.0).x - 2.5).abs() < 1e-15);
        let before = PrescribedMotion::table([(2.0, along(3.0)), (3.0, along(0.0))]);
        assert!((before.way(2.5).x - 7.125).abs() < 1e-14);
    }

    #[test]
    fn a_turn_about_one_axis_is_exact_over_knots() {
        let motion = PrescribedMotion::table([(1.0, about_z(0.0)), (2.0, about_z(PI))]);
        let turn = motion.turn(0.0, 2.5).expect("it turns");
        // Half a turn takes π; π/2 on the ramp and π/2 after it.
        assert!((turn.angle() - PI).abs() < 1e-14, "{turn:?}");
        assert_eq!(motion.turn(0.0, 1.0), None);
    }

    #[test]
    fn bounds_hold_all_the_time() {
        assert_eq!(ramp().fastest(0.1), 4.0);
        assert_eq!(
            PrescribedMotion::constant(about_z(-3.0)).fastest(0.1),
            3.0 * 0.1
        );
        let up = |speed: f64| Velocities {
            linear: Vec3::new(0.0, 0.0, speed),
            ..Velocities::NONE
        };
        let up_and_down = PrescribedMotion::table([(0.0, up(1.0)), (2.0, up(-1.0))]);
        let rise = up_and_down.rise(10.0);
        assert!((0.5..=2.0).contains(&rise), "{rise}");
    }

    #[test]
    fn rest_is_for_good() {
        let stops = PrescribedMotion::table([(0.0, along(1.0)), (1.0, along(0.0))]);
        assert!(!stops.rests_from(0.5) && stops.rests_from(1.0) && stops.rests_from(7.0));
        assert!(!ramp().rests_from(0.5));
    }

    #[test]
    fn a_plane_motion_turns_about_y_only() {
        assert!(ramp().stays_in_plane());
        assert!(!PrescribedMotion::constant(about_z(1.0)).stays_in_plane());
    }
}
