//! Retention of jobs, and format of the log.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Retention times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Retention {
    /// Days of running service after which a job that has ended is removed; `None`: never.
    pub ended_jobs_d: Option<f64>,
    /// Days of running service for which an Idempotency-Key outlives its last job.
    pub keys_d: f64,
    /// Space of the keys and answers that outlive their jobs, of one caller [bytes]; beyond it
    /// the oldest are forgotten sooner.
    pub keys_bytes: u64,
}

impl Default for Retention {
    fn default() -> Self {
        Self {
            ended_jobs_d: None,
            keys_d: 30.0,
            keys_bytes: 64 << 20,
        }
    }
}

/// Log settings.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Log {
    /// Format of a line.
    pub format: LogFormat,
}

/// Format of a line of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LogFormat {
    /// A line for people.
    #[default]
    Text,
    /// A JSON object.
    Json,
}

impl Retention {
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        let keys = [
            ("retention.ended_jobs_d", self.ended_jobs_d),
            ("retention.keys_d", Some(self.keys_d)),
        ];
        for (key, days) in keys {
            // A comparison is false for NaN, so NaN is refused too.
            if let Some(days) = days
                && !(days > 0.0 && days <= 36_500.0)
            {
                return Err(not_allowed(key, days, "allowed is 0 < x <= 36500 d"));
            }
        }
        Ok(())
    }

    /// Time for which a job that has ended is kept.
    pub fn ended_jobs(&self) -> Option<Duration> {
        self.ended_jobs_d.map(days)
    }

    /// Time for which a key outlives its last job.
    pub fn keys(&self) -> Duration {
        days(self.keys_d)
    }
}

fn days(number: f64) -> Duration {
    Duration::from_secs_f64(number * 86_400.0)
}
