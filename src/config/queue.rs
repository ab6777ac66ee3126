//! Leases of jobs.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Leases of jobs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Queue {
    /// Name of this service among those that share a database. Its next start
    /// reclaims at once the jobs that it left running.
    pub name: String,
    /// Time that a claimed job stays with its worker without a heartbeat [s].
    pub lease_s: f64,
    /// Time between two heartbeats [s].
    pub heartbeat_interval_s: f64,
}

impl Queue {
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        if self.name.is_empty() || self.name.len() > 100 {
            let reason = "allowed are 1 to 100 bytes";
            return Err(not_allowed("queue.name", &self.name, reason));
        }
        // Two heartbeats may fail before a lease runs out.
        let most = self.lease_s / 3.0;
        if self.heartbeat_interval_s > most {
            let reason = format!(
                "with leases of {} s, allowed is 0 < x <= {most} s",
                self.lease_s
            );
            let beat = self.heartbeat_interval_s;
            return Err(not_allowed("queue.heartbeat_interval_s", beat, reason));
        }
        Ok(())
    }

    /// Time that a claimed job stays with its worker without a heartbeat.
    pub fn lease_duration(&self) -> Duration {
        Duration::from_secs_f64(self.lease_s)
    }

    /// Time between two heartbeats.
    pub fn heartbeat_interval(&self) -> Duration {
        Duration::from_secs_f64(self.heartbeat_interval_s)
    }
}
