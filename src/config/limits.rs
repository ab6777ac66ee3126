//! Limits on clients.

use super::{ConfigError, not_allowed};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Limits on clients.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Largest request body [bytes].
    pub request_body_bytes: usize,
    /// Largest file of a terrain [bytes].
    pub terrain_file_bytes: usize,
    /// Largest number of cells of a terrain: its file may be compressed.
    pub terrain_cells: u64,
    /// Terrains that may be uploaded at the same time, each in memory meanwhile; more are refused with
    /// 429, and so are those of one caller (token or address) beyond half of it.
    pub terrain_uploads: usize,
    /// Longest wait for the file of a terrain [s].
    pub terrain_read_timeout_s: f64,
    /// Longest wait for the head of a request [s].
    pub header_read_timeout_s: f64,
    /// Longest wait for the body of a request [s].
    pub body_read_timeout_s: f64,
    /// Longest time for which a client may read nothing of its answer [s].
    pub write_timeout_s: f64,
    /// Longest time from the head of a request to the head of its answer [s].
    pub request_timeout_s: f64,
    /// Connections served at the same time. When more come, those without a request are closed,
    /// the longest idle first.
    pub connections: usize,
    /// The same of one address.
    pub connections_per_address: usize,
    /// Connections beyond `connections` kept for the operator: health, readiness, metrics and
    /// dismissals.
    pub operator_connections: usize,
    /// Streams at the same time: event streams, and requests that wait for a job's end.
    pub streams: usize,
    /// The same of one caller (token or address).
    pub streams_per_caller: usize,
    /// Time that requests in progress may take once the service stops [s].
    pub drain_timeout_s: f64,
    /// Largest number of jobs that may wait; more are refused with 429.
    pub queued_jobs: u32,
    /// Largest number of studies that may run; more are refused with 429.
    pub studies: u32,
    /// Largest number of point-steps (points times sub-steps) that a job may be planned to take,
    /// those of its refinement runs and its bodies' own sub-steps included; `None`: no limit.
    pub job_point_steps: Option<u64>,
    /// Largest memory of a job [bytes]; `None`: an equal share of three quarters of the machine's
    /// for each worker.
    pub job_memory_bytes: Option<u64>,
    /// Longest wall time of a job, over all of its attempts [s].
    pub job_wall_time_s: f64,
    /// Largest size of a job's results [bytes]; `None`: no limit but that of the database.
    pub job_results_bytes: Option<u64>,
    /// Largest size of the database [bytes]; `None`: no limit but the disk.
    pub database_bytes: Option<u64>,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            request_body_bytes: 1024 * 1024,
            terrain_file_bytes: 64 * 1024 * 1024,
            terrain_cells: 25_000_000,
            terrain_uploads: 4,
            terrain_read_timeout_s: 60.0,
            header_read_timeout_s: 10.0,
            body_read_timeout_s: 10.0,
            write_timeout_s: 10.0,
            request_timeout_s: 30.0,
            connections: 256,
            connections_per_address: 128,
            operator_connections: 32,
            streams: 128,
            streams_per_caller: 64,
            drain_timeout_s: 5.0,
            studies: 16,
            queued_jobs: 10_000,
            job_point_steps: None,
            job_memory_bytes: None,
            job_wall_time_s: 259_200.0,
            job_results_bytes: None,
            database_bytes: None,
        }
    }
}

impl Limits {
    pub(super) fn check(&self) -> Result<(), ConfigError> {
        for (key, value) in [
            ("limits.request_body_bytes", self.request_body_bytes),
            ("limits.terrain_file_bytes", self.terrain_file_bytes),
            ("limits.terrain_cells", self.terrain_cells as usize),
            ("limits.terrain_uploads", self.terrain_uploads),
            ("limits.connections", self.connections),
            (
                "limits.connections_per_address",
                self.connections_per_address,
            ),
            ("limits.operator_connections", self.operator_connections),
            ("limits.streams", self.streams),
            ("limits.streams_per_caller", self.streams_per_caller),
            ("limits.studies", self.studies as usize),
            ("limits.queued_jobs", self.queued_jobs as usize),
        ] {
            if value == 0 {
                return Err(not_allowed(key, value, "allowed is x >= 1"));
            }
        }
        let most = self.job_wall_time_s;
        // A comparison is false for NaN, so NaN is refused too.
        if !(most > 0.0 && most <= 31_536_000.0) {
            let reason = "allowed is 0 < x <= 31536000 s";
            return Err(not_allowed("limits.job_wall_time_s", most, reason));
        }
        for (key, value) in [
            ("limits.job_point_steps", self.job_point_steps),
            ("limits.job_memory_bytes", self.job_memory_bytes),
            ("limits.job_results_bytes", self.job_results_bytes),
            ("limits.database_bytes", self.database_bytes),
        ] {
            if value == Some(0) {
                return Err(not_allowed(key, 0, "allowed is x >= 1"));
            }
        }
        Ok(())
    }

    /// Terrains that one caller may upload at the same time.
    pub fn terrain_uploads_per_caller(&self) -> usize {
        (self.terrain_uploads / 2).max(1)
    }

    /// Longest wait for the file of a terrain.
    pub fn terrain_read_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.terrain_read_timeout_s)
    }

    /// Longest wait for the head of a request.
    pub fn header_read_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.header_read_timeout_s)
    }

    /// Longest wait for the body of a request.
    pub fn body_read_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.body_read_timeout_s)
    }

    /// Longest time for which a client may read nothing of its answer.
    pub fn write_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.write_timeout_s)
    }

    /// Longest time to the head of an answer.
    pub fn request_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.request_timeout_s)
    }

    /// Time that requests in progress may take once the service stops.
    pub fn drain_timeout(&self) -> Duration {
        Duration::from_secs_f64(self.drain_timeout_s)
    }

    /// Longest wall time of a job.
    pub fn job_wall_time(&self) -> Duration {
        Duration::from_secs_f64(self.job_wall_time_s)
    }
}
