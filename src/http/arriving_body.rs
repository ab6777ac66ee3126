//! The body of a request as it arrives: the table of connections learns when the service waits for
//! the client to send more of it.

use super::connections::OpenConnection;
use axum::body::Bytes;
use hyper::body::{Body as HttpBody, Frame, Incoming, SizeHint};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};

/// A body that notes when it waits for its client.
pub(super) struct ArrivingBody {
    body: Incoming,
    connection: Arc<OpenConnection>,
    is_stalled: bool,
}

impl ArrivingBody {
    pub(super) fn new(body: Incoming, connection: Arc<OpenConnection>) -> Self {
        Self {
            body,
            connection,
            is_stalled: false,
        }
    }

    fn note(&mut self, waits: bool) {
        if self.is_stalled != waits {
            self.is_stalled = waits;
            self.connection.stall(waits);
        }
    }
}

impl HttpBody for ArrivingBody {
    type Data = Bytes;
    type Error = hyper::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, hyper::Error>>> {
        let frame = Pin::new(&mut self.body).poll_frame(context);
        self.note(frame.is_pending());
        frame
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

impl Drop for ArrivingBody {
    fn drop(&mut self) {
        self.note(false);
    }
}
