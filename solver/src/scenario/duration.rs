//! Default duration of a run.

use super::motion::Motion;
use super::rules::LONGEST;
use super::sliding_block::SlidingBlock;
use super::{Body, Channel, Flow, Source};

/// Default duration without a flow [s].
pub(super) const WITHOUT_FLOW: f64 = 3.0;
/// Default duration over the expected end of a flow: a run that is at rest ends early, and one that
/// is not is cut off.
const MARGIN: f64 = 2.0;

/// Default duration [s]: twice the time at which the flow is expected to have come to rest, and at
/// least as long as every prescribed motion, rounded up to two digits.
pub(super) fn default_duration(
    (channel, flow): (&Channel, Option<&Flow>),
    bodies: &[Option<Body>],
    gravity_m_s2: f64,
) -> f64 {
    let block = flow.and_then(|flow| match &flow.source {
        Source::Channel { volume_m3, release } => {
            SlidingBlock::of(channel, (*volume_m3, release), gravity_m_s2)
        }
        Source::Terrain { .. } => None,
    });
    duration_to(block.map(|block| block.rests_at()), bodies.iter().flatten())
}

/// Default duration [s] for a flow that is expected to rest at a time [s], if there is one.
pub(super) fn duration_to<'a>(
    rests_at: Option<f64>,
    bodies: impl Iterator<Item = &'a Body>,
) -> f64 {
    let expected = rests_at.map_or(WITHOUT_FLOW, |time| MARGIN * time);
    let motions = bodies.filter_map(|of| of.motion.as_ref());
    let ends = motions.filter_map(|motion| match motion {
        Motion::Table { times_s, .. } => times_s.last().copied(),
        Motion::Constant { .. } => None,
    });
    up_to_two_digits(ends.fold(expected, f64::max)).min(LONGEST)
}

/// The next number of two digits that is not less.
fn up_to_two_digits(value: f64) -> f64 {
    let digits = 1 - value.log10().floor() as i32;
    let unit = 10f64.powi(digits);
    // Division keeps 2.1 from becoming 2.1000000000000001.
    (value * unit - 1e-9).ceil() / unit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_duration_has_two_digits() {
        let cases = [
            (2.0001, 2.1),
            (3.0, 3.0),
            (0.0341, 0.035),
            (99.5, 100.0),
            (1234.0, 1300.0),
        ];
        for (value, rounded) in cases {
            assert_eq!(up_to_two_digits(value), rounded);
        }
    }
}
