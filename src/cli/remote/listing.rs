//! The newest jobs.

use super::answer::{text, understood};
use super::indented::indented;
use super::transport::Transport;
use crate::cli::arguments::GetOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use scree::runs::Progress;
use serde::Deserialize;

/// Jobs that are listed, if no number is given.
const USUAL: u32 = 20;

/// A page of jobs.
#[derive(Deserialize)]
struct Page {
    jobs: Vec<Listed>,
}

/// A job of a page.
#[derive(Deserialize)]
struct Listed {
    id: String,
    status: String,
    title: String,
    created: String,
    progress: Progress,
    labels: Vec<String>,
}

/// Prints the newest jobs, one on a line.
///
/// # Errors
/// No answer, or a refusal.
pub(super) fn list(transport: &Transport, options: &GetOptions) -> Result<(), Failure> {
    let answer = text(transport.get(&path(options))?)?;
    if options.json {
        return Ok(console::answer(&indented(&answer))?);
    }
    let page: Page = understood(&answer)?;
    let lines: Vec<_> = page.jobs.iter().map(line).collect();
    if lines.is_empty() {
        console::note("no jobs");
        return Ok(());
    }
    Ok(console::answer(&lines.join("\n"))?)
}

fn path(options: &GetOptions) -> String {
    let mut query = form_urlencoded::Serializer::new(String::new());
    let limit = options.limit.unwrap_or(USUAL);
    query.append_pair("limit", &limit.to_string());
    for status in &options.status {
        query.append_pair("status", &status.word());
    }
    if let Some(label) = &options.label {
        query.append_pair("label", label);
    }
    format!("/v1/jobs?{}", query.finish())
}

fn line(job: &Listed) -> String {
    // To the second.
    let created = job.created.split('.').next().unwrap_or_default();
    let percent = (100.0 * job.progress.fraction).floor();
    let mut line = format!(
        "{}  {created}  {:<10}  {percent:>3} %  {}",
        job.id, job.status, job.title
    );
    if !job.labels.is_empty() {
        line.push_str(&format!("  [{}]", job.labels.join(", ")));
    }
    line.trim_end().to_owned()
}
