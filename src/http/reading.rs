//! The body of a trajectory's answer: read chunk by chunk, and written off the threads that answer
//! requests.

use super::pieces::{PieceError, Pieces, off_the_answering_threads};
use crate::jobs::{JobService, TrajectoryRange};
use crate::results::columns::Selector;
use crate::results::table::Writer;
use axum::body::Bytes;

/// Stream of a trajectory to a client: it holds one chunk at a time.
pub(super) struct Reading {
    jobs: JobService,
    range: TrajectoryRange,
    /// None while a piece is made, and after one that broke off.
    writer: Option<Box<dyn Writer>>,
    pass: usize,
    /// Position in the pass; none before the first pass.
    place: Option<(i64, Selector)>,
}

impl Reading {
    pub(super) fn new(jobs: JobService, range: TrajectoryRange, writer: Box<dyn Writer>) -> Self {
        Self {
            jobs,
            range,
            writer: Some(writer),
            pass: 0,
            place: None,
        }
    }
}

impl Pieces for Reading {
    const NAME: &'static str = "trajectory";
    type Error = PieceError;

    async fn piece(&mut self) -> Result<Option<Bytes>, PieceError> {
        let Some(mut writer) = self.writer.take() else {
            return Ok(None);
        };
        let mut out = Vec::new();
        while out.is_empty() && self.pass < writer.passes() {
            let pass = self.pass;
            let (from_sample, mut selector) = match self.place.take() {
                Some(place) => place,
                None => {
                    writer.begin(pass, &mut out);
                    (0, Selector::new(self.range.selection))
                }
            };
            match self.jobs.next_chunk(&self.range, from_sample).await? {
                Some(chunk) => {
                    let next_sample = chunk.next_sample;
                    (writer, selector, out) = off_the_answering_threads(move || {
                        let chosen = selector.choose(&chunk.columns);
                        writer.rows(pass, &chosen, &mut out);
                        (writer, selector, out)
                    })
                    .await?;
                    self.place = Some((next_sample, selector));
                }
                None => {
                    self.jobs.check_whole(&self.range).await?;
                    writer.end(pass, &mut out);
                    self.pass += 1;
                }
            }
        }
        self.writer = Some(writer);
        Ok((!out.is_empty()).then_some(out.into()))
    }
}
