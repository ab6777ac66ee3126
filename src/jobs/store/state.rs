//! Saved states of runs, from which the next attempt resumes. A store treats them as bytes.

use crate::results::chunk::{Block, BlockError};

/// Point in the records of a run from which its saved state resumes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResumePoint {
    /// Simulated time [s].
    pub time_s: f64,
    /// Number of samples recorded by then.
    pub samples: usize,
    /// Fingerprint of the records by then.
    pub fingerprint: [u8; 32],
}

/// A run's state, compressed and checksummed.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredState {
    /// Resume point of the run's records.
    pub resume_point: ResumePoint,
    /// Length of the state [bytes].
    pub bytes: usize,
    /// The state.
    pub block: Block,
}

/// Start of an attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AttemptStart {
    /// At the start of the run: all earlier records are removed.
    Afresh,
    /// At a saved state: all later records are removed.
    At(ResumePoint),
}

impl StoredState {
    /// Compresses a state.
    ///
    /// # Errors
    /// Only if the compressor is out of memory.
    pub fn pack(resume_point: ResumePoint, state: &[u8]) -> Result<Self, BlockError> {
        Ok(Self {
            resume_point,
            bytes: state.len(),
            block: Block::seal_quickly(state)?,
        })
    }

    /// The state.
    ///
    /// # Errors
    /// [`BlockError`], if the bytes are not those that were stored.
    pub fn unpack(&self) -> Result<Vec<u8>, BlockError> {
        self.block.open(self.bytes)
    }
}
