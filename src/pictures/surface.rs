//! Flow as seen from above.

use scree_solver::record::FlowSnapshot;
use std::collections::BTreeMap;
use std::ops::Range;

/// A visible point of the flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dot {
    /// x, y [m].
    pub at: [f64; 2],
    /// z [m].
    pub elevation: f64,
    /// Speed [m/s].
    pub speed_m_s: f64,
}

/// The topmost point in every square of side `bin_m` [m] whose x is in `x`:
/// thins the flow to the visible points. Lowest first, so that in drawing
/// order higher points hide lower ones.
/// order the higher hides the lower.
pub(super) fn seen_from_above(snapshot: &FlowSnapshot, x: &Range<f64>, bin_m: f64) -> Vec<Dot> {
    let mut top: BTreeMap<(i64, i64), Dot> = BTreeMap::new();
    for (position, speed) in snapshot.position_m.iter().zip(&snapshot.speed_m_s) {
        let [px, py, pz] = position.map(f64::from);
        if !(px + py + pz + f64::from(*speed)).is_finite() || !x.contains(&px) {
            continue;
        }
        let bin = ((px / bin_m).floor() as i64, (py / bin_m).floor() as i64);
        let dot = Dot {
            at: [px, py],
            elevation: pz,
            speed_m_s: f64::from(*speed),
        };
        let highest = top.entry(bin).or_insert(dot);
        if dot.elevation > highest.elevation {
            *highest = dot;
        }
    }
    let mut dots: Vec<Dot> = top.into_values().collect();
    dots.sort_by(|a, b| a.elevation.total_cmp(&b.elevation));
    dots
}
