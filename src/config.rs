//! Configuration by the operator: strict, with units in the key names, checked before anything
//! is started. Later sources override earlier ones: built-in values, the TOML file, the
//! environment (`SCREE_LISTEN`, `SCREE_WORKERS__COUNT`, …).

use figment::providers::{Env, Format, Serialized, Toml};
use figment::{Figment, Provider};
use serde::{Deserialize, Serialize};
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::time::Duration;
use thiserror::Error;

mod admission;
mod browser;
mod database;
mod limits;
mod origin;
mod queue;
#[cfg(test)]
mod tests;
mod tokens;
mod upkeep;
mod webhooks;

pub use admission::Admission;
pub use browser::Browser;
pub use database::Database;
pub use limits::Limits;
pub use origin::{Authority, Host, Origin};
pub use queue::Queue;
pub use tokens::{Scope, Token, check_name as check_token_name};
pub use upkeep::{Log, LogFormat, Retention};
pub use webhooks::{Secret, Webhook};

/// Configuration of the service.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServiceConfig {
    /// Address and port; port 0 selects a free port. An address beyond the loopback interface
    /// needs access tokens.
    pub listen: SocketAddr,
    /// SQLite file, or URL of a PostgreSQL database, which several services and workers can share.
    pub database: Database,
    /// Worker pool.
    pub workers: Workers,
    /// Leases of jobs.
    pub queue: Queue,
    /// Admission pool.
    pub admission: Admission,
    /// Limits on clients.
    pub limits: Limits,
    /// Recording of results in the database while a job runs.
    pub recording: Recording,
    /// Retention of stored jobs.
    pub retention: Retention,
    /// Format of the log.
    pub log: Log,
    /// Permissions of browsers.
    pub browser: Browser,
    /// Access tokens; without any, no request needs one.
    pub tokens: Vec<Token>,
    /// Receivers that are told how jobs end.
    pub webhooks: Vec<Webhook>,
}

/// The worker pool.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Workers {
    /// Jobs that run at the same time; `None`: as many as cores. With 0 the jobs are left to worker
    /// processes.
    pub count: Option<usize>,
    /// Most solver threads of one job; `None`: as many as cores. Jobs that run at the same time
    /// share the cores.
    pub threads_per_worker: Option<usize>,
}

/// Recording of results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recording {
    /// Longest wall time for which new samples and progress stay unwritten [s].
    pub flush_interval_s: f64,
    /// Wall time between two saved states of a running job [s]; longer if
    /// saving one takes more than a fiftieth of that.
    pub state_interval_s: f64,
}

/// Error of a configuration.
#[derive(Debug, Error)]
pub enum ConfigError {
    /// The file or the environment can't be read as a configuration.
    #[error("configuration: {0}")]
    Unreadable(#[from] Box<figment::Error>),
    /// The file does not exist.
    #[error("configuration file {0} not found")]
    Missing(PathBuf),
    /// A value is not allowed.
    #[error("configuration: {key} = {value} is not allowed: {reason}")]
    NotAllowed {
        /// Key, with its section.
        key: &'static str,
        /// Value received.
        value: String,
        /// Reason, and the allowed values.
        reason: String,
    },
}

/// Pool size, checked against the machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PoolSize {
    /// Jobs that run at the same time.
    pub workers: usize,
    /// Most solver threads of each.
    pub threads_per_worker: usize,
    /// Cores that they share.
    pub cores: usize,
}

impl Default for ServiceConfig {
    fn default() -> Self {
        Self {
            listen: SocketAddr::from((Ipv4Addr::LOCALHOST, 8080)),
            database: Database::from("scree.db"),
            workers: Workers {
                count: None,
                threads_per_worker: None,
            },
            queue: Queue {
                name: "scree".to_owned(),
                lease_s: 30.0,
                heartbeat_interval_s: 2.0,
            },
            admission: Admission::default(),
            limits: Limits::default(),
            recording: Recording {
                flush_interval_s: 0.5,
                state_interval_s: 5.0,
            },
            retention: Retention::default(),
            log: Log::default(),
            browser: Browser::default(),
            tokens: Vec::new(),
            webhooks: Vec::new(),
        }
    }
}

impl ServiceConfig {
    /// Loads the built-in values, then `file` if one is named, then the environment.
    ///
    /// # Errors
    /// A named file is missing, a key is unknown, or a value has the wrong type.
    pub fn load(file: Option<&Path>) -> Result<Self, ConfigError> {
        Self::default().overridden(file)
    }

    /// The same for a worker process: many of them write to one database, over a network, so each
    /// writes less often by default.
    ///
    /// # Errors
    /// As for [`ServiceConfig::load`].
    pub fn load_for_workers(file: Option<&Path>) -> Result<Self, ConfigError> {
        let built_in = Self {
            recording: Recording {
                flush_interval_s: 5.0,
                state_interval_s: 60.0,
            },
            ..Self::default()
        };
        built_in.overridden(file)
    }

