//! Bodies of answers that are made piece by piece, as the client reads them.

use super::problem::Problem;
use crate::jobs::store::StoreError;
use axum::body::{Body, Bytes};
use futures_util::{Stream, StreamExt, stream};
use std::error::Error as AnyError;
use std::num::NonZero;
use std::sync::LazyLock;
use std::thread::available_parallelism;
use thiserror::Error;
use tokio::sync::Semaphore;
use tokio::task::{JoinError, spawn_blocking};

/// Places for work off the answering threads: as many as the machine has cores.
static PLACES: LazyLock<Semaphore> = LazyLock::new(|| {
    let cores = available_parallelism().map_or(1, NonZero::get);
    Semaphore::new(cores)
});

/// Error of a piece that is made from stored records.
#[derive(Debug, Error)]
pub(super) enum PieceError {
    /// The store's own error.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The work panicked, or the service ends.
    #[error("the work broke off: {0}")]
    BrokenOff(#[from] JoinError),
}

impl From<PieceError> for Problem {
    fn from(error: PieceError) -> Self {
        match error {
            PieceError::Store(error) => error.into(),
            PieceError::BrokenOff(_) => Self::internal(&error),
        }
    }
}

/// Does the work of a piece on another thread than those that answer requests
/// ([decision 48](../../docs/decisions/0048-pieces-of-answers-on-blocking-threads.md)).
pub(super) async fn off_the_answering_threads<T: Send + 'static>(
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, JoinError> {
    // None is ever closed.
    let place = PLACES.acquire().await.ok();
    let worked = spawn_blocking(move || {
        let result = work();
        drop(place);
        result
    });
    worked.await
}

/// Source of the pieces of a body.
pub(super) trait Pieces: Send + Sized + 'static {
    /// Name of the body in the log.
    const NAME: &'static str;

    /// Error of a piece.
    type Error: AnyError + Send + Sync + 'static;

    /// The next piece; `None` after the last.
    fn piece(&mut self) -> impl Future<Output = Result<Option<Bytes>, Self::Error>> + Send;

    /// The body. An error breaks the connection off, so that no part looks like the whole.
    fn into_body(self) -> Body {
        Body::from_stream(stream_of(self))
    }

    /// The body, whose first piece is made now, before the head of the answer is sent: an error in
    /// it can still be told.
    async fn into_begun_body(mut self) -> Result<Body, Self::Error> {
        let first = stream::iter(self.piece().await?.map(Ok));
        Ok(Body::from_stream(first.chain(stream_of(self))))
    }
}

fn stream_of<P: Pieces>(pieces: P) -> impl Stream<Item = Result<Bytes, P::Error>> {
    stream::unfold(Some(pieces), |pieces| async {
        let mut pieces = pieces?;
        match pieces.piece().await {
            Ok(None) => None,
            Ok(Some(bytes)) => Some((Ok(bytes), Some(pieces))),
            Err(error) => {
                tracing::error!(%error, body = P::NAME, "an answer breaks off");
                Some((Err(error), None))
            }
        }
    })
}
