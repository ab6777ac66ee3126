//! Stream of a job's snapshots of the flow, one after the other.

use super::JobService;
use super::job::JobId;
use super::store::StoreError;
use crate::results::FlowSnapshot;
use std::collections::VecDeque;

/// Snapshots of a job in a range of time, read one by one.
#[derive(Debug)]
pub struct FlowFrames {
    jobs: JobService,
    job: JobId,
    times_s: VecDeque<f64>,
}

impl JobService {
    /// The snapshots so far between these times [s], both included.
    ///
    /// # Errors
    /// The store's own.
    pub async fn flow_frames(
        &self,
        job: JobId,
        from_s: Option<f64>,
        to_s: Option<f64>,
    ) -> Result<FlowFrames, StoreError> {
        let mut times_s = self.snapshot_times(job).await?;
        times_s.retain(|time| {
            from_s.is_none_or(|from| *time >= from) && to_s.is_none_or(|to| *time <= to)
        });
        Ok(FlowFrames {
            jobs: self.clone(),
            job,
            times_s: times_s.into(),
        })
    }
}

impl FlowFrames {
    /// Number of snapshots still to come.
    pub fn remaining(&self) -> usize {
        self.times_s.len()
    }

    /// The next snapshot; `None` after the last.
    ///
    /// # Errors
    /// The job was removed meanwhile, or the store's own.
    pub async fn next(&mut self) -> Result<Option<FlowSnapshot>, StoreError> {
        let Some(time_s) = self.times_s.pop_front() else {
            return Ok(None);
        };
        self.jobs.snapshot_at(self.job, time_s).await.map(Some)
    }
}
