//! `scree demo`: the source paper's scene through a service of its
//! own: over HTTP into the queue, computed by a worker, kept in a database, and
//! back over HTTP into files, pictures and a table.

mod client;
mod documents;

use super::arguments::{DemoOptions, Quiet};
use super::failure::Failure;
use super::job_document::Job;
use super::meter::Meter;
use super::results_folder::{Delivery, Place, ResultsFolder, file_name};
use super::signals::Signals;
use super::{console, scenario_file, serve, table};
use client::Client;
use documents::Recorded;
use scree::config::ServiceConfig;
use scree::results::table::Format;
use scree::service;
use scree_solver::record::Outcome;
use scree_solver::scenario::Scenario;
use std::net::{Ipv4Addr, SocketAddr};
use std::time::Duration;
use tracing::level_filters::LevelFilter;

/// The source paper's scene, inside the binary so that the demo runs anywhere.
const SOURCE_PAPER: &str = include_str!("../../../configs/scenarios/source_paper.json");

/// Time between two polls of the job.
const POLL_INTERVAL: Duration = Duration::from_millis(250);

/// Runs the demo.
///
/// # Errors
/// See [`Failure`].
pub(super) fn demo(options: &DemoOptions) -> Result<(), Failure> {
    let text = match &options.scenario {
        Some(path) => scenario_file::read_text(path)?,
        None => SOURCE_PAPER.to_owned(),
    };
    let scenario = scenario_file::parse(&text, "the demo's scenario")?;
    let folder = ResultsFolder::for_new_run(&options.out)?;
    if let Some(path) = &options.scenario {
        folder.refuse_to_replace(path, &text, &scenario)?;
    }
    serve::log_to_standard_error(LevelFilter::WARN);
    let runtime = tokio::runtime::Runtime::new()?;
    runtime.block_on(async {
        let mut signals = Signals::listen()?;
        tokio::select! {
            result = with_own_service(text, &scenario, &folder, options.quiet) => result,
            signal = signals.next() => Err(Failure::Stopped(signal, String::new())),
        }
    })
}

/// Starts a service for this demo and stops it afterwards; its database
/// is removed with the directory.
async fn with_own_service(
    text: String,
    scenario: &Scenario,
    folder: &ResultsFolder,
    quiet: Quiet,
) -> Result<(), Failure> {
    let throw_away = tempfile::tempdir()?;
    let config = ServiceConfig {
        listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 0)),
        database: throw_away.path().join("demo.db").into(),
        ..ServiceConfig::default()
    };
    let running = service::start(config)
        .await
        .map_err(|error| serve::not_started(&error))?;
    quiet.note(&format!("service on http://{}", running.address()));
    let client = Client::new(running.address());
    let result = send_and_fetch(client, text, scenario, folder, quiet).await;
    running.stop().await;
    console::answer(&result?)?;
    Ok(())
}

/// Sends the scenario, waits for the job's end and fetches the results; returns the text
/// to print.
async fn send_and_fetch(
    client: Client,
    text: String,
    scenario: &Scenario,
    folder: &ResultsFolder,
    quiet: Quiet,
) -> Result<String, Failure> {
    let job: Job = client.post("/v1/jobs", text).await?.json()?;
    quiet.note(&format!(
        "POST /v1/jobs: job {}, \"{}\"",
        job.id, scenario.title
    ));
    let outcome = wait(client, &job.id, quiet.meter()).await?;
    let mut delivery = folder.deliver(Place::Whole)?;
    let recorded = fetch(client, &job.id, scenario, &mut delivery).await?;
    // It is in a channel.
    let records = (&recorded.samples[..], &recorded.snapshots[..], None);
    delivery.pictures(scenario, records, &outcome)?;
    delivery.scenario(scenario, &[])?;
    delivery.outcome(&outcome)?;
    let written = delivery.finish()?;
    Ok(format!(
        "{}\n\nwritten to {written}",
        table::outcome(&outcome)
    ))
}

/// Shows the job's progress until it ends.
async fn wait(client: Client, id: &str, mut meter: Meter) -> Result<Outcome, Failure> {
    loop {
        let job: Job = client.get(&format!("/v1/jobs/{id}")).await?.json()?;
        meter.show(&job.progress);
        if job.has_ended() {
            meter.finish();
            return job.end();
        }
        tokio::time::sleep(POLL_INTERVAL).await;
    }
}

/// Fetches trajectories, which are stored as they arrive, and the flow.
async fn fetch(
    client: Client,
    id: &str,
    scenario: &Scenario,
    delivery: &mut Delivery<'_>,
) -> Result<Recorded, Failure> {
    let mut recorded = Recorded::default();
    for body in 0..scenario.bodies.len() {
        let path = format!("/v1/jobs/{id}/trajectory?body={body}");
        let document = client.get(&path).await?.accepted()?;
        delivery.write(&file_name(body, Format::Json), &document)?;
        recorded.add_trajectory(&document)?;
    }
    for time_s in documents::snapshot_times(scenario) {
        let path = format!("/v1/jobs/{id}/flow?time_s={time_s}");
        recorded.add_snapshot(client.get(&path).await?.json()?);
    }
    Ok(recorded)
}
