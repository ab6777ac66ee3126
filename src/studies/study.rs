//! A study as seen outside the database.

use crate::jobs::identifier::identifier;
use jiff::Timestamp;
use scree_studies::{Ensemble, Study, Violation};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use thiserror::Error;
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

/// Reason why the document of a stored study can't be used.
#[derive(Debug, Error)]
pub enum UnusableStudy {
    /// It is no study.
    #[error("the stored study can't be read: {0}")]
    Unreadable(#[from] serde_json::Error),
    /// It is a study that breaks rules: the first.
    #[error("the stored study breaks rules: {0}")]
    BreaksRules(String),
}

impl From<Vec<Violation>> for UnusableStudy {
    fn from(found: Vec<Violation>) -> Self {
        let first = found.into_iter().next();
        Self::BreaksRules(first.map_or_else(String::new, |violation| violation.message))
    }
}

impl StoredStudy {
    /// Study that its document describes.
    ///
    /// # Errors
    /// The document is no study.
    pub fn study(&self) -> Result<Study, UnusableStudy> {
        Ok(serde_json::from_str(self.document.get())?)
    }

    /// Result of `make` with the members that the study describes.
    ///
    /// # Errors
    /// The document is no study, or breaks rules.
    pub fn with_ensemble<T>(&self, make: impl FnOnce(&Ensemble) -> T) -> Result<T, UnusableStudy> {
        let study = self.study()?;
        Ok(make(&Ensemble::of(&study)?))
    }
}
