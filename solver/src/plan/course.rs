//! Expected course of a flow: a rough estimate, for the cost of a run.

use crate::rigid::Body;
use crate::simulation::PreparedScene;

/// Acceleration of a collapsing front, over gravity.
const COLLAPSE: f64 = 0.25;
/// Collapse time of a release that does not slide, over √(h/g).
const COLLAPSES_FOR: f64 = 4.5;

/// Expected course of a flow: a block that slides on the incline and is stopped by friction on
/// the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Course {
    /// Time at which it comes near a body [s]; infinite without one.
    pub(super) meets_body: f64,
    /// Time at which its last part has come to rest, and no prescribed motion moves it any more
    /// [s]; infinite if unknown.
    pub(super) rests: f64,
}

impl Course {
    /// Course of a scenario's flow.
    pub(super) fn of(prepared: &PreparedScene) -> Self {
        let scenario = &prepared.scenario;
        let Some(release) = scenario.release() else {
            return Self {
                meets_body: f64::INFINITY,
                rests: f64::INFINITY,
            };
        };
        let slide = Slide::of(prepared);
        let front = prepared.bodies.iter().map(|body| {
            let back = body.state.position.x - body.shape.bounding_radius();
            back - 3.5 * prepared.given.lattice.spacing.x - release.front_m
        });
        let way = front.fold(f64::INFINITY, f64::min).max(0.0);
        let rests = slide.rests_after(-release.back_m);
        let mut prescribed = prepared.bodies.iter().filter_map(Body::prescribed);
        let stirred = prescribed.any(|body| !body.motion.rests_from(rests));
        Self {
            meets_body: slide.front_takes(way),
            rests: if stirred { f64::INFINITY } else { rests },
        }
    }
}

/// A block on the incline and the floor.
struct Slide {
    /// Horizontal acceleration on the incline [m/s²].
    down: f64,
    /// Deceleration on the floor [m/s²].
    deceleration: f64,
    gravity: f64,
    /// Height of the release [m].
    height: f64,
}

impl Slide {
    fn of(prepared: &PreparedScene) -> Self {
        let (scenario, bed) = (&prepared.scenario, &prepared.given.walls.bed);
        let back = scenario.release().map_or(0.0, |release| release.back_m);
        let slope = bed.tangent(back, 0.0);
        let (sin, cos) = (slope.normal.x, slope.normal.z);
        let floor = bed.tangent(scenario.channel.runout_length_m, 0.0);
        let gravity = scenario.gravity_m_s2;
        let flow = scenario.flow.as_ref();
        Self {
            down: gravity * (sin - slope.flow_friction * cos).max(0.0) * cos,
            deceleration: gravity * floor.flow_friction,
            gravity,
            height: flow.map_or(0.0, |flow| flow.release.height_m),
        }
    }

    /// Time in which the front, which also collapses, travels this far [s].
    fn front_takes(&self, way: f64) -> f64 {
        (2.0 * way / (self.down + COLLAPSE * self.gravity)).sqrt()
    }

    /// Time until material that slides this far to the foot has been stopped [s].
    fn rests_after(&self, way: f64) -> f64 {
        let sliding = if self.down > 0.0 {
            (2.0 * way / self.down).sqrt()
        } else {
            0.0
        };
        let speed = (2.0 * self.down * way + self.gravity * self.height).sqrt();
        let collapsing = COLLAPSES_FOR * (self.height / self.gravity).sqrt();
        (sliding + speed / self.deceleration).max(collapsing)
    }
}
