//! `scree get`: outcome and results of a job, answers of a study, or a list of jobs.

use super::indented::indented;
use super::job::{self, ReceivedJob};
use super::job_files::JobFiles;
use super::study::{self, ReceivedStudy};
use super::transport::Transport;
use super::{listing, study_files};
use crate::cli::arguments::GetOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::results_folder::{Formats, ResultsFolder};
use crate::cli::study::StudyFolder;
use std::path::Path;
use uuid::Uuid;

/// Prints what is asked for, and writes its files.
///
/// # Errors
/// There is no such job or study, the service does not answer, the job gave no outcome, or a file
/// can't be written.
pub(in crate::cli) fn get(options: &GetOptions) -> Result<(), Failure> {
    let transport = Transport::open(&options.service)?;
    let Some(id) = &options.id else {
        return listing::list(&transport, options);
    };
    if let Some(job) = job::find(&transport, id)? {
        return get_job(&transport, options, (id, &job));
    }
    match study::find(&transport, id)? {
        Some(study) => get_study(&transport, options, (id, &study)),
        None => Err(job::unknown(&transport, id)),
    }
}

fn get_job(
    transport: &Transport,
    options: &GetOptions,
    (id, job): (&Uuid, &ReceivedJob),
) -> Result<(), Failure> {
    if options.json {
        console::answer(&indented(&job.text))?;
    }
    if !job.document.has_ended() {
        return unended(transport, options, (id, job));
    }
    let formats = Formats::asked(&options.format).unwrap_or_default();
    let files = JobFiles {
        transport,
        id,
        job,
        formats: &formats,
    };
    let folder = options.out.as_deref().map(ResultsFolder::for_new_run);
    let folder = folder.transpose()?;
    let outcome = match (job.outcome(), &folder) {
        (Ok(outcome), _) => outcome,
        (Err(failure), None) => return Err(failure),
        (Err(failure), Some(folder)) => {
            let written = files.until_failure(folder)?;
            let more = format!("\nthe trajectories until then are in {written}");
            return Err(failure.and(&more));
        }
    };
    let written = folder.as_ref().map(|folder| files.results(folder));
    let written = written.transpose()?;
    print(options, &job::in_words(&outcome), written.as_deref())
}

/// Tells how far a job is, which has no files yet.
fn unended(
    transport: &Transport,
    options: &GetOptions,
    (id, job): (&Uuid, &ReceivedJob),
) -> Result<(), Failure> {
    if options.out.is_some() {
        let watch = transport.command(&format!("watch {id}"));
        return Err(Failure::Other(format!(
            "job {id} has no results yet: it {}; {watch} follows it",
            job::progress_in_words(&job.document)
        )));
    }
    print(options, &job::progress_in_words(&job.document), None)
}

fn get_study(
    transport: &Transport,
    options: &GetOptions,
    (id, study): (&Uuid, &ReceivedStudy),
) -> Result<(), Failure> {
    if options.json {
        console::answer(&indented(&study.text))?;
    }
    let answers = study::answers(transport, id)?;
    if let Some(out) = &options.out {
        let folder = StudyFolder::open(out)?;
        let there = folder.begin(&study.study()?)?;
        study_files::write(transport, (id, study), &answers, (&folder, there))?;
    }
    let progress = study.progress_in_words();
    let text = format!("{progress}\n\n{}", study::in_words(study, &answers)?);
    let written = options.out.as_deref().map(Path::display);
    let written = written.map(|out| out.to_string());
    print(options, &text, written.as_deref())
}

fn print(options: &GetOptions, text: &str, written: Option<&str>) -> Result<(), Failure> {
    if options.json {
        return Ok(());
    }
    let text = match written {
        Some(written) => format!("{text}\n\nwritten to {written}"),
        None => text.to_owned(),
    };
    Ok(console::answer(&text)?)
}
