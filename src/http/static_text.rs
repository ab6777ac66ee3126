//! Texts that are the same for every request: contract and page. They are compressed once.

use super::coding::Coding;
use super::compression::SMALLEST;
use super::etag::{Tag, varied};
use axum::body::Bytes;
use axum::http::{HeaderMap, header};
use axum::response::{IntoResponse, Response};
use flate2::write::GzEncoder;
use std::io::{self, Write as _};

/// Level of zstd: that of the texts takes some milliseconds.
const ZSTD_LEVEL: i32 = 9;

/// A text that is the same for every request.
#[derive(Debug, Clone)]
pub(super) struct StaticText {
    media_type: &'static str,
    tag: Tag,
    plain: Bytes,
    /// The text in each coding; none of a small one.
    coded: Vec<(Coding, Bytes)>,
}

impl StaticText {
    /// The text of this media type, compressed.
    pub(super) fn new(media_type: &'static str, text: impl Into<Bytes>) -> Self {
        let plain: Bytes = text.into();
        let codings = [Coding::Gzip, Coding::Zstd];
        let small = plain.len() < usize::from(SMALLEST);
        let codings = codings.into_iter().filter(|_| !small);
        let coded = codings.filter_map(|coding| {
            // Writing into memory fails only if there is none: then the text is sent as it is.
            let bytes = compressed(coding, &plain).ok()?;
            Some((coding, Bytes::from(bytes)))
        });
        Self {
            media_type,
            tag: Tag::of(&plain),
            coded: coded.collect(),
            plain,
        }
    }

    /// The answer to a request with these headers.
    pub(super) fn answer(&self, asked: &HeaderMap) -> Response {
        if let Some(unchanged) = self.tag.unchanged(asked) {
            return unchanged;
        }
        let kind = [(header::CONTENT_TYPE, self.media_type)];
        let chosen = Coding::chosen(asked);
        let coded = self
            .coded
            .iter()
            .find(|(coding, _)| Some(*coding) == chosen);
        match coded {
            Some((coding, bytes)) => {
                let coding = [(header::CONTENT_ENCODING, coding.word())];
                varied((self.tag.header(), kind, coding, bytes.clone()).into_response())
            }
            None => varied((self.tag.header(), kind, self.plain.clone()).into_response()),
        }
    }
}

fn compressed(coding: Coding, text: &[u8]) -> io::Result<Vec<u8>> {
    match coding {
        Coding::Gzip => {
            let mut encoder = GzEncoder::new(Vec::new(), flate2::Compression::default());
            encoder.write_all(text)?;
            encoder.finish()
        }
        Coding::Zstd => zstd::encode_all(text, ZSTD_LEVEL),
    }
}
