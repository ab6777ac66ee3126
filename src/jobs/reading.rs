//! Reading the records of runs, a chunk at a time.

use super::JobService;
use super::job::JobId;
use super::store::{StoreError, StoredChunk};
use crate::results::FlowSnapshot;
use crate::results::columns::{Selection, Selector};
use scree_solver::record::{BodySample, Sample};

/// Range of one body's trajectory: fixed to the samples that existed at the time of the
/// request, however far the run gets meanwhile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrajectoryRange {
    job: JobId,
    body: usize,
    /// Number of samples at the time of the request.
    end: usize,
    /// Samples that are selected.
    pub selection: Selection,
}

impl JobService {
    /// A body's trajectory up to its present end.
    ///
    /// # Errors
    /// The store's own.
    pub async fn range(
        &self,
        job: JobId,
        body: usize,
        selection: Selection,
    ) -> Result<TrajectoryRange, StoreError> {
        Ok(TrajectoryRange {
            job,
            body,
            end: self.store.samples(job, body).await?,
            selection,
        })
    }

    /// The first chunk from sample `from_sample` on that overlaps the
    /// range, cut to it.
    ///
    /// # Errors
    /// The store's own.
    pub async fn next_chunk(
        &self,
        range: &TrajectoryRange,
        from_sample: i64,
    ) -> Result<Option<StoredChunk>, StoreError> {
        let TrajectoryRange {
            job,
            body,
            end,
            selection,
        } = range;
        let chunk = self
            .store
            .chunk(*job, *body, from_sample, selection)
            .await?;
        Ok(chunk.and_then(|mut chunk| {
            let next = usize::try_from(chunk.next_sample).unwrap_or(usize::MAX);
            let first = next.saturating_sub(chunk.columns.len());
            // Samples recorded after the request do not belong to the answer.
            chunk.columns.truncate(end.saturating_sub(first));
            (!chunk.columns.is_empty()).then_some(chunk)
        }))
    }

    /// Samples of all bodies, evenly thinned to at most so many states of bodies.
    ///
    /// # Errors
    /// The store's own.
    pub async fn samples(
        &self,
        job: JobId,
        bodies: usize,
        most_states: usize,
    ) -> Result<Vec<Sample>, StoreError> {
        let mut samples: Vec<Sample> = Vec::new();
        for body in 0..bodies {
            let mut range = self.range(job, body, Selection::default()).await?;
            range.selection.stride = (range.end * bodies).div_ceil(most_states).max(1);
            let states = self.states(&range).await?;
            if body == 0 {
                let empty = |&(time_s, _): &(f64, _)| Sample {
                    time_s,
                    bodies: Vec::with_capacity(bodies),
                };
                samples = states.iter().map(empty).collect();
            }
            for (sample, (_, state)) in samples.iter_mut().zip(states) {
                sample.bodies.push(state);
            }
        }
        // A running job may have recorded more of some bodies.
        samples.retain(|sample| sample.bodies.len() == bodies);
        Ok(samples)
    }

    /// Times and states of the range.
    async fn states(&self, range: &TrajectoryRange) -> Result<Vec<(f64, BodySample)>, StoreError> {
        let mut selector = Selector::new(range.selection);
        let (mut states, mut from_sample) = (Vec::new(), 0);
        while let Some(chunk) = self.next_chunk(range, from_sample).await? {
            let chosen = selector.choose(&chunk.columns);
            states.extend((0..chosen.len()).map(|index| chosen.sample(index)));
            from_sample = chunk.next_sample;
        }
        Ok(states)
    }

    /// Checks that the range is still there: a job that is removed while its trajectory is read
    /// must not leave a part that looks like the whole.
    ///
    /// # Errors
    /// Samples of the range are gone, or the store's own.
    pub async fn check_whole(&self, range: &TrajectoryRange) -> Result<(), StoreError> {
        let samples = self.store.samples(range.job, range.body).await?;
        if samples < range.end {
            return Err(StoreError::Row {
                job: range.job.to_string(),
                what: "a sample that was there before",
            });
        }
        Ok(())
    }

    /// Number of samples of the range.
    ///
    /// # Errors
    /// The store's own.
    pub async fn count_samples(&self, range: &TrajectoryRange) -> Result<usize, StoreError> {
        let mut selector = Selector::new(range.selection);
        let (mut count, mut from_sample) = (0, 0);
        while let Some(chunk) = self.next_chunk(range, from_sample).await? {
            count += selector.choose(&chunk.columns).len();
            from_sample = chunk.next_sample;
        }
        Ok(count)
    }

    /// The times of all snapshots of the flow so far [s].
    ///
    /// # Errors
    /// The store's own.
    pub async fn snapshot_times(&self, job: JobId) -> Result<Vec<f64>, StoreError> {
        self.store.snapshot_times(job).await
    }

    /// The snapshot of the flow nearest to a time; without a time the latest.
    ///
    /// # Errors
    /// The store's own.
    pub async fn snapshot(
        &self,
        job: JobId,
        time_s: Option<f64>,
    ) -> Result<Option<FlowSnapshot>, StoreError> {
        self.store.snapshot(job, time_s).await
    }

    /// The snapshot of the flow at one of its times [s].
    ///
    /// # Errors
    /// The job was removed meanwhile, or the store's own.
    pub(super) async fn snapshot_at(
        &self,
        job: JobId,
        time_s: f64,
    ) -> Result<FlowSnapshot, StoreError> {
        let nearest = self.snapshot(job, Some(time_s)).await?;
        let there = nearest.filter(|snapshot| snapshot.time_s == time_s);
        there.ok_or_else(|| StoreError::Row {
            job: job.to_string(),
            what: "a snapshot that was there before",
        })
    }
}
