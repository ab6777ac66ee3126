//! Colours: one per body, and the scale of the flow's speed.

use super::format::round_up;
use plotters::prelude::*;
use scree_solver::record::FlowSnapshot;

/// Colours of the bodies, distinct from each other, from the speed scale and
/// to colour-blind eyes (after Okabe and Ito, without their greens and yellow,
/// which the speed scale uses); a seventh body gets the first again.
const BODY_COLORS: [RGBColor; 6] = [
    RGBColor(213, 43, 30),
    RGBColor(0, 114, 178),
    RGBColor(230, 129, 0),
    RGBColor(178, 60, 150),
    RGBColor(60, 60, 60),
    RGBColor(86, 160, 220),
];

/// Share of the flow's points whose speed the scale must cover: a few fast
/// points must not darken all others.
const COVERED_SHARE: f64 = 0.995;

/// Colour of the body with this index.
pub(super) fn body_color(body: usize) -> RGBColor {
    BODY_COLORS[body % BODY_COLORS.len()]
}

/// Speed of the flow as a colour: viridis, which grows evenly in lightness and
/// survives grey print and colour blindness, from 0 to a round number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SpeedScale {
    /// Upper end [m/s].
    pub top_m_s: f64,
    /// True if some points are faster than that and share its colour.
    pub exceeded: bool,
}

impl SpeedScale {
    /// The scale for all these snapshots together.
    pub(super) fn covering(snapshots: &[&FlowSnapshot]) -> Self {
        let mut speeds: Vec<f32> = (snapshots.iter().flat_map(|s| &s.speed_m_s).copied())
            .filter(|speed| speed.is_finite())
            .collect();
        speeds.sort_by(f32::total_cmp);
        let covered = ((speeds.len() as f64) * COVERED_SHARE) as usize;
        let covered = speeds.get(covered).or(speeds.last()).copied();
        let top_m_s = round_up(f64::from(covered.unwrap_or(0.0)));
        let fastest = f64::from(speeds.last().copied().unwrap_or(0.0));
        Self {
            top_m_s,
            exceeded: fastest > top_m_s,
        }
    }

    /// Colour of this speed [m/s].
    pub(super) fn color(&self, speed_m_s: f64) -> RGBColor {
        ViridisRGB::get_color((speed_m_s / self.top_m_s).clamp(0.0, 1.0))
    }
}
