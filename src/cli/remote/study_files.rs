//! Files of a study, in the names that `scree study` gives them.

use super::answer::{text, understood};
use super::indented::indented;
use super::study::{self, ReceivedStudy};
use super::transport::Transport;
use crate::cli::failure::Failure;
use crate::cli::study::{ANSWERS, StudyFolder};
use scree_studies::{Member, MemberId, MemberOutcome, Question, Study};
use serde::Deserialize;
use std::collections::BTreeMap;
use uuid::Uuid;

/// Members of a page, the most that the service gives.
const PAGE: u32 = 1_000;

/// A page of members.
#[derive(Deserialize)]
struct Page {
    members: Vec<Listed>,
    next: Option<u64>,
}

/// A member of a page.
#[derive(Deserialize)]
struct Listed {
    level: u32,
    member: u64,
    outcome: Option<MemberOutcome>,
}

/// Writes the answers so far, and what belongs to them, into the folder, in which these members
/// are from earlier.
///
/// # Errors
/// No answer, a refusal, or a file that can't be written.
pub(super) fn write(
    transport: &Transport,
    (id, study): (&Uuid, &ReceivedStudy),
    answers: &str,
    (folder, there): (&StudyFolder, Vec<Member>),
) -> Result<(), Failure> {
    let study = study.study()?;
    // By which `scree study` goes on with what the service has computed.
    folder.keep_only(members(transport, id, &study, there)?)?;
    for (name, path) in files(&study) {
        let path = format!("{}/{path}", study::path(id));
        // Of a question that has no answer yet there is no file.
        if let Some(contents) = transport.get_if_there(&path)? {
            folder.replace(&name, &contents)?;
        }
    }
    folder.replace(ANSWERS, indented(answers).as_bytes())
}

/// Members that have an outcome, those from earlier that the study no longer has among them.
fn members(
    transport: &Transport,
    id: &Uuid,
    study: &Study,
    there: Vec<Member>,
) -> Result<impl Iterator<Item = Member>, Failure> {
    let there = there.into_iter().map(|member| (member.id(), member));
    let mut members: BTreeMap<MemberId, Member> = there.collect();
    for level in 0..study.levels() {
        let mut next = Some(0);
        while let Some(from) = next {
            let query = format!("level={level}&from={from}&limit={PAGE}");
            let answer = transport.get(&format!("{}/members?{query}", study::path(id)))?;
            let page: Page = understood(&text(answer)?)?;
            let ended = page.members.into_iter().filter_map(Listed::with_outcome);
            members.extend(ended.map(|member| (member.id(), member)));
            next = page.next;
        }
    }
    Ok(members.into_values())
}

impl Listed {
    fn with_outcome(self) -> Option<Member> {
        Some(Member {
            level: self.level,
            index: self.member,
            outcome: self.outcome.filter(|one| *one != MemberOutcome::Pending)?,
        })
    }
}

/// Names of the files, and their paths below the study's.
fn files(study: &Study) -> Vec<(String, String)> {
    let mut files: Vec<_> = ["members.csv", "members.npz", "scatter.svg"]
        .map(|name| (name.to_owned(), name.to_owned()))
        .into();
    for (place, question) in study.questions.iter().enumerate() {
        let (kind, endings): (_, &[_]) = match question {
            Question::Rest(_) => ("rest", &["geojson", "tif", "svg"]),
            Question::Sensitivity(_) => ("sensitivity", &["svg"]),
            _ => continue,
        };
        files.extend(endings.iter().map(|ending| {
            (
                format!("{kind}-{place}.{ending}"),
                format!("{kind}.{ending}?question={place}"),
            )
        }));
    }
    files
}