    fn overridden(self, file: Option<&Path>) -> Result<Self, ConfigError> {
        // No keys: the first is the Python package's, the others are for clients.
        let others = ["binary", "token", "url"];
        let environment = Env::prefixed("SCREE_").ignore(&others).split("__");
        self.layered(file, environment)
    }

    fn layered(self, file: Option<&Path>, environment: impl Provider) -> Result<Self, ConfigError> {
        let mut sources = Figment::from(Serialized::defaults(self));
        if let Some(path) = file {
            if !path.is_file() {
                return Err(ConfigError::Missing(path.to_path_buf()));
            }
            sources = sources.merge(Toml::file_exact(path));
        }
        let config = sources.merge(environment).extract();
        config.map_err(|error| ConfigError::Unreadable(Box::new(error)))
    }

    /// Checks the rules that types can't express: loopback, finite durations, workers and threads
    /// within `cores`.
    ///
    /// # Errors
    /// The first key that is not allowed.
    pub fn check(&self, cores: usize) -> Result<PoolSize, ConfigError> {
        tokens::check(&self.tokens)?;
        webhooks::check(&self.webhooks)?;
        self.check_listen()?;
        self.database.check()?;
        self.check_sharing()?;
        self.browser.check()?;
        self.check_times()?;
        self.admission.check()?;
        self.limits.check()?;
        self.retention.check()?;
        self.queue.check()?;
        self.workers.check(cores)
    }

    fn check_listen(&self) -> Result<(), ConfigError> {
        if self.listen.ip().is_loopback() || !self.tokens.is_empty() {
            return Ok(());
        }
        Err(not_allowed(
            "listen",
            self.listen,
            "without access tokens (\"scree token\" makes one) the service only listens on the \
             loopback interface (127.0.0.1 or [::1])",
        ))
    }

    /// Rules that hold for a database of one process, or for one of several.
    fn check_sharing(&self) -> Result<(), ConfigError> {
        let shared = self.database.is_shared();
        if let (true, Some(limit)) = (shared, self.limits.database_bytes) {
            let reason = "the size of a PostgreSQL database is limited on its server";
            return Err(not_allowed("limits.database_bytes", limit, reason));
        }
        if !shared && self.workers.count == Some(0) {
            let reason = "a service without workers needs workers of its own beside it, and with \
                          them a PostgreSQL database";
            return Err(not_allowed("workers.count", 0, reason));
        }
        Ok(())
    }

    fn check_times(&self) -> Result<(), ConfigError> {
        let limits = &self.limits;
        for (key, value) in [
            ("limits.header_read_timeout_s", limits.header_read_timeout_s),
            ("limits.body_read_timeout_s", limits.body_read_timeout_s),
            (
                "limits.terrain_read_timeout_s",
                limits.terrain_read_timeout_s,
            ),
            ("limits.write_timeout_s", limits.write_timeout_s),
            ("limits.request_timeout_s", limits.request_timeout_s),
            ("limits.drain_timeout_s", limits.drain_timeout_s),
            ("admission.time_limit_s", self.admission.time_limit_s),
            (
                "recording.flush_interval_s",
                self.recording.flush_interval_s,
            ),
            (
                "recording.state_interval_s",
                self.recording.state_interval_s,
            ),
            ("queue.lease_s", self.queue.lease_s),
            (
                "queue.heartbeat_interval_s",
                self.queue.heartbeat_interval_s,
            ),
        ] {
            // A comparison is false for NaN, so NaN is refused too.
            if !(value > 0.0 && value <= 3600.0) {
                return Err(not_allowed(key, value, "allowed is 0 < x <= 3600 s"));
            }
        }
        Ok(())
    }
}

impl Workers {
    fn check(&self, cores: usize) -> Result<PoolSize, ConfigError> {
        let allowed = |key, value: Option<usize>, least| {
            let value = value.unwrap_or(cores);
            if (least..=cores).contains(&value) {
                return Ok(value);
            }
            let reason = format!("allowed is {least} <= x <= {cores}, the cores of this machine");
            Err(not_allowed(key, value, reason))
        };
        Ok(PoolSize {
            workers: allowed("workers.count", self.count, 0)?,
            threads_per_worker: allowed("workers.threads_per_worker", self.threads_per_worker, 1)?,
            cores,
        })
    }
}

impl Recording {
    /// Longest wall time for which results stay unwritten.
    pub fn flush_interval(&self) -> Duration {
        Duration::from_secs_f64(self.flush_interval_s)
    }

    /// Wall time between two saved states.
    pub fn state_interval(&self) -> Duration {
        Duration::from_secs_f64(self.state_interval_s)
    }
}

fn not_allowed(
    key: &'static str,
    value: impl std::fmt::Display,
    reason: impl Into<String>,
) -> ConfigError {
    ConfigError::NotAllowed {
        key,
        value: format!("{value}"),
        reason: reason.into(),
    }
}
