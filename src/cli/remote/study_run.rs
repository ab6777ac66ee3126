//! `scree study` by a service: submitted, followed, and its files written here.

use super::answer::identifier;
use super::indented::indented;
use super::maps;
use super::parting::Parting;
use super::study::{self, ReceivedStudy};
use super::study_files;
use super::transport::{Submission, Transport};
use crate::cli::arguments::StudyOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::study::StudyFolder;
use crate::cli::{scenario_file, scenario_maps};
use serde_json::Value;
use std::path::Path;
use uuid::Uuid;

/// Has a study computed by a service, writes its files and prints its answers.
///
/// # Errors
/// The study is refused or fails, the service does not answer for too long, or a file can't be
/// written; once it is accepted, the study goes on, and the failure says how to get its answers.
pub(in crate::cli) fn study(options: &StudyOptions) -> Result<(), Failure> {
    let text = scenario_file::read_text(&options.study)?;
    let transport = Transport::open(&options.service)?;
    let text = with_uploaded_maps(&transport, text, &options.study)?;
    // Before anything is computed, so that a bad name costs no time.
    let folder = options.out.as_deref().map(StudyFolder::open).transpose()?;
    let parting = Parting::watch()?;
    let key = Uuid::new_v4().to_string();
    let submission = Submission::json(&text, &key);
    let answer = transport.post("/v1/studies", submission);
    let name = scenario_file::name(&options.study);
    let accepted = ReceivedStudy::read(answer.map_err(|error| error.about(&name))?)?;
    let id = identifier(&accepted.document.id)?;
    let goes_on = how_to_go_on(options, &transport, &id);
    parting.say(&goes_on);
    options.quiet.note(&format!("study {id}"));
    let fetched = fetch(options, &transport, &accepted, (&id, folder));
    fetched.map_err(|Unfinished(failure, is_running)| match is_running {
        true => failure.and(&format!("\n{goes_on}")),
        false => failure,
    })
}

/// The text of a study with the maps of its scenario uploaded; one without maps as it is.
fn with_uploaded_maps(transport: &Transport, text: String, file: &Path) -> Result<String, Failure> {
    let Ok(mut study) = serde_json::from_str::<Value>(&text) else {
        return Ok(text);
    };
    let Some(scenario) = study.get_mut("scenario") else {
        return Ok(text);
    };
    *scenario = scenario_maps::absolute(scenario.take(), file);
    if scenario_maps::files(scenario).is_empty() {
        return Ok(text);
    }
    maps::upload(transport, scenario)?;
    Ok(study.to_string())
}

/// Failure, and whether the study goes on or its answers can still be fetched.
struct Unfinished(Failure, bool);

impl From<Failure> for Unfinished {
    fn from(failure: Failure) -> Self {
        Self(failure, true)
    }
}

fn fetch(
    options: &StudyOptions,
    transport: &Transport,
    accepted: &ReceivedStudy,
    (id, folder): (&Uuid, Option<StudyFolder>),
) -> Result<(), Unfinished> {
    let folder = match folder {
        Some(folder) => {
            let there = folder.begin(&accepted.study()?)?;
            Some((folder, there))
        }
        None => None,
    };
    let ended = study::follow(transport, id, options.quiet)?;
    ended
        .success()
        .map_err(|failure| Unfinished(failure, false))?;
    let answers = study::answers(transport, id)?;
    if let Some((folder, there)) = folder {
        study_files::write(transport, (id, &ended), &answers, (&folder, there))?;
    }
    Ok(print(options, &ended, &answers)?)
}

fn how_to_go_on(options: &StudyOptions, transport: &Transport, id: &Uuid) -> String {
    let watch = transport.command(&format!("watch {id}"));
    let get = match &options.out {
        Some(out) => format!("get {id} --out {}", out.display()),
        None => format!("get {id}"),
    };
    let get = transport.command(&get);
    format!("the study goes on: {watch} follows it, {get} fetches its answers")
}

fn print(options: &StudyOptions, study: &ReceivedStudy, answers: &str) -> Result<(), Failure> {
    let text = if options.json {
        indented(answers)
    } else {
        let text = study::in_words(study, answers)?;
        match &options.out {
            Some(out) => format!("{text}\n\nwritten to {}", out.display()),
            None => text,
        }
    };
    Ok(console::answer(&text)?)
}
