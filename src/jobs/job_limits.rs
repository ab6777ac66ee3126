//! Limits of a job: memory, wall time and size of its results. One that goes beyond them fails,
//! and takes nobody along.

use crate::config::Limits;
use crate::machine;
use crate::runs::Resources;
use std::time::Duration;
use thiserror::Error;

/// Share of the machine's memory that jobs may have by default.
const SHARE_OF_MEMORY: f64 = 0.75;

/// Limits of one job.
#[derive(Debug, Clone, PartialEq)]
pub struct JobLimits {
    /// Largest memory [bytes].
    pub memory_bytes: u64,
    /// Memory of all jobs that run at the same time [bytes].
    pub memory_of_all_bytes: u64,
    /// Longest wall time.
    pub wall_time: Duration,
    /// Largest size of its results [bytes].
    pub results_bytes: Option<u64>,
}

/// A limit that a job exceeds.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Excess {
    /// More memory than a job may have.
    #[error(
        "the run needs {needed_bytes} bytes of memory, and limits.job_memory_bytes of this service is {limit_bytes}: larger cells (numerics.cell_size_m) need less"
    )]
    Memory {
        /// Memory that the run needs [bytes].
        needed_bytes: u64,
        /// The limit [bytes].
        limit_bytes: u64,
    },
    /// More memory than is left on the machine.
    #[error(
        "the run needs {needed_bytes} bytes of memory, and {available_bytes} are available to this service: larger cells (numerics.cell_size_m) need less"
    )]
    NoMemory {
        /// Memory that the run needs [bytes].
        needed_bytes: u64,
        /// Memory that the service can still get [bytes].
        available_bytes: u64,
    },
    /// More wall time than a job may have.
    #[error(
        "the run has taken {spent_s:.0} s of wall time, and limits.job_wall_time_s of this service is {limit_s}"
    )]
    WallTime {
        /// Wall time spent [s].
        spent_s: f64,
        /// The limit [s].
        limit_s: f64,
    },
    /// More results than a job may have.
    #[error(
        "the results would take {needed_bytes} bytes, and limits.job_results_bytes of this service is {limit_bytes}: fewer samples (sample_interval_s) or snapshots (flow_snapshots) take less"
    )]
    Results {
        /// Size of the results with those to be stored next [bytes].
        needed_bytes: u64,
        /// The limit [bytes].
        limit_bytes: u64,
    },
}

impl JobLimits {
    /// Limits of a job on a service with this configuration, on this machine.
    pub fn new(limits: &Limits) -> Self {
        let of_machine = (machine::total_memory() as f64 * SHARE_OF_MEMORY) as u64;
        let memory_bytes = limits.job_memory_bytes.unwrap_or(of_machine);
        Self {
            memory_bytes,
            memory_of_all_bytes: of_machine.max(memory_bytes),
            wall_time: limits.job_wall_time(),
            results_bytes: limits.job_results_bytes,
        }
    }

    /// Checks before a run is set up that its memory is there: a process that runs out of it ends
    /// with all of its jobs.
    pub(super) fn check_available(needed_bytes: u64) -> Result<(), Excess> {
        let available_bytes = machine::available_memory();
        if needed_bytes > available_bytes {
            return Err(Excess::NoMemory {
                needed_bytes,
                available_bytes,
            });
        }
        Ok(())
    }

    /// Checks a run on its way.
    pub(super) fn check(&self, resources: &Resources) -> Result<(), Excess> {
        self.check_memory(resources.memory_bytes)?;
        let limit_s = self.wall_time.as_secs_f64();
        if resources.wall_s > limit_s {
            return Err(Excess::WallTime {
                spent_s: resources.wall_s,
                limit_s,
            });
        }
        Ok(())
    }

    /// Checks the size of a job's results before more of them are stored.
    pub(super) fn check_results(&self, needed_bytes: u64) -> Result<(), Excess> {
        match self.results_bytes {
            Some(limit_bytes) if needed_bytes > limit_bytes => Err(Excess::Results {
                needed_bytes,
                limit_bytes,
            }),
            _ => Ok(()),
        }
    }

    /// Checks the memory of a run.
    pub(super) fn check_memory(&self, needed_bytes: u64) -> Result<(), Excess> {
        if needed_bytes > self.memory_bytes {
            return Err(Excess::Memory {
                needed_bytes,
                limit_bytes: self.memory_bytes,
            });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_limit_is_told_with_its_numbers() {
        let limits = JobLimits {
            memory_bytes: 1000,
            memory_of_all_bytes: 1000,
            wall_time: Duration::from_secs(10),
            results_bytes: Some(50),
        };
        let resources = |memory_bytes, wall_s| Resources {
            memory_bytes,
            wall_s,
        };
        assert_eq!(limits.check(&resources(1000, 10.0)), Ok(()));
        let memory = limits.check(&resources(1001, 0.0)).unwrap_err();
        assert!(memory.to_string().contains("1001") && memory.to_string().contains("1000"));
        let wall = limits.check(&resources(0, 11.0)).unwrap_err();
        assert!(matches!(wall, Excess::WallTime { .. }));
        assert_eq!(limits.check_results(50), Ok(()));
        assert!(matches!(
            limits.check_results(51),
            Err(Excess::Results { .. })
        ));
        let none = JobLimits::check_available(u64::MAX).unwrap_err();
        assert!(matches!(none, Excess::NoMemory { .. }));
    }
}
