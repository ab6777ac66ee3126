//! `scree work`: workers for a database that services and other workers share.

use super::arguments::WorkOptions;
use super::failure::Failure;
use super::serve::{configuration_file, log};
use super::signals::Signals;
use scree::config::ServiceConfig;
use scree::machine::cores;
use scree::worker_process::{self, StartError};
use std::num::NonZeroUsize;
use std::time::Duration;
use tokio::time::{sleep, timeout};

/// Time to save running jobs by default: within the 30 s that most systems give a process.
const GRACE_S: f64 = 20.0;

/// Time for what is written last, after that to save running jobs.
const LAST_WORDS: Duration = Duration::from_secs(5);

/// Works until Ctrl-C or SIGTERM, the end of its time, or an empty queue where that is asked for.
///
/// # Errors
/// The configuration is refused, or the workers can't start.
pub(super) fn work(options: &WorkOptions) -> Result<(), Failure> {
    let config = configuration(options)?;
    log(config.log.format);
    let threads = options.threads.map_or_else(cores, usize::from);
    let threads = NonZeroUsize::new(threads).unwrap_or(NonZeroUsize::MIN);
    let runtime = tokio::runtime::Runtime::new()?;
    let ended = runtime.block_on(async {
        // Signals sent before the handlers exist would be lost.
        let mut signals = Signals::listen()?;
        let process = worker_process::start(&config, threads).await;
        let process = process.map_err(|error| not_started(&error))?;
        let why = tokio::select! {
            signal = signals.next() => signal.to_string(),
            () = process.until_empty(), if options.until_empty => "the queue is empty".to_owned(),
            () = end_of(options.max_time) => "its time is over".to_owned(),
        };
        tracing::info!(why, "stopping");
        // Without the database there is no end to what has to be written.
        let longest = config.limits.drain_timeout() + LAST_WORDS;
        if timeout(longest, process.stop()).await.is_err() {
            tracing::error!("the database is out of reach: jobs go back when their leases run out");
        }
        Ok(())
    });
    runtime.shutdown_background();
    ended
}

/// Returns at the end of this time; never, if there is none.
async fn end_of(time: Option<Duration>) {
    match time {
        Some(time) => sleep(time).await,
        None => std::future::pending().await,
    }
}

fn configuration(options: &WorkOptions) -> Result<ServiceConfig, Failure> {
    let file = configuration_file(options.config.as_deref());
    let mut config =
        ServiceConfig::load_for_workers(file).map_err(|error| Failure::Input(error.to_string()))?;
    if let Some(database) = &options.database {
        config.database = database.clone();
    }
    config.limits.drain_timeout_s = options.grace.map_or(GRACE_S, |grace| grace.as_secs_f64());
    // These are the service's: this process has its own numbers.
    config.workers.count = None;
    config.workers.threads_per_worker = None;
    Ok(config)
}

fn not_started(error: &StartError) -> Failure {
    match error {
        StartError::Config(_) | StartError::NotShared(_) => Failure::Input(error.to_string()),
        StartError::Store(_) | StartError::Workers(_) => Failure::Other(error.to_string()),
    }
}
