//! The last chunk of one body's trajectory, while it still grows.

use super::store::NewChunk;
use crate::results::chunk::{self, BlockError, CHUNK_SAMPLES};
use crate::results::columns::TrajectoryColumns;
use scree_solver::record::BodySample;

/// A chunk that is not full yet.
#[derive(Debug, Default)]
pub(super) struct OpenChunk {
    first_sample: usize,
    written: usize,
    columns: TrajectoryColumns,
}

impl OpenChunk {
    /// The last stored chunk (index of its first sample, samples), cut to the
    /// first `samples` of the trajectory; none if the chunk begins after them.
    pub(super) fn reopened(
        last: Option<(usize, TrajectoryColumns)>,
        samples: usize,
    ) -> Option<Self> {
        let (first_sample, mut columns) = last?;
        let kept = samples.checked_sub(first_sample)?;
        let stored = columns.len();
        columns.truncate(kept);
        (columns.len() == kept).then_some(Self {
            first_sample,
            // A longer stored chunk must be written again.
            written: if stored == kept { kept } else { 0 },
            columns,
        })
    }

    pub(super) fn push(&mut self, time_s: f64, sample: &BodySample) {
        self.columns.push(time_s, sample);
    }

    pub(super) fn is_full(&self) -> bool {
        self.columns.len() >= CHUNK_SAMPLES
    }

    /// The chunk as it is to be stored; none if it has no new samples.
    pub(super) fn sealed(&self, body: usize) -> Result<Option<NewChunk>, BlockError> {
        let times = &self.columns.time_s;
        let (Some(&first_time_s), Some(&last_time_s)) = (times.first(), times.last()) else {
            return Ok(None);
        };
        if times.len() == self.written {
            return Ok(None);
        }
        Ok(Some(NewChunk {
            body,
            first_sample: self.first_sample,
            samples: times.len(),
            first_time_s,
            last_time_s,
            block: chunk::encode(&self.columns)?,
        }))
    }

    /// Marks all samples as written; a full chunk is replaced by the next.
    pub(super) fn mark_written(&mut self) {
        self.written = self.columns.len();
        if self.is_full() {
            *self = Self {
                first_sample: self.first_sample + self.columns.len(),
                ..Self::default()
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::columns::tests::numbered_columns;

    #[test]
    fn a_chunk_is_cut_where_the_saved_state_stands() {
        let whole = || Some((100, numbered_columns(7)));
        let exact = OpenChunk::reopened(whole(), 107).unwrap();
        assert_eq!(exact.sealed(0).unwrap(), None, "nothing is new in it");
        let cut = OpenChunk::reopened(whole(), 104).unwrap();
        let sealed = cut.sealed(0).unwrap().unwrap();
        assert_eq!((sealed.first_sample, sealed.samples), (100, 4));
        assert_eq!(cut.columns, numbered_columns(4));
        for samples in [99, 108] {
            assert!(OpenChunk::reopened(whole(), samples).is_none());
        }
        assert!(OpenChunk::reopened(None, 1).is_none());
    }
}
