//! `scree serve`: the HTTP service until it is stopped.

use super::arguments::ServeOptions;
use super::console;
use super::failure::Failure;
use super::signals::Signals;
use scree::config::{LogFormat, ServiceConfig};
use scree::service::{self, StartError};
use std::io::IsTerminal;
use std::path::Path;
use tracing::level_filters::LevelFilter;

/// Choice to tell on standard error of a log that can't be written. That is the log itself, so its
/// reader has ended, or the connection to it: telling it would be a panic, and no job would be saved.
const TELLS_ERRORS_OF_THE_LOG: bool = false;

/// Configuration file that is read by default, if it exists.
const USUAL_CONFIG: &str = "configs/service.toml";

/// Serves until Ctrl-C or SIGTERM, or the end of standard input where that is asked for.
///
/// # Errors
/// The configuration is refused, or the service can't start.
pub(super) fn serve(options: &ServeOptions) -> Result<(), Failure> {
    let config = configuration(options)?;
    log(config.log.format);
    let runtime = tokio::runtime::Runtime::new()?;
    let ended = runtime.block_on(async {
        // Before the address is announced: signals sent before the handlers exist would be lost.
        let mut signals = Signals::listen()?;
        let mut running = service::start(config)
            .await
            .map_err(|error| not_started(&error))?;
        console::answer(&format!("listening on http://{}", running.address()))?;
        let broken = tokio::select! {
            _ = signals.next() => None,
            () = end_of_stdin(), if options.until_stdin_ends => None,
            why = running.broken() => Some(why),
        };
        running.stop().await;
        broken.map_or(Ok(()), |why| Err(Failure::Other(why)))
    });
    // A scenario that is still being read, for a request that was cut off, leaves nothing behind.
    runtime.shutdown_background();
    ended
}

/// Returns once standard input has ended.
async fn end_of_stdin() {
    let (ended, end) = tokio::sync::oneshot::channel();
    // A thread of its own: a read of standard input can't be given up, and the runtime would wait.
    std::thread::spawn(move || {
        // Input that can't be read has ended, too.
        let _ = std::io::copy(&mut std::io::stdin(), &mut std::io::sink());
        let _ = ended.send(());
    });
    let _ = end.await;
}

fn configuration(options: &ServeOptions) -> Result<ServiceConfig, Failure> {
    let file = configuration_file(options.config.as_deref());
    let mut config =
        ServiceConfig::load(file).map_err(|error| Failure::Input(error.to_string()))?;
    if let Some(listen) = options.listen {
        config.listen = listen;
    }
    if let Some(database) = &options.database {
        config.database.clone_from(database);
    }
    if let Some(workers) = options.workers {
        config.workers.count = Some(usize::from(workers));
    }
    Ok(config)
}

/// The file of this name, or the usual one if it is there.
pub(super) fn configuration_file(named: Option<&Path>) -> Option<&Path> {
    let usual = Path::new(USUAL_CONFIG);
    named.or(usual.is_file().then_some(usual))
}

/// Failure of the start of a service, by the person who can act on it.
pub(super) fn not_started(error: &StartError) -> Failure {
    match error {
        StartError::Config(error) => Failure::Input(error.to_string()),
        error => Failure::Other(error.to_string()),
    }
}

/// Sends the log to standard error in this format.
pub(super) fn log(format: LogFormat) {
    match format {
        LogFormat::Text => log_to_standard_error(LevelFilter::INFO),
        LogFormat::Json => log_as_json(),
    }
}

/// Sends the service's log to standard error.
pub(super) fn log_to_standard_error(level: LevelFilter) {
    tracing_subscriber::fmt()
        .with_writer(std::io::stderr)
        // A file with colour codes can't be searched.
        .with_ansi(std::io::stderr().is_terminal())
        .with_max_level(level)
        .log_internal_errors(TELLS_ERRORS_OF_THE_LOG)
        .init();
}

/// Sends the log to standard error as one JSON object per line, with its spans: request, job.
fn log_as_json() {
    tracing_subscriber::fmt()
        .json()
        .with_writer(std::io::stderr)
        .with_max_level(LevelFilter::INFO)
        .log_internal_errors(TELLS_ERRORS_OF_THE_LOG)
        .init();
}
