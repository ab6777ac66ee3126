//! Simulated time, and how a run is divided.

use serde::{Deserialize, Serialize};

/// Where a run stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Clock {
    /// Simulated time [s].
    pub time: f64,
    /// Finished steps.
    pub steps: u64,
    /// Sub-steps.
    pub substeps: u64,
    /// Sub-steps summed over the points that took part.
    pub point_steps: u64,
    /// Index of the next sample time.
    pub next_sample: u64,
    /// Sub-steps at the last audit.
    pub last_audit: u64,
    /// Points at the start.
    pub released_points: u64,
    /// Volume not released [m³].
    pub volume_left_out: f64,
}

impl Clock {
    /// At the start of a run.
    pub(super) fn start(released_points: u64) -> Self {
        Self {
            time: 0.0,
            steps: 0,
            substeps: 0,
            point_steps: 0,
            next_sample: 1,
            last_audit: 0,
            released_points,
            volume_left_out: 0.0,
        }
    }
}

/// Duration and sample times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// End of the run [s].
    pub duration: f64,
    /// Time between samples [s].
    pub sample_interval: f64,
}

impl Timing {
    /// Sample time k [s]: k · interval, and the end.
    pub(super) fn sample_time(&self, k: u64) -> f64 {
        let time = k as f64 * self.sample_interval;
        // The end may miss a whole number of intervals by rounding only.
        if time >= self.duration - 1e-9 * self.sample_interval {
            self.duration
        } else {
            time
        }
    }
}
