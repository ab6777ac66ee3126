//! A connection that is closed if the client stops reading: hyper itself would
//! wait for ever. Until then the table of connections learns that it waits.

use std::io;
use std::pin::Pin;
use std::task::{Context, Poll, ready};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Instant, Sleep, sleep};

/// Closes a connection once a write has made no progress for too long.
pub(super) struct SlowClientTimeout<T, F> {
    stream: T,
    limit: Duration,
    stalled: Pin<Box<Sleep>>,
    is_stalled: bool,
    on_stall: F,
}

impl<T, F: Fn(bool)> SlowClientTimeout<T, F> {
    /// The connection; `on_stall` is called when a write begins to wait for the client, and when
    /// it goes on.
    pub(super) fn new(stream: T, limit: Duration, on_stall: F) -> Self {
        Self {
            stream,
            limit,
            stalled: Box::pin(sleep(limit)),
            is_stalled: false,
            on_stall,
        }
    }

    /// `written`, or an error if the last progress is too long ago.
    fn judge<R>(
        &mut self,
        context: &mut Context<'_>,
        written: Poll<io::Result<R>>,
    ) -> Poll<io::Result<R>> {
        if written.is_ready() {
            if self.is_stalled {
                self.is_stalled = false;
                (self.on_stall)(false);
            }
            return written;
        }
        if !self.is_stalled {
            self.is_stalled = true;
            (self.on_stall)(true);
            self.stalled.as_mut().reset(Instant::now() + self.limit);
        }
        ready!(self.stalled.as_mut().poll(context));
        Poll::Ready(Err(io::Error::new(
            io::ErrorKind::TimedOut,
            "the client does not take its answer",
        )))
    }
}

impl<T: AsyncRead + Unpin, F: Unpin> AsyncRead for SlowClientTimeout<T, F> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl<T: AsyncWrite + Unpin, F: Fn(bool) + Unpin> AsyncWrite for SlowClientTimeout<T, F> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.judge(context, written)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, slices);
        self.judge(context, written)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        let flushed = Pin::new(&mut self.stream).poll_flush(context);
        self.judge(context, flushed)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;
    use tokio::io::{AsyncReadExt, AsyncWriteExt, duplex};

    #[tokio::test]
    async fn a_client_that_never_reads_is_given_up_and_a_slow_one_is_not() {
        let limit = Duration::from_millis(100);
        let (ours, _theirs) = duplex(8);
        let stalls = Mutex::new(Vec::new());
        let mut ours =
            SlowClientTimeout::new(ours, limit, |waits| stalls.lock().unwrap().push(waits));
        let error = ours.write_all(&[0; 64]).await.unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::TimedOut);
        assert_eq!(*stalls.lock().unwrap(), [true]);

        let (ours, mut theirs) = duplex(8);
        let mut ours = SlowClientTimeout::new(ours, limit, |_| ());
        let reader = tokio::spawn(async move {
            let mut taken = 0;
            while taken < 64 {
                sleep(limit / 4).await;
                taken += theirs.read(&mut [0; 8]).await.unwrap();
            }
        });
        ours.write_all(&[0; 64]).await.unwrap();
        reader.await.unwrap();
    }
}
