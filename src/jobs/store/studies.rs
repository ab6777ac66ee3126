//! Port between studies and their database: a store of jobs that keeps studies, too.

use super::{JobStore, Key, Removal, Room, StoreError};
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::submit::NewJob;
use crate::studies::study::{MemberCounts, StoredStudy, StudyId, StudyStatus};
use crate::terrains::TerrainHash;
use async_trait::async_trait;

type Answer<T> = Result<T, StoreError>;

/// A database of jobs and studies. As for [`JobStore`], every call is one transaction.
///
/// # Errors
/// As for [`JobStore`].
#[async_trait]
pub trait StudyStore: JobStore {
    /// Keeps a new study, unless its key came before or too many are running.
    async fn add_study(&self, study: &NewStudy<'_>) -> Answer<StudySubmitted>;

    /// The study, if there is one.
    async fn study(&self, id: StudyId) -> Answer<Option<StoredStudy>>;

    /// Studies, newest first.
    async fn studies(&self, page: &StudyPage) -> Answer<Vec<StoredStudy>>;

    /// Running studies in the order of their submission, with the numbers of their members.
    async fn running_studies(&self) -> Answer<Vec<(StudyId, MemberCounts)>>;

    /// Replaces this document of a study that runs or was successful by another; it runs again, if
    /// there is room for it.
    async fn enlarge_study(
        &self,
        id: StudyId,
        documents: (&str, &str),
        room: Room,
    ) -> Answer<Enlarged>;

    /// Makes members of a running study, those that are not there yet: each is a job in the
    /// queue, behind all that are no member, or an earlier job of the same submitter with the same
    /// scenario that is not failed or dismissed. Returns their number; 0 if the study runs no
    /// more.
    async fn add_members(&self, study: StudyId, members: &[NewMember]) -> Answer<usize>;

    /// Numbers of members made on each level, the coarsest first.
    async fn members_made(&self, study: StudyId) -> Answer<Vec<u64>>;

    /// Members of a study on a level, from this number on; at most `limit`.
    async fn members(
        &self,
        study: StudyId,
        from: (u32, u64),
        limit: u32,
    ) -> Answer<Vec<ListedMember>>;

    /// Members of a study whose job has ended or been removed, and whose outcome is not noted
    /// yet; a number of them at a time.
    async fn ended_members(&self, study: StudyId) -> Answer<Vec<EndedMember>>;

    /// Notes outcomes of members, each once.
    async fn note_outcomes(&self, study: StudyId, outcomes: &[MemberOutcome]) -> Answer<()>;

    /// All outcomes of a study that are noted, by level and number.
    async fn outcomes(&self, study: StudyId) -> Answer<Vec<MemberOutcome>>;

    /// Ends a running study. Members that wait or run are dismissed, unless another running study
    /// has them, too.
    async fn end_study(&self, id: StudyId, end: StudyEnd<'_>) -> Answer<StudyDismissal>;

    /// Removes a study that has ended. Those of its jobs that were made for a study, and that no
    /// other study has, are orphaned.
    async fn remove_study(&self, id: StudyId) -> Answer<Removal>;

    /// A study that ended at least this long ago [ms of operating time].
    async fn study_ended_before(&self, age_ms: i64) -> Answer<Option<StudyId>>;

    /// Removes some of the orphaned jobs and returns their number. To be called until it returns
    /// 0.
    async fn remove_orphans(&self) -> Answer<u64>;
}

/// A study to be kept.
#[derive(Debug, Clone, Copy)]
pub struct NewStudy<'a> {
    /// Its identifier.
    pub id: StudyId,
    /// Its title.
    pub title: &'a str,
    /// Its JSON.
    pub document: &'a str,
    /// Name of the access token of the request.
    pub submitter: Option<&'a str>,
    /// Its Idempotency-Key.
    pub key: Option<&'a Key>,
    /// Terrains that its members name; kept as long as the study is.
    pub terrains: &'a [TerrainHash],
    /// Largest number of studies that may run at a time: of all submitters together, and of this
    /// one.
    pub room: Room,
}

/// Result of a request to keep a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StudySubmitted {
    /// It runs.
    Accepted,
    /// The same request came before, and made this study.
    Before(StudyId),
    /// The key came with another request.
    OtherRequest,
    /// Too many studies run: their number.
    Full(u32),
    /// Too many studies of this submitter run: their number.
    QuotaSpent(u32),
    /// The study names this terrain, which does not exist, or not any more.
    NoTerrain(TerrainHash),
}

/// Selection of studies for a list, newest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StudyPage {
    /// Only studies of this state.
    pub status: Option<StudyStatus>,
    /// Only studies submitted before the one with this sequence number.
    pub before: Option<i64>,
    /// At most this many.
    pub limit: u32,
}

/// Result of a request to enlarge a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Enlarged {
    /// The study does not exist.
    Unknown,
    /// It runs with the new document.
    Done,
    /// It has another document by now, and was left as it is.
    Changed,
    /// Too many studies run, or too many of its submitter: their number.
    Full(u32),
    /// It is in this state, and can't be enlarged.
    Ended(StudyStatus),
}

/// A member to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct NewMember {
    /// Level of its cells, from the coarsest.
    pub level: u32,
    /// Number in the study's design.
    pub member: u64,
    /// Its job.
    pub work: MemberWork,
}

/// Work of making a new member.
#[derive(Debug, Clone, PartialEq)]
pub enum MemberWork {
    /// This job, or an equal one.
    Job(Box<NewJob>),
    /// Nothing: this is its outcome, as JSON.
    Nothing(String),
}

/// A member of a list.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedMember {
    /// Level of its cells, from the coarsest.
    pub level: u32,
    /// Number in the study's design.
    pub member: u64,
    /// Its job; none if its scenario is not allowed.
    pub job: Option<JobId>,
    /// State of the job; none if there is none any more.
    pub status: Option<JobStatus>,
    /// Its outcome in short, as JSON, once noted.
    pub outcome: Option<String>,
}

/// A member whose job has ended.
#[derive(Debug, Clone, PartialEq)]
pub struct EndedMember {
    /// Level of its cells, from the coarsest.
    pub level: u32,
    /// Number in the study's design.
    pub member: u64,
    /// State of its job; none if it has been removed.
    pub status: Option<JobStatus>,
    /// Outcome of the job, as JSON.
    pub outcome: Option<String>,
    /// Its failure, as JSON.
    pub problem: Option<String>,
}

/// Outcome of a member in short.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberOutcome {
    /// Level of its cells, from the coarsest.
    pub level: u32,
    /// Number in the study's design.
    pub member: u64,
    /// JSON.
    pub outcome: String,
}

/// Result of a request to end a study.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum StudyDismissal {
    /// The study does not exist.
    Unknown,
    /// It is in the state asked for, by this or an earlier request; these jobs are dismissed now.
    Done(Vec<JobId>),
    /// It had already ended in this state.
    Ended(StudyStatus),
    /// It has another document by now, and goes on.
    Changed,
}

/// End of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StudyEnd<'a> {
    /// The state it ends in.
    pub status: StudyStatus,
    /// Why it failed, as JSON.
    pub problem: Option<&'a str>,
    /// It ends only if it still has this document; `None`: whatever it has.
    pub document: Option<&'a str>,
}
