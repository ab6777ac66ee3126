//! Studies and their members.

use super::{broken, job_id, job_status};
use crate::jobs::job::JobStatus;
use crate::jobs::store::{
    EndedMember, Key, ListedMember, MemberOutcome, StoreError, StudySubmitted,
};
use crate::studies::study::{MemberCounts, StoredStudy, StudyId, StudyStatus};
use jiff::Timestamp;
use serde_json::value::RawValue;
use sqlx::FromRow;

/// A study.
#[derive(Debug, FromRow)]
pub(in super::super) struct StudyRow {
    sequence: i64,
    id: String,
    status: String,
    title: String,
    created_ms: i64,
    finished_ms: Option<i64>,
    document: String,
    submitter: Option<String>,
    problem: Option<String>,
    made: i64,
    in_work: i64,
}

/// A member of a list.
#[derive(Debug, FromRow)]
pub(in super::super) struct MemberRow {
    level: i64,
    member: i64,
    job_id: Option<String>,
    status: Option<String>,
    outcome: Option<String>,
}

/// A member whose job has ended.
#[derive(Debug, FromRow)]
pub(in super::super) struct EndedRow {
    level: i64,
    member: i64,
    status: Option<String>,
    outcome: Option<String>,
    problem: Option<String>,
}

impl StudyRow {
    pub(in super::super) fn read(self) -> Result<StoredStudy, StoreError> {
        let name = format!("study {}", self.id);
        let broken = |what| broken(&name, what);
        let time = |ms| Timestamp::from_millisecond(ms).map_err(|_| broken("a time"));
        let json = |text: String, what| RawValue::from_string(text).map_err(|_| broken(what));
        Ok(StoredStudy {
            id: parse_study(&self.id)?,
            sequence: self.sequence,
            status: StudyStatus::from_word(&self.status).ok_or_else(|| broken("status"))?,
            created: time(self.created_ms)?,
            finished: self.finished_ms.map(time).transpose()?,
            document: json(self.document, "document")?,
            problem: self.problem.map(|text| json(text, "problem")).transpose()?,
            members: counts(self.made, self.in_work),
            title: self.title,
            submitter: self.submitter,
        })
    }
}

impl MemberRow {
    pub(in super::super) fn read(self) -> Result<ListedMember, StoreError> {
        Ok(ListedMember {
            level: level(self.level)?,
            member: self.member.unsigned_abs(),
            job: self.job_id.map(|id| job_id(&id)).transpose()?,
            status: status_of_member(self.status)?,
            outcome: self.outcome,
        })
    }
}

impl EndedRow {
    pub(in super::super) fn read(self) -> Result<EndedMember, StoreError> {
        Ok(EndedMember {
            level: level(self.level)?,
            member: self.member.unsigned_abs(),
            status: status_of_member(self.status)?,
            outcome: self.outcome,
            problem: self.problem,
        })
    }
}

/// The outcome of a member in a row of level, number and outcome.
pub(in super::super) fn member_outcome(
    (level, member, outcome): (i64, i64, String),
) -> Result<MemberOutcome, StoreError> {
    Ok(MemberOutcome {
        level: self::level(level)?,
        member: member.unsigned_abs(),
        outcome,
    })
}

/// Numbers of members on each level, from rows of level and number.
pub(in super::super) fn made_by_level(rows: &[(i64, i64)]) -> Result<Vec<u64>, StoreError> {
    let mut made = Vec::new();
    for &(level, count) in rows {
        let level = self::level(level)? as usize;
        made.resize(made.len().max(level + 1), 0);
        made[level] = count.unsigned_abs();
    }
    Ok(made)
}

/// The study that a request with this key made before, in a row of identifier and hash.
pub(in super::super) fn former_study(
    (id, hash): (String, Vec<u8>),
    key: &Key,
) -> Result<StudySubmitted, StoreError> {
    if hash != key.request_hash {
        return Ok(StudySubmitted::OtherRequest);
    }
    Ok(StudySubmitted::Before(parse_study(&id)?))
}

pub(in super::super) fn study_status(id: StudyId, word: &str) -> Result<StudyStatus, StoreError> {
    StudyStatus::from_word(word).ok_or_else(|| broken(&format!("study {id}"), "status"))
}

pub(in super::super) fn parse_study(id: &str) -> Result<StudyId, StoreError> {
    id.parse().map_err(|_| broken(&format!("study {id}"), "id"))
}

pub(in super::super) fn counts(made: i64, in_work: i64) -> MemberCounts {
    MemberCounts {
        made: made.unsigned_abs(),
        ended: (made - in_work).unsigned_abs(),
    }
}

fn level(stored: i64) -> Result<u32, StoreError> {
    u32::try_from(stored).map_err(|_| broken("of a study", "level"))
}

fn status_of_member(word: Option<String>) -> Result<Option<JobStatus>, StoreError> {
    word.map(|word| job_status("of a study", &word)).transpose()
}
