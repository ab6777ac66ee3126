//! How far a run is.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

/// How far a run is. All zero before the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, ToSchema)]
pub struct Progress {
    /// Share of the simulated time that is done, 0..1.
    pub fraction: f64,
    /// Simulated time [s].
    pub simulated_time_s: f64,
    /// Steps (transfers between points and grid) so far.
    pub steps: u64,
    /// Acoustic sub-steps so far.
    pub substeps: u64,
    /// Sub-steps of one point, per second of wall time so far [1/s].
    pub point_steps_per_s: f64,
    /// Wall time still to go at the pace so far [s]; null before the first
    /// step and once the run has ended.
    #[schema(required = true)]
    pub eta_s: Option<f64>,
}
