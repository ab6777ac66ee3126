//! Expected course of a flow: a rough estimate, for the cost of a run.

use crate::rigid::Body;
use crate::scenario::SlidingBlock;
use crate::simulation::PreparedScene;

/// Expected course of a flow: that of a sliding block.
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
        let flow = scenario.flow.as_ref().zip(scenario.release());
        let block = flow.and_then(|(flow, release)| {
            let block = SlidingBlock::of(&scenario.channel, flow, scenario.gravity_m_s2);
            block.zip(Some(release))
        });
        let Some((block, release)) = block else {
            return Self {
                meets_body: f64::INFINITY,
                rests: f64::INFINITY,
            };
        };
        let front = prepared.bodies.iter().map(|body| {
            let back = body.state.position.x - body.shape.bounding_radius();
            back - 3.5 * prepared.given.lattice.spacing.x - release.front_m
        });
        let way = front.fold(f64::INFINITY, f64::min).max(0.0);
        let rests = block.rests_at();
        let mut prescribed = prepared.bodies.iter().filter_map(Body::prescribed);
        let stirred = prescribed.any(|body| !body.motion.rests_from(rests));
        Self {
            meets_body: block.front_takes(way),
            rests: if stirred { f64::INFINITY } else { rests },
        }
    }
}
