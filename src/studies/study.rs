//! A study as seen outside the database.

use crate::jobs::identifier::identifier;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use utoipa::ToSchema;

identifier! {
    /// Identifier of a study.
    StudyId
}

/// State of a study, in the words of OGC API – Processes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum StudyStatus {
    /// Members are being made or computed.
    Running,
    /// All members have ended, or as many as its stopping rule asked for.
    Successful,
    /// Members can't be made.
    Failed,
    /// Cancelled; the members that had ended by then are kept.
    Dismissed,
}

impl StudyStatus {
    /// All states, in the order of a study's life.
    pub const ALL: [Self; 4] = [
        Self::Running,
        Self::Successful,
        Self::Failed,
        Self::Dismissed,
    ];

    /// Name of the state.
    pub fn word(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Successful => "successful",
            Self::Failed => "failed",
            Self::Dismissed => "dismissed",
        }
    }

    /// The state with this name.
    pub fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.word() == word)
    }
}

/// A study and the numbers of its members.
#[derive(Debug, Clone)]
pub struct StoredStudy {
    /// Identifier.
    pub id: StudyId,
    /// Order of submission.
    pub sequence: i64,
    /// State.
    pub status: StudyStatus,
    /// Its title.
    pub title: String,
    /// Time of submission.
    pub created: Timestamp,
    /// Time of the end; none before.
    pub finished: Option<Timestamp>,
    /// Name of the access token of the submitter; none if none is required.
    pub submitter: Option<String>,
    /// The study's JSON.
    pub document: Box<RawValue>,
    /// The failure's JSON; none unless failed.
    pub problem: Option<Box<RawValue>>,
    /// Members made so far.
    pub members: MemberCounts,
}

/// Members of a study that have been made, over all grid levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, ToSchema)]
pub struct MemberCounts {
    /// Members made.
    pub made: u64,
    /// Those whose job has ended.
    pub ended: u64,
}
