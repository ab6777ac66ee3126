//! `scree watch`: a job or study until it ends.

use super::indented::indented;
use super::parting::Parting;
use super::transport::Transport;
use super::{job, study};
use crate::cli::arguments::WatchOptions;
use crate::cli::console;
use crate::cli::failure::Failure;

/// Follows a job or study to its end, and prints its outcome or answers.
///
/// # Errors
/// There is none with this identifier, the service does not answer for too long, or the job or
/// study gave nothing.
pub(in crate::cli) fn watch(options: &WatchOptions) -> Result<(), Failure> {
    let (transport, id) = (Transport::open(&options.service)?, &options.id);
    let is_job = job::find(&transport, id)?.is_some();
    let goes_on = transport.command(&format!("watch {id}"));
    let kind = if is_job { "job" } else { "study" };
    Parting::watch()?.say(&format!("the {kind} goes on: {goes_on} follows it"));
    if is_job {
        return watch_job(&transport, options);
    }
    match study::find(&transport, id)? {
        Some(_) => watch_study(&transport, options),
        None => Err(job::unknown(&transport, id)),
    }
}

fn watch_job(transport: &Transport, options: &WatchOptions) -> Result<(), Failure> {
    let job = job::follow(transport, &options.id, options.quiet)?;
    if options.json {
        console::answer(&indented(&job.text))?;
    }
    let outcome = job.outcome()?;
    if !options.json {
        console::answer(&job::in_words(&outcome))?;
    }
    Ok(())
}

fn watch_study(transport: &Transport, options: &WatchOptions) -> Result<(), Failure> {
    let study = study::follow(transport, &options.id, options.quiet)?;
    if options.json {
        console::answer(&indented(&study.text))?;
    }
    study.success()?;
    if !options.json {
        let answers = study::answers(transport, &options.id)?;
        console::answer(&study::in_words(&study, &answers)?)?;
    }
    Ok(())
}
