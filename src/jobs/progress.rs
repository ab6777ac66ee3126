//! How far a run is.

use serde::{Deserialize, Serialize};
use std::sync::{Mutex, PoisonError};
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

/// The progress of a run, told by the run and read by whoever wants to know.
#[derive(Debug, Default)]
pub struct ProgressBoard(Mutex<Progress>);

impl ProgressBoard {
    /// Tells it.
    pub fn tell(&self, progress: &Progress) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = *progress;
    }

    /// As it was told last.
    pub fn read(&self) -> Progress {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
