//! The service as a whole: started with a configuration, stopped with grace.

use crate::config::{ConfigError, ServiceConfig};
use std::net::SocketAddr;
use thiserror::Error;

/// Why the service can't start.
#[derive(Debug, Error)]
pub enum StartError {
    /// The configuration is not allowed.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// The address can't be listened on.
    #[error("cannot listen on {address}: {source}")]
    Listen {
        /// The address asked for.
        address: SocketAddr,
        /// The system's words.
        source: std::io::Error,
    },
}

/// A service that takes requests and runs jobs until it is stopped.
#[derive(Debug)]
pub struct RunningService {
    address: SocketAddr,
}

impl RunningService {
    /// Where it listens; with port 0 asked for, the port it got.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Takes no more requests, lets those in hand finish, puts running jobs
    /// back into the queue, and returns when all is written.
    pub async fn stop(self) {}
}

/// Starts the service.
///
/// # Errors
/// [`StartError`]; nothing is left running then.
#[expect(
    clippy::unused_async,
    reason = "signature first; opening the database awaits"
)]
pub async fn start(config: ServiceConfig) -> Result<RunningService, StartError> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    config.check(cores)?;
    todo!("opens the database, starts the workers, serves")
}
