//! Retention of jobs, and format of the log.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Retention times.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Retention {
    /// Days of running service after which a job that has ended is removed; `None`: never.
    pub ended_jobs_d: Option<f64>,
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
        match self.ended_jobs_d {
            // A comparison is false for NaN, so NaN is refused too.
            Some(days) if !(days > 0.0 && days <= 36_500.0) => {
                let reason = "allowed is 0 < x <= 36500 d";
                Err(not_allowed("retention.ended_jobs_d", days, reason))
            }
            _ => Ok(()),
        }
    }

    /// Time for which a job that has ended is kept.
    pub fn ended_jobs(&self) -> Option<Duration> {
        self.ended_jobs_d
            .map(|days| Duration::from_secs_f64(days * 86_400.0))
    }
}
