//! Progress of a run.

use serde::{Deserialize, Serialize};
use std::sync::{Mutex, PoisonError};
use utoipa::ToSchema;

/// Progress of a run. All zero before the start.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, ToSchema)]
pub struct Progress {
    /// Fraction of the expected wall time that is over, 0..1; never decreases.
    pub fraction: f64,
    /// Simulated time [s].
    pub simulated_time_s: f64,
    /// Steps (transfers between points and grid) so far.
    pub steps: u64,
    /// Acoustic sub-steps so far.
    pub substeps: u64,
    /// Point-steps (sub-steps of one point) per second of wall time so far [1/s].
    pub point_steps_per_s: f64,
    /// Expected remaining wall time [s], from the present speeds of flow and bodies and the pace of
    /// the computation; null before the first steps and once the run has ended.
    #[schema(required = true)]
    pub eta_s: Option<f64>,
}

/// Resources that a run uses.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resources {
    /// Memory of its points and nodes [bytes].
    pub memory_bytes: u64,
    /// Wall time so far, of attempts before this one too [s].
    pub wall_s: f64,
}

/// Progress board: the progress of a run, written by the run and read by others.
#[derive(Debug, Default)]
pub struct ProgressBoard(Mutex<Progress>);

impl ProgressBoard {
    /// Writes the progress.
    pub fn tell(&self, progress: &Progress) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = *progress;
    }

    /// Progress as written last.
    pub fn read(&self) -> Progress {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
