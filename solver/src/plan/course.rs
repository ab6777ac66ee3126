//! Expected course of a flow: a rough estimate, for the cost of a run.

use crate::rigid::Body;
use crate::scenario::{ReleaseBox, Scenario, SlidingBlock, SlidingPoints, Source};
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
        let Some((block, release)) = sliding_block(scenario) else {
            return Self {
                meets_body: f64::INFINITY,
                rests: rests_on_terrain(prepared).unwrap_or(f64::INFINITY),
            };
        };
        let front = prepared.bodies.iter().map(|body| {
            let back = body.state.position.x - body.shape.bounding_radius();
            back - 3.5 * prepared.given.lattice.spacing.x - release.front_m
        });
        let way = front.fold(f64::INFINITY, f64::min).max(0.0);
        let rests = block.rests_at();
        Self {
            meets_body: block.front_takes(way),
            rests: unless_stirred(prepared, rests),
        }
    }
}

fn sliding_block(scenario: &Scenario) -> Option<(SlidingBlock, ReleaseBox)> {
    let (channel, flow) = (scenario.channel()?, scenario.flow.as_ref()?);
    let Source::Channel { volume_m3, release } = &flow.source else {
        return None;
    };
    let block = SlidingBlock::of(channel, (*volume_m3, release), scenario.gravity_m_s2)?;
    Some((block, scenario.release()?))
}

/// Time at which points that slide down a terrain have come to rest [s].
fn rests_on_terrain(prepared: &PreparedScene) -> Option<f64> {
    let ground = prepared.given.walls.bed.height_field()?;
    let course = SlidingPoints::of(&prepared.scenario, ground)?;
    Some(unless_stirred(prepared, course.rests_at))
}

/// A time [s], unless a prescribed motion goes on then.
fn unless_stirred(prepared: &PreparedScene, rests: f64) -> f64 {
    let mut prescribed = prepared.bodies.iter().filter_map(Body::prescribed);
    let stirred = prescribed.any(|body| !body.motion.rests_from(rests));
    if stirred { f64::INFINITY } else { rests }
}
