//! `scree submit`: scenarios become jobs of a service.

use super::answer::identifier;
use super::job::{self, ReceivedJob};
use super::maps;
use super::parting::Parting;
use super::transport::{Submission, Transport};
use crate::cli::arguments::SubmitOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use crate::cli::scenario_file;
use uuid::Uuid;

/// A scenario to submit.
struct Scenario {
    name: String,
    text: String,
}

/// Submits scenarios, prints the identifiers of their jobs, and waits for their ends if asked to.
///
/// # Errors
/// A file can't be read, and then none is submitted; a scenario is refused, and then those before
/// it are jobs; or, of those waited for, the job's.
pub(in crate::cli) fn submit(options: &SubmitOptions) -> Result<(), Failure> {
    let read = |path| {
        let (name, text) = (scenario_file::name(path), scenario_file::read_text(path)?);
        Ok::<_, Failure>(Scenario { name, text })
    };
    let scenarios = options.scenarios.iter().map(|path| read(path));
    let scenarios: Vec<_> = scenarios.collect::<Result<_, _>>()?;
    let transport = Transport::open(&options.service)?;
    let path = path(&options.label);
    let parting = options.wait.then(Parting::watch).transpose()?;
    let mut ids = Vec::new();
    for (place, scenario) in scenarios.iter().enumerate() {
        let job = send(&transport, &path, scenario)
            .map_err(|failure| without_the_rest(failure, &scenarios[place + 1..]))?;
        let id = identifier(&job.document.id)?;
        ids.push(id);
        if let Some(parting) = &parting {
            parting.say(&how_to_go_on(&transport, &ids));
        }
        if !options.json {
            console::answer(&id.to_string())?;
        } else if !options.wait {
            console::answer(&job.text)?;
        }
    }
    if options.wait {
        wait(options, &transport, &ids)?;
    }
    Ok(())
}

fn path(labels: &[String]) -> String {
    if labels.is_empty() {
        return "/v1/jobs".to_owned();
    }
    let mut query = form_urlencoded::Serializer::new(String::new());
    for label in labels {
        query.append_pair("label", label);
    }
    format!("/v1/jobs?{}", query.finish())
}

fn send(transport: &Transport, path: &str, scenario: &Scenario) -> Result<ReceivedJob, Failure> {
    let text = maps::with_uploaded(transport, &scenario.text)?;
    let key = Uuid::new_v4().to_string();
    let submission = Submission::json(&text, &key);
    let answer = transport.post(path, submission);
    ReceivedJob::read(answer.map_err(|error| error.about(&scenario.name))?)
}

/// The failure of a scenario, with those that come after it and were not submitted.
fn without_the_rest(failure: Failure, rest: &[Scenario]) -> Failure {
    if rest.is_empty() {
        return failure;
    }
    let names: Vec<_> = rest.iter().map(|scenario| scenario.name.as_str()).collect();
    failure.and(&format!("\n\nnot submitted: {}", names.join(", ")))
}

/// Follows the jobs one after the other.
fn wait(options: &SubmitOptions, transport: &Transport, ids: &[Uuid]) -> Result<(), Failure> {
    let mut last_failure: Option<Failure> = None;
    for id in ids {
        let job = job::follow(transport, id, options.quiet)
            .map_err(|failure| failure.and(&format!("\n{}", how_to_go_on(transport, ids))))?;
        if options.json {
            console::answer(&job.text)?;
        }
        match job.outcome() {
            Ok(_) => options.quiet.note(&format!("job {id} is successful")),
            Err(failure) => {
                if let Some(earlier) = last_failure.replace(failure) {
                    earlier.report();
                }
            }
        }
    }
    last_failure.map_or(Ok(()), Err)
}

fn how_to_go_on(transport: &Transport, ids: &[Uuid]) -> String {
    let commands = ids
        .iter()
        .map(|id| transport.command(&format!("watch {id}")));
    let commands: Vec<_> = commands.collect();
    match ids {
        [_] => format!("the job goes on: {} follows it", commands.join(", ")),
        _ => format!("the jobs go on: {} follow them", commands.join(", ")),
    }
}
