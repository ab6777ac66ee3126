//! Directory of a study: its members as they end, and its answers.

use crate::cli::failure::Failure;
use crate::cli::files::{self, FileError, failed};
use scree::studies::export;
use scree_studies::{Answers, Ensemble, Member, Study};
use std::fs::{self, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// File with the study.
const STUDY: &str = "study.json";

/// File with a member on each line, in the order in which they ended.
const MEMBERS: &str = "members.ndjson";

/// File with the answers.
pub(in crate::cli) const ANSWERS: &str = "answers.json";

/// Directory of a study.
pub(in crate::cli) struct StudyFolder(PathBuf);

impl StudyFolder {
    /// Opens the directory, or makes it.
    ///
    /// # Errors
    /// It can't be made.
    pub(in crate::cli) fn open(path: &Path) -> Result<Self, Failure> {
        fs::create_dir_all(path).map_err(|error| Failure::path("make", path, &error))?;
        Ok(Self(path.to_owned()))
    }

    /// Begins a study, or goes on with the one that is there; returns its members that have ended.
    ///
    /// # Errors
    /// The directory holds another study, or can't be used.
    pub(in crate::cli) fn begin(&self, study: &Study) -> Result<Vec<Member>, Failure> {
        let path = self.0.join(STUDY);
        let members = match fs::read_to_string(&path) {
            Ok(text) => {
                let former: Option<Study> = serde_json::from_str(&text).ok();
                if !former.is_some_and(|former| goes_on(&former, study)) {
                    return Err(Failure::Input(format!(
                        "{} holds another study: name another directory, or remove it",
                        self.0.display()
                    )));
                }
                self.members()?
            }
            Err(error) if error.kind() == ErrorKind::NotFound => {
                if self.0.join(MEMBERS).exists() {
                    return Err(Failure::Input(format!(
                        "{} holds members of an unknown study: name another directory, or remove it",
                        self.0.display()
                    )));
                }
                Vec::new()
            }
            Err(error) => return Err(Failure::path("read", &path, &error)),
        };
        let text = serde_json::to_string_pretty(study)?;
        files::replace(&path, text.as_bytes())?;
        Ok(members)
    }

    /// Members that have ended. A last line that a crash cut off is left out, and removed.
    fn members(&self) -> Result<Vec<Member>, Failure> {
        let path = self.0.join(MEMBERS);
        let Ok(text) = fs::read_to_string(&path) else {
            return Ok(Vec::new());
        };
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        if whole.len() < text.len() {
            files::replace(&path, whole.as_bytes())?;
        }
        let members = whole.lines().map(serde_json::from_str);
        members.collect::<Result<_, _>>().map_err(|error| {
            Failure::Input(format!("{} is no list of members: {error}", path.display()))
        })
    }

    /// Keeps a member that has ended.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn keep(&self, member: &Member) -> Result<(), FileError> {
        let path = self.0.join(MEMBERS);
        let mut line = serde_json::to_string(member).unwrap_or_default();
        line.push('\n');
        let appended = OpenOptions::new()
            .create(true)
            .append(true)
            .open(&path)
            .and_then(|mut file| file.write_all(line.as_bytes()));
        appended.map_err(failed("write", &path))
    }

    /// Keeps these members in place of those that were there.
    ///
    /// # Errors
    /// The file can't be written; it is then as before.
    pub(in crate::cli) fn keep_only(
        &self,
        members: impl IntoIterator<Item = Member>,
    ) -> Result<(), Failure> {
        let mut lines = String::new();
        for member in members {
            lines.push_str(&serde_json::to_string(&member)?);
            lines.push('\n');
        }
        self.replace(MEMBERS, lines.as_bytes())
    }

    /// Replaces a file by these contents.
    ///
    /// # Errors
    /// The file can't be written; it is then as before.
    pub(in crate::cli) fn replace(&self, name: &str, contents: &[u8]) -> Result<(), Failure> {
        Ok(files::replace(&self.0.join(name), contents)?)
    }

    /// Writes the answers.
    ///
    /// # Errors
    /// A file can't be written.
    pub(super) fn deliver(
        &self,
        ensemble: &Ensemble,
        members: &[Member],
        answers: &Answers,
    ) -> Result<(), Failure> {
        let text = serde_json::to_string_pretty(answers)?;
        self.replace(ANSWERS, text.as_bytes())?;
        let text = serde_json::to_string_pretty(ensemble.study())?;
        self.replace(STUDY, text.as_bytes())?;
        for (name, contents) in export::files(ensemble, members, answers)? {
            self.replace(&name, &contents)?;
        }
        Ok(())
    }
}

/// True if a study has all members of a former one: it may be larger, or ask other questions.
fn goes_on(former: &Study, study: &Study) -> bool {
    let same = former.scenario == study.scenario
        && former.inputs == study.inputs
        && former.correlations == study.correlations;
    let larger = former.design.can_be_enlarged_to(&study.design)
        || study.design.can_be_enlarged_to(&former.design);
    let levels = former.levels_go_on_in(study) || study.levels_go_on_in(former);
    same && larger && levels
}
