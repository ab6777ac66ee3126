//! Admission pool: threads that read, check and plan scenarios.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Admission pool. Scenarios are read, checked and planned on its threads, apart from those that
/// answer requests.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Admission {
    /// Threads of the pool; `None`: half of the cores.
    pub threads: Option<usize>,
    /// Requests that may be in the pool or wait for it; more are refused with 429, and so are those
    /// of one caller (token or address) beyond half of it.
    pub requests: usize,
    /// Longest time of a request in the pool, waiting included [s].
    pub time_limit_s: f64,
}

impl Default for Admission {
    fn default() -> Self {
        Self {
            threads: None,
            requests: 64,
            time_limit_s: 20.0,
        }
    }
}

impl Admission {
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        if self.threads == Some(0) {
            return Err(not_allowed("admission.threads", 0, "allowed is x >= 1"));
        }
        if self.requests < 2 {
            let reason = "allowed is x >= 2, half of which one caller may have";
            return Err(not_allowed("admission.requests", self.requests, reason));
        }
        Ok(())
    }

    /// Threads of the pool on a machine with this many cores.
    pub fn threads(&self, cores: usize) -> usize {
        self.threads.unwrap_or(cores / 2).max(1)
    }

    /// Requests that one caller may have in the pool.
    pub fn requests_per_caller(&self) -> usize {
        (self.requests / 2).max(1)
    }

    /// Longest time of a request in the pool.
    pub fn time_limit(&self) -> Duration {
        Duration::from_secs_f64(self.time_limit_s)
    }
}
