//! The state of several runs as bytes: what those before gave, then the run in hand.

use super::headed;
use super::saved_run::{COMMIT, SavedRunError};
use scree_solver::record::{Outcome, Record};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Knowledge of a convergence study besides the run in hand.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SavedStudy<'a> {
    /// Outcome of each run before, in turn.
    pub done: Vec<Result<Outcome, String>>,
    /// Records of the finest run before, if it may be the answer.
    pub kept: Cow<'a, [Record]>,
    /// Records of the run in hand, if it may be.
    pub of_run: Cow<'a, [Record]>,
}

/// Bytes from which [`read`] makes both again.
pub(super) fn write(saved: &SavedStudy, run: &[u8]) -> Vec<u8> {
    headed::joined(&(COMMIT, saved), run)
}

/// What was written, and the run's own bytes.
///
/// # Errors
/// Bytes of something else, or of another build.
pub(super) fn read(bytes: &[u8]) -> Result<(SavedStudy<'static>, &[u8]), SavedRunError> {
    let head: Option<((String, SavedStudy<'static>), &[u8])> = headed::parted(bytes);
    let ((commit, saved), run) = head.ok_or(SavedRunError::Head)?;
    if commit != COMMIT {
        return Err(SavedRunError::OtherBuild(commit));
    }
    Ok((saved, run))
}
