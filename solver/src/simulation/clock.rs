//! Simulated time and the bounds of a run.

use serde::{Deserialize, Serialize};

/// Sub-steps between two audits. Sums over all points have a cost, and an error visible at a
/// step's end is visible at a later one as well.
const AUDIT_INTERVAL: u64 = 64;

/// Time of a run and the numbers of its steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// Finished steps.
    pub steps: u64,
    /// Sub-steps.
    pub substeps: u64,
    /// Sub-steps summed over the computed points.
    pub point_steps: u64,
    /// Sub-steps at the last audit.
    pub last_audit: u64,
    /// Points at the start.
    pub released_points: u64,
    /// Volume not released [m³].
    pub volume_left_out: f64,
}

impl Clock {
    /// Clock at the start of a run.
    pub(super) fn start(released_points: u64) -> Self {
        Self {
            time: 0.0,
            steps: 0,
            substeps: 0,
            point_steps: 0,
            last_audit: 0,
            released_points,
            volume_left_out: 0.0,
        }
    }
}

/// Duration of a run, and bounds of its steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// End of the run [s].
    pub duration: f64,
    /// Longest sub-step [s]; infinite where only stability bounds it.
    pub longest_substep: f64,
    /// Sub-steps between two audits; an audit is at the end of the step in which they are over.
    pub audit_interval: u64,
}

impl Timing {
    /// A run of this duration [s] with sub-steps as long as is stable.
    pub fn lasting(duration: f64) -> Self {
        Self {
            duration,
            longest_substep: f64::INFINITY,
            audit_interval: AUDIT_INTERVAL,
        }
    }
}
