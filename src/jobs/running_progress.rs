//! Progress of the running jobs, for those who follow them.

use super::JobService;
use super::job::{JobId, JobStatus};
use super::store::{Page, StoreError};
use crate::runs::Progress;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Largest number of running jobs whose progress is told.
const MOST_JOBS: u32 = 1_000;

/// Progress of running jobs.
pub type RunningProgress = BTreeMap<JobId, Progress>;

impl JobService {
    /// Progress of a job that is running.
    ///
    /// # Errors
    /// The store's own.
    pub async fn progress_of(&self, id: JobId) -> Result<Option<Progress>, StoreError> {
        if let Some(now) = self.registry.progress(id) {
            return Ok(Some(now));
        }
        // Another service's workers may run it.
        let job = self.store.job(id).await?;
        let running = job.filter(|job| job.summary.status == JobStatus::Running);
        Ok(running.map(|job| job.summary.progress))
    }

    /// Progress of the newest running jobs, or as it was just now: of this service's workers to the moment,
    /// of others as of the last renewal of their leases.
    pub async fn running_progress(&self) -> Arc<Result<RunningProgress, StoreError>> {
        self.running.get(self.read_running_progress()).await
    }

    async fn read_running_progress(&self) -> Result<RunningProgress, StoreError> {
        let page = Page {
            statuses: vec![JobStatus::Running],
            limit: MOST_JOBS,
            label: None,
            members: true,
            created_from: None,
            created_to: None,
            before: None,
            outcomes: false,
        };
        let stored = self.store.page(&page).await?.jobs.into_iter();
        let mut progress: RunningProgress = stored
            .map(|listed| (listed.summary.id, listed.summary.progress))
            .collect();
        for (job, told) in &mut progress {
            if let Some(now) = self.registry.progress(*job) {
                *told = now;
            }
        }
        Ok(progress)
    }
}
