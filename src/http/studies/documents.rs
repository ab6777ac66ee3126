//! Documents of studies.

use crate::http::documents::rfc3339;
use crate::jobs::failure::Failure;
use crate::jobs::job::JobStatus;
use crate::studies::study::{StoredStudy, StudyStatus};
use scree_studies::Study;
use serde::Serialize;
use serde_json::Value;
use serde_json::value::RawValue;
use utoipa::ToSchema;

/// A study.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StudyState)]
pub(super) struct StudyDocument {
    #[serde(flatten)]
    pub summary: StudySummaryDocument,
    /// Name of the access token of the submitter; null if none is required.
    #[schema(required = true)]
    pub submitter: Option<String>,
    /// The study, as enlarged last.
    #[schema(value_type = Study)]
    pub study: Box<RawValue>,
    /// Reason of the failure; null unless failed.
    #[schema(required = true, value_type = Option<Failure>)]
    pub problem: Option<Box<RawValue>>,
}

/// A study without its document.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StudySummary)]
pub(super) struct StudySummaryDocument {
    /// Identifier.
    #[schema(format = "uuid")]
    pub id: String,
    /// State.
    pub status: StudyStatus,
    /// Title.
    pub title: String,
    /// Time of submission (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// Time at which the study ended; null before.
    #[schema(required = true, format = "date-time")]
    pub finished: Option<String>,
    /// Members of its design, on all levels together.
    pub members: u64,
    /// Members that have been made so far.
    pub members_made: u64,
    /// Members whose job has ended.
    pub members_ended: u64,
}

/// A page of studies, newest first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StudyPage)]
pub(super) struct StudyPageDocument {
    /// The studies of this page.
    pub studies: Vec<StudySummaryDocument>,
    /// Value of `cursor` for the next page; null on the last page.
    #[schema(required = true)]
    pub next_cursor: Option<String>,
}

/// A member of a study.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = ListedMember)]
pub(super) struct MemberDocument {
    /// Level of its cells, 0 the coarsest.
    pub level: u32,
    /// Number in the design.
    pub member: u64,
    /// Values of its inputs, in the order of the study's.
    pub values: Vec<Value>,
    /// Its job, which other studies may share; null if its scenario is not allowed.
    #[schema(required = true, format = "uuid")]
    pub job: Option<String>,
    /// State of the job; null if there is none any more.
    #[schema(required = true)]
    pub status: Option<JobStatus>,
    /// Its outcome in short; null before its job has ended.
    #[schema(required = true, value_type = Option<scree_studies::MemberOutcome>)]
    pub outcome: Option<Box<RawValue>>,
}

/// Members of a study on a level, in the order of the design.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = MemberPage)]
pub(super) struct MemberPageDocument {
    /// The members of this page.
    pub members: Vec<MemberDocument>,
    /// Value of `from` for the next page; null on the last page.
    #[schema(required = true)]
    pub next: Option<u64>,
}

impl From<&StoredStudy> for StudySummaryDocument {
    fn from(study: &StoredStudy) -> Self {
        Self {
            id: study.id.to_string(),
            status: study.status,
            title: study.title.clone(),
            created: rfc3339(study.created),
            finished: study.finished.map(rfc3339),
            members: members_of(study),
            members_made: study.members.made,
            members_ended: study.members.ended,
        }
    }
}

/// Members of its design; those made if its document can't be read.
fn members_of(study: &StoredStudy) -> u64 {
    let document = study.study();
    document.map_or(study.members.made, |study| study.runs())
}

impl From<StoredStudy> for StudyDocument {
    fn from(study: StoredStudy) -> Self {
        Self {
            summary: StudySummaryDocument::from(&study),
            submitter: study.submitter,
            study: study.document,
            problem: study.problem,
        }
    }
}
