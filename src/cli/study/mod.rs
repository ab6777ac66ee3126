//! `scree study`: one scenario computed many times, in this process or by a service.

mod folder;
mod progress;
mod table;

use super::arguments::StudyOptions;
use super::console;
use super::failure::Failure;
use super::interrupts::Interrupts;
use super::machine::cores;
use super::remote;
use super::{scenario_file, scenario_maps};
pub(super) use folder::{ANSWERS, StudyFolder};
pub(super) use progress::MemberNotes;
use scree::runs::Stop;
use scree::studies::schedule::{Conclusion, conclusion};
use scree::studies::{local, questions};
use scree_solver::scenario::{Maps, Scenario, ScenarioError};
use scree_studies::{Answers, Ensemble, Member, MemberId, Study};
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;
pub(super) use table::answers as in_words_of;

/// Computes a study, writes its files and prints its answers.
///
/// # Errors
/// See [`Failure`]; members that had ended by then are in the directory, and are not computed
/// again by the same command.
pub(super) fn study(options: &StudyOptions) -> Result<(), Failure> {
    if options.service.are_given() {
        return remote::study(options);
    }
    let (mut study, maps) = read(&options.study)?;
    let folder = options.out.as_deref().map(StudyFolder::open).transpose()?;
    let mut members = match &folder {
        Some(folder) => folder.begin(&study)?,
        None => Vec::new(),
    };
    let interrupts = Interrupts::watch(Stop::AtOnce)?;
    let at_once = options.threads.map_or_else(cores, usize::from);
    loop {
        let ensemble = Ensemble::of(&study).map_err(|found| Failure::Input(in_words(&found)))?;
        let missing = missing(&study, &members);
        if !missing.is_empty() {
            let mut computing = Computing::new(options, (missing.len(), study.runs()), members);
            let control = (at_once, interrupts.stop());
            local::compute((&ensemble, &maps), &missing, control, |member| {
                computing.take(member, folder.as_ref());
            });
            members = computing.end()?;
            if interrupts.stop().is_raised() {
                return Err(stopped(&interrupts, &members, folder.is_some()));
            }
        }
        match conclusion(&ensemble, &members, |scenario| is_allowed(scenario, &maps)) {
            Conclusion::Enlarge(larger) => study = *larger,
            Conclusion::End => break,
        }
    }
    members.sort_by_key(Member::id);
    let ensemble = Ensemble::of(&study).map_err(|found| Failure::Input(in_words(&found)))?;
    let answers = Answers::of(&ensemble, &members);
    if let Some(folder) = &folder {
        folder.deliver(&ensemble, &members, &answers)?;
    }
    answer(options, &study, &answers)
}

/// Reads a study with the maps of its scenario, and checks both ends of every input.
fn read(file: &Path) -> Result<(Study, Maps), Failure> {
    let (text, name) = (scenario_file::read_text(file)?, scenario_file::name(file));
    let mut study: Study = serde_json::from_str(&text)
        .map_err(|error| Failure::Input(format!("{name} is no study: {error}")))?;
    let maps;
    (study.scenario, maps) = scenario_maps::load(scenario_maps::absolute(study.scenario, file))?;
    let ensemble = Ensemble::of(&study)
        .map_err(|found| Failure::Input(format!("{name} breaks rules:\n{}", in_words(&found))))?;
    let mut found = in_words(&questions::violations(&study));
    for end in ensemble.end_scenarios() {
        let faults = match Scenario::from_value_with(&end.scenario, &maps) {
            Ok(_) => continue,
            Err(ScenarioError::Invalid(faults)) => faults
                .iter()
                .map(|fault| format!("\n    {}: {}", fault.pointer, fault.detail))
                .collect(),
            Err(error @ ScenarioError::Malformed { .. }) => error.to_string(),
        };
        let (place, value) = (&study.inputs[end.input].pointer, &end.value);
        found.push_str(&format!("\n  with {place} = {value}:{faults}"));
    }
    if !found.is_empty() {
        let found = found.trim_start_matches('\n');
        return Err(Failure::Input(format!("{name} breaks rules:\n{found}")));
    }
    Ok((study, maps))
}

fn in_words(violations: &[scree_studies::Violation]) -> String {
    let line = |violation: &scree_studies::Violation| {
        format!("  {}: {}", violation.pointer, violation.message)
    };
    violations.iter().map(line).collect::<Vec<_>>().join("\n")
}

fn is_allowed(scenario: &Value, maps: &Maps) -> bool {
    Scenario::from_value_with(scenario, maps).is_ok()
}

/// Members of the design that have no outcome yet.
fn missing(study: &Study, members: &[Member]) -> Vec<MemberId> {
    let there: BTreeSet<MemberId> = members.iter().map(Member::id).collect();
    study.ids().filter(|id| !there.contains(id)).collect()
}

/// Members that are being computed.
struct Computing {
    all: u64,
    done: u64,
    notes: MemberNotes,
    members: Vec<Member>,
    broken: Option<Failure>,
}

impl Computing {
    /// Members of which so many are missing, of all of a study.
    fn new(options: &StudyOptions, (missing, all): (usize, u64), members: Vec<Member>) -> Self {
        let done = all - missing as u64;
        Self {
            all,
            done,
            notes: MemberNotes::new(options.quiet, done),
            members,
            broken: None,
        }
    }

    fn take(&mut self, member: Member, folder: Option<&StudyFolder>) {
        if let Some(Err(error)) = folder.map(|folder| folder.keep(&member)) {
            self.broken.get_or_insert(error.into());
        }
        self.members.push(member);
        self.done += 1;
        self.notes.show(self.done, self.all);
    }

    fn end(self) -> Result<Vec<Member>, Failure> {
        self.broken.map_or(Ok(self.members), Err)
    }
}

fn stopped(interrupts: &Interrupts, members: &[Member], is_kept: bool) -> Failure {
    let done = members.len();
    let what = if is_kept {
        format!("; the same command goes on from the {done} members that have ended")
    } else {
        String::new()
    };
    Failure::Stopped(interrupts.first(), what)
}

/// Prints the answers, and where the files are.
fn answer(options: &StudyOptions, study: &Study, answers: &Answers) -> Result<(), Failure> {
    let text = if options.json {
        serde_json::to_string_pretty(answers)?
    } else {
        let mut text = table::answers(study, answers);
        if let Some(out) = &options.out {
            text = format!("{text}\n\nwritten to {}", out.display());
        }
        text
    };
    let printed = match options.out {
        Some(_) => console::answer(&text),
        None => console::only_answer(&text),
    };
    Ok(printed?)
}
