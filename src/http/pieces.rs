//! Bodies of answers that are made piece by piece, as the client reads them.

use axum::body::{Body, Bytes};
use futures_util::{Stream, StreamExt, stream};
use std::error::Error;

/// Source of the pieces of a body.
pub(super) trait Pieces: Send + Sized + 'static {
    /// Name of the body in the log.
    const NAME: &'static str;

    /// Error of a piece.
    type Error: Error + Send + Sync + 'static;

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

/// The pieces; none again after the last, since what compresses a body asks once more at its end.
fn stream_of<P: Pieces>(pieces: P) -> impl Stream<Item = Result<Bytes, P::Error>> {
    let pieces = stream::unfold(Some(pieces), |pieces| async {
        let mut pieces = pieces?;
        match pieces.piece().await {
            Ok(None) => None,
            Ok(Some(bytes)) => Some((Ok(bytes), Some(pieces))),
            Err(error) => {
                tracing::error!(%error, body = P::NAME, "an answer breaks off");
                Some((Err(error), None))
            }
        }
    });
    pieces.fuse()
}
