//! A study of the service.

use super::answer::{text, understood};
use super::transport::Transport;
use crate::cli::arguments::Quiet;
use crate::cli::failure::Failure;
use crate::cli::job_document::Problem;
use crate::cli::study::{MemberNotes, in_words_of};
use scree_studies::{Answers, Study};
use serde::Deserialize;
use serde_json::value::RawValue;
use std::time::Duration;
use uuid::Uuid;

/// Time between two looks at a study.
const LOOK_PAUSE: Duration = Duration::from_secs(1);

/// Fields of a study that clients read.
#[derive(Debug, Deserialize)]
pub(super) struct StudyDocument {
    pub(super) id: String,
    pub(super) status: String,
    members: u64,
    members_ended: u64,
    study: Box<RawValue>,
    problem: Option<Problem>,
}

/// A study as received.
pub(super) struct ReceivedStudy {
    pub(super) document: StudyDocument,
    /// The whole document, as it came.
    pub(super) text: String,
}

impl ReceivedStudy {
    /// A study from an answer.
    ///
    /// # Errors
    /// The answer is no study.
    pub(super) fn read(answer: Vec<u8>) -> Result<Self, Failure> {
        let text = text(answer)?;
        let document = understood(&text)?;
        Ok(Self { document, text })
    }

    /// The study as submitted, or as enlarged last.
    ///
    /// # Errors
    /// It is of another version.
    pub(super) fn study(&self) -> Result<Study, Failure> {
        understood(self.document.study.get())
    }

    /// # Errors
    /// The study failed or was dismissed.
    pub(super) fn success(&self) -> Result<(), Failure> {
        let StudyDocument {
            id,
            status,
            problem,
            ..
        } = &self.document;
        match problem {
            Some(problem) => Err(problem.failure().of(&format!("study {id}"))),
            None if status == "dismissed" => {
                Err(Failure::Other(format!("study {id} was dismissed")))
            }
            None => Ok(()),
        }
    }

    /// State, and how many members have ended.
    pub(super) fn progress_in_words(&self) -> String {
        let StudyDocument {
            status,
            members,
            members_ended,
            ..
        } = &self.document;
        format!("{status}, {members_ended} of {members} members")
    }
}

/// Path of a study.
pub(super) fn path(id: &Uuid) -> String {
    format!("/v1/studies/{id}")
}

/// The study with this identifier; none if there is no such study.
///
/// # Errors
/// No answer, or another refusal.
pub(super) fn find(transport: &Transport, id: &Uuid) -> Result<Option<ReceivedStudy>, Failure> {
    let answer = transport.get_if_there(&path(id))?;
    answer.map(ReceivedStudy::read).transpose()
}

/// Tells of the progress of a study until it has ended.
///
/// # Errors
/// No answer for too long, or a refusal.
pub(super) fn follow(
    transport: &Transport,
    id: &Uuid,
    quiet: Quiet,
) -> Result<ReceivedStudy, Failure> {
    let mut notes: Option<MemberNotes> = None;
    loop {
        let study = ReceivedStudy::read(transport.get(&path(id))?)?;
        let document = &study.document;
        if document.status != "running" {
            return Ok(study);
        }
        let (done, all) = (document.members_ended, document.members);
        notes
            .get_or_insert_with(|| MemberNotes::new(quiet, done))
            .show(done, all);
        std::thread::sleep(LOOK_PAUSE);
    }
}

/// Text of the answers so far.
///
/// # Errors
/// No answer, or a refusal.
pub(super) fn answers(transport: &Transport, id: &Uuid) -> Result<String, Failure> {
    text(transport.get(&format!("{}/answers", path(id)))?)
}

/// Answers as `scree study` prints them.
///
/// # Errors
/// They are of another version.
pub(super) fn in_words(study: &ReceivedStudy, answers: &str) -> Result<String, Failure> {
    let answers: Answers = understood(answers)?;
    Ok(in_words_of(&study.study()?, &answers))
}
