//! Default duration of a run.

use super::{Channel, Flow};
use crate::bed::Bed;

/// Shortest duration by default [s].
pub(super) const LEAST: f64 = 3.0;
/// Time in which material that has slid spreads and settles, over √(h/g) of the release.
const SETTLES_FOR: f64 = 4.5;

/// Default duration [s]: the time in which the back of the release slides to the foot, is
/// stopped by friction on the floor or leaves through the open end, and settles; whole seconds,
/// and at least [`LEAST`].
pub(super) fn default_duration(channel: &Channel, flow: Option<&Flow>, gravity_m_s2: f64) -> f64 {
    let Some(flow) = flow.filter(|flow| flow.volume_m3 > 0.0) else {
        return LEAST;
    };
    let back = channel.release_box(flow).back_m;
    let bed = channel.bed().tangent(back, 0.0);
    let (sin, cos) = (bed.normal.x, bed.normal.z);
    let along_slope = -back / cos;
    let pull = gravity_m_s2 * (sin - bed.flow_friction * cos).max(0.0);
    let sliding = if pull > 0.0 {
        (2.0 * along_slope / pull).sqrt()
    } else {
        0.0
    };
    let speed = channel.fastest_flow(flow, gravity_m_s2);
    let stopping = speed / (channel.base_friction * gravity_m_s2);
    let leaving = channel.runout_length_m / speed;
    let settling = SETTLES_FOR * (flow.release.height_m / gravity_m_s2).sqrt();
    let expected = sliding + stopping.min(leaving) + settling;
    expected.ceil().clamp(LEAST, super::rules::LONGEST)
}
