//! The state of several runs as bytes: results of the completed runs, then the current run.

use super::headed;
use super::saved_run::{COMMIT, SavedRunError};
use scree_solver::record::{FlowMaps, Outcome, Record};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// State of a convergence study besides the current run.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SavedStudy<'a> {
    /// Outcome of each completed run, in order.
    pub done: Vec<Result<Outcome, String>>,
    /// Records of the finest completed run, if it may be the answer.
    pub kept: Cow<'a, [Record]>,
    /// Maps of its flow on a terrain.
    pub kept_maps: Cow<'a, Option<FlowMaps>>,
    /// Records of the current run, if it may be the answer.
    pub of_run: Cow<'a, [Record]>,
    /// Fraction of the study that was reported as done.
    pub fraction: f64,
}

/// Bytes from which [`read`] restores both.
pub(super) fn write(saved: &SavedStudy, run: &[u8]) -> Vec<u8> {
    headed::joined(&(COMMIT, saved), run)
}

/// The saved study, and the bytes of the current run.
///
/// # Errors
/// The bytes are something else, or of another build.
pub(super) fn read(bytes: &[u8]) -> Result<(SavedStudy<'static>, &[u8]), SavedRunError> {
    let head: Option<((String, SavedStudy<'static>), &[u8])> = headed::parted(bytes);
    let ((commit, saved), run) = head.ok_or(SavedRunError::Head)?;
    if commit != COMMIT {
        return Err(SavedRunError::OtherBuild(commit));
    }
    Ok((saved, run))
}
