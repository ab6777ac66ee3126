//! Sliding block: a rough estimate of a flow's course, without a computation.

use super::{Channel, Release};
use crate::bed::Bed;
use crate::method::METHOD;

/// Acceleration of a collapsing front, over gravity.
const COLLAPSE: f64 = 0.25;
/// Collapse time of a release that does not slide, over √(h/g).
const COLLAPSES_FOR: f64 = 4.5;

/// Block that slides from the back of the release down the incline, keeps its horizontal speed at
/// the foot, and is stopped by friction on the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlidingBlock {
    /// Acceleration along the incline [m/s²].
    pull: f64,
    /// Cosine of the inclination.
    cos: f64,
    /// Distance along the incline from the back of the release to the foot [m].
    way: f64,
    /// Friction on the floor, and its length [m].
    floor: (f64, f64),
    gravity: f64,
    /// Height of the release [m].
    height: f64,
}

impl SlidingBlock {
    /// Block of a released volume [m³] in this channel, under gravity [m/s²]; `None` without
    /// material.
    pub(crate) fn of(
        channel: &Channel,
        (volume, release): (f64, &Release),
        gravity: f64,
    ) -> Option<Self> {
        if volume <= 0.0 {
            return None;
        }
        let back = channel.release_box(volume, release).back_m;
        let slope = channel.bed().tangent(back, 0.0);
        let (sin, cos) = (slope.normal.x, slope.normal.z);
        Some(Self {
            pull: gravity * (sin - slope.flow_friction * cos).max(0.0),
            cos,
            way: -back / cos,
            floor: (channel.base_friction, channel.runout_length_m),
            gravity,
            height: release.height_m,
        })
    }

    /// Speed at the foot, the collapse of its height included [m/s] (equation 31).
    pub(crate) fn fastest(&self) -> f64 {
        (2.0 * self.pull * self.way + self.gravity * self.height).sqrt()
    }

    /// Time in which the front, which also collapses, travels this far horizontally [s].
    pub(crate) fn front_takes(&self, way: f64) -> f64 {
        (2.0 * way / (self.pull * self.cos + COLLAPSE * self.gravity)).sqrt()
    }

    /// Time at which it has been at rest for the rest time, or has left through the open end [s].
    pub(crate) fn rests_at(&self) -> f64 {
        let sliding = if self.pull > 0.0 {
            (2.0 * self.way / self.pull).sqrt()
        } else {
            0.0
        };
        let kept = 2.0 * self.pull * self.way * self.cos.powi(2);
        let speed = (kept + self.gravity * self.height).sqrt();
        let (friction, length) = self.floor;
        let stopping = speed / (friction * self.gravity);
        let leaving = length / speed;
        let fall = (self.height / self.gravity).sqrt();
        let stops = (sliding + stopping.min(leaving)).max(COLLAPSES_FOR * fall);
        stops + METHOD.early_stop.rest_time * fall
    }
}
