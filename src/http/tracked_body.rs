//! The body of an answer, and what is held until it is written.

use axum::body::{Body, Bytes};
use hyper::body::{Body as HttpBody, Frame, SizeHint};
use std::any::Any;
use std::pin::Pin;
use std::task::{Context, Poll};

/// A body that drops something once it has been written or given up.
pub(super) struct TrackedBody {
    body: Body,
    _held: Box<dyn Any + Send>,
}

impl TrackedBody {
    /// The body, which holds this.
    pub(super) fn new(body: Body, held: impl Send + 'static) -> Self {
        Self {
            body,
            _held: Box::new(held),
        }
    }
}

impl HttpBody for TrackedBody {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        Pin::new(&mut self.body).poll_frame(context)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}
