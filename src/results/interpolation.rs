//! States of a body between its samples.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use scree_solver::record::{BodySample, Mode};

/// Motion of a body at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyState {
    /// Centre [m].
    pub position: Vector3<f64>,
    /// Turns body axes into channel axes.
    pub orientation: UnitQuaternion<f64>,
    /// Velocity of the centre [m/s].
    pub velocity: Vector3<f64>,
    /// Angular velocity in channel axes [rad/s].
    pub angular_velocity: Vector3<f64>,
    /// Mode of motion.
    pub mode: Mode,
}

impl From<&BodySample> for BodyState {
    fn from(sample: &BodySample) -> Self {
        let [w, x, y, z] = sample.orientation;
        Self {
            position: sample.position_m.into(),
            orientation: UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)),
            velocity: sample.velocity_m_s.into(),
            angular_velocity: sample.angular_velocity_rad_s.into(),
            mode: sample.mode,
        }
    }
}

impl BodyState {
    /// The state at a share of the time from this one to the next: position and velocities linearly,
    /// orientation along the shorter turn at constant speed (slerp). The mode is that of
    /// the next, which a sample has since the one before.
    fn towards(&self, next: &Self, share: f64) -> Self {
        let turned = self.orientation.try_slerp(&next.orientation, share, 1e-9);
        Self {
            position: self.position.lerp(&next.position, share),
            // Half a turn between two samples has no shorter way.
            orientation: turned.unwrap_or(next.orientation),
            velocity: self.velocity.lerp(&next.velocity, share),
            angular_velocity: self.angular_velocity.lerp(&next.angular_velocity, share),
            mode: next.mode,
        }
    }
}

/// Interpolator of one body's states at given instants, from its samples in order.
#[derive(Debug)]
pub struct Interpolator<'a> {
    /// Instants not reached yet, in order [s].
    instants: &'a [f64],
    before: Option<(f64, BodyState)>,
    states: Vec<BodyState>,
}

impl<'a> Interpolator<'a> {
    /// An interpolator before the first sample.
    pub fn new(instants: &'a [f64]) -> Self {
        Self {
            instants,
            before: None,
            states: Vec::with_capacity(instants.len()),
        }
    }

    /// Takes the next sample.
    pub fn push(&mut self, time_s: f64, sample: &BodySample) {
        let next = BodyState::from(sample);
        while let Some((&instant, later)) = self.instants.split_first()
            && instant <= time_s
        {
            self.instants = later;
            self.states.push(match self.before {
                Some((before_s, before)) if before_s < time_s => {
                    before.towards(&next, (instant - before_s) / (time_s - before_s))
                }
                _ => next,
            });
        }
        self.before = Some((time_s, next));
    }

    /// The states at all instants, the last sample's at those after it; none without samples.
    pub fn finish(mut self) -> Option<Vec<BodyState>> {
        let (_, last) = self.before?;
        self.states.extend(self.instants.iter().map(|_| last));
        Some(self.states)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::columns::tests::numbered;
    use std::f64::consts::PI;

    fn sample(place: f64, turn: f64, mode: Mode) -> BodySample {
        let (sin, cos) = (turn / 2.0).sin_cos();
        BodySample {
            position_m: [place, 0.0, 1.0],
            orientation: [cos, 0.0, sin, 0.0],
            mode,
            ..numbered(0)
        }
    }

    #[test]
    fn a_body_moves_and_turns_evenly_between_two_samples() {
        let instants = [0.0, 0.25, 1.0, 1.5, 9.0];
        let mut interpolator = Interpolator::new(&instants);
        interpolator.push(0.0, &sample(0.0, 0.0, Mode::Resting));
        interpolator.push(1.0, &sample(2.0, 0.8, Mode::Sliding));
        // The same turn by the quaternion of the other sign.
        let mut other = sample(4.0, 1.6, Mode::Rolling);
        other.orientation = other.orientation.map(|x| -x);
        interpolator.push(2.0, &other);
        let states = interpolator.finish().unwrap();
        let places: Vec<_> = states.iter().map(|state| state.position.x).collect();
        assert_eq!(places, [0.0, 0.5, 2.0, 3.0, 4.0]);
        for (state, turn) in states.iter().zip([0.0, 0.2, 0.8, 1.2, 1.6]) {
            let axis = Vector3::y_axis();
            let expected = UnitQuaternion::from_axis_angle(&axis, turn);
            assert!(state.orientation.angle_to(&expected) < 1e-12, "{turn}");
        }
        let modes: Vec<_> = states.iter().map(|state| state.mode).collect();
        let expected = ["resting", "sliding", "sliding", "rolling", "rolling"];
        assert_eq!(
            serde_json::to_value(modes).unwrap(),
            serde_json::json!(expected)
        );
    }

    #[test]
    fn half_a_turn_and_no_sample_give_no_nonsense() {
        let mut interpolator = Interpolator::new(&[0.5]);
        interpolator.push(0.0, &sample(0.0, 0.0, Mode::Resting));
        interpolator.push(1.0, &sample(0.0, 2.0 * PI, Mode::Resting));
        let half = interpolator.finish().unwrap()[0];
        assert!(half.orientation.coords.iter().all(|x| x.is_finite()));
        assert_eq!(Interpolator::new(&[0.5]).finish(), None);
    }
}
