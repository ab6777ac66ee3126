//! Compression of answers: the coding that a client gets, and the answers that are compressed. They
//! are compressed while they are sent, piece by piece, off the threads that answer requests
//! ([decision 48](../../docs/decisions/0048-pieces-of-answers-on-blocking-threads.md)).

use super::coding::Coding;
use super::etag::varied;
use super::pieces::off_the_answering_threads;
use axum::BoxError;
use axum::body::{Body, Bytes, HttpBody as _};
use axum::extract::Request;
use axum::http::{HeaderMap, Method, header};
use axum::middleware::Next;
use axum::response::Response;
use flate2::Compression;
use flate2::write::GzEncoder;
use futures_util::future::ready;
use futures_util::{TryStreamExt as _, stream};
use std::io::{self, Write as _};

/// Size below which an answer is sent as it is [bytes]: it fits one packet anyway.
pub(super) const SMALLEST: u16 = 1024;

/// Media types that are compressed. Archives are compressed already, and events must
/// not wait in a compressor.
const MEDIA_TYPES: [&str; 9] = [
    "application/json",
    "application/problem+json",
    "application/x-ndjson",
    "text/csv",
    "application/openmetrics-text",
    "image/svg+xml",
    "text/html",
    "text/javascript",
    "text/css",
];

/// Compresses the answers of these requests, and tells the requests which coding their answers may
/// have: `Accept-Encoding` is replaced by it.
pub(super) async fn compress(mut request: Request, next: Next) -> Response {
    let coding = Coding::preferred(request.headers());
    let headers = request.headers_mut();
    headers.remove(header::ACCEPT_ENCODING);
    if let Some(coding) = coding {
        headers.insert(header::ACCEPT_ENCODING, coding.value());
    }
    let has_body = request.method() != Method::HEAD;
    let response = next.run(request).await;
    let headers = response.headers();
    if !is_text(headers) || headers.contains_key(header::CONTENT_ENCODING) {
        return response;
    }
    let mut response = varied(response);
    let size = response.body().size_hint().exact();
    let small = size.is_some_and(|bytes| bytes < u64::from(SMALLEST));
    let coding = coding.filter(|_| has_body && !small);
    // Without memory for it the answer is sent as it is.
    match coding.and_then(|coding| Some((coding, Encoder::new(coding).ok()?))) {
        Some((coding, encoder)) => {
            let headers = response.headers_mut();
            headers.remove(header::CONTENT_LENGTH);
            headers.insert(header::CONTENT_ENCODING, coding.value());
            response.map(|body| compressed(body, encoder))
        }
        None => response,
    }
}

/// True for an answer of a media type that is compressed.
fn is_text(headers: &HeaderMap) -> bool {
    let kind = headers.get(header::CONTENT_TYPE);
    let kind = kind.and_then(|kind| kind.to_str().ok()).unwrap_or_default();
    let essence = kind.split(';').next().unwrap_or_default().trim();
    MEDIA_TYPES.contains(&essence)
}

/// The body through an encoder, piece by piece. An error in it breaks the connection off.
fn compressed(body: Body, encoder: Encoder) -> Body {
    let state = Some((body.into_data_stream(), encoder));
    let pieces = stream::try_unfold(state, |state| async {
        let Some((mut body, mut encoder)) = state else {
            return Ok(None);
        };
        let Some(piece) = body.try_next().await? else {
            let rest = off_the_answering_threads(|| encoder.finish()).await??;
            return Ok(Some((rest, None)));
        };
        let (bytes, encoder) = off_the_answering_threads(move || {
            let bytes = encoder.write(&piece);
            (bytes, encoder)
        })
        .await?;
        Ok::<_, BoxError>(Some((bytes?, Some((body, encoder)))))
    });
    Body::from_stream(pieces.try_filter(|bytes| ready(!bytes.is_empty())))
}

/// A compressor, with the fastest level of its coding.
enum Encoder {
    Gzip(GzEncoder<Vec<u8>>),
    Zstd(zstd::Encoder<'static, Vec<u8>>),
}

impl Encoder {
    fn new(coding: Coding) -> io::Result<Self> {
        Ok(match coding {
            Coding::Gzip => Self::Gzip(GzEncoder::new(Vec::new(), Compression::fast())),
            Coding::Zstd => Self::Zstd(zstd::Encoder::new(Vec::new(), 1)?),
        })
    }

    /// Takes a piece, and returns what is compressed by now.
    fn write(&mut self, piece: &[u8]) -> io::Result<Bytes> {
        let out = match self {
            Self::Gzip(encoder) => {
                encoder.write_all(piece)?;
                encoder.get_mut()
            }
            Self::Zstd(encoder) => {
                encoder.write_all(piece)?;
                encoder.get_mut()
            }
        };
        Ok(std::mem::take(out).into())
    }

    /// The rest.
    fn finish(self) -> io::Result<Bytes> {
        let rest = match self {
            Self::Gzip(encoder) => encoder.finish()?,
            Self::Zstd(encoder) => encoder.finish()?,
        };
        Ok(rest.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn a_body_that_breaks_off_is_not_taken_for_a_whole_one() {
        for whole in [true, false] {
            let error = (!whole).then(|| Err(io::Error::other("no more")));
            let pieces = [Ok(Bytes::from("a piece"))].into_iter().chain(error);
            let body = Body::from_stream(stream::iter(pieces));
            let encoder = Encoder::new(Coding::Gzip).unwrap();
            let body = compressed(body, encoder);
            let read = axum::body::to_bytes(body, 1000).await;
            assert_eq!(read.is_ok(), whole);
        }
    }
}
