//! The state of several runs as bytes: what those before gave, then the run in hand.

use super::saved_run::{COMMIT, SavedRunError};
use scree_solver::record::{Outcome, Record};
use serde::{Deserialize, Serialize};

/// What is known besides the run in hand.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SavedCampaign {
    /// What came of each run before, in turn.
    pub done: Vec<Result<Outcome, String>>,
    /// Records of the finest run before, if it may be the answer.
    pub kept: Vec<Record>,
    /// Records of the run in hand, if it may be.
    pub of_run: Vec<Record>,
}

/// Bytes from which [`read`] makes both again: the head's length (u64, little-endian),
/// the head, the run's own bytes.
pub(super) fn write(saved: &SavedCampaign, run: &[u8]) -> Vec<u8> {
    let head = postcard::to_allocvec(&(COMMIT, saved)).expect("plain data always serialises");
    let mut bytes = Vec::with_capacity(8 + head.len() + run.len());
    bytes.extend((head.len() as u64).to_le_bytes());
    bytes.extend(head);
    bytes.extend(run);
    bytes
}

/// What was written, and the run's own bytes.
///
/// # Errors
/// Bytes of something else, or of another build.
pub(super) fn read(bytes: &[u8]) -> Result<(SavedCampaign, &[u8]), SavedRunError> {
    let (length, rest) = bytes.split_first_chunk::<8>().ok_or(SavedRunError::Head)?;
    let length = usize::try_from(u64::from_le_bytes(*length)).map_err(|_| SavedRunError::Head)?;
    let (head, run) = rest.split_at_checked(length).ok_or(SavedRunError::Head)?;
    let (commit, saved): (String, SavedCampaign) =
        postcard::from_bytes(head).map_err(|_| SavedRunError::Head)?;
    if commit != COMMIT {
        return Err(SavedRunError::OtherBuild(commit));
    }
    Ok((saved, run))
}
