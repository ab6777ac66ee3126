//! Answers with an ETag: a client that already has the answer gets 304 and no body.

use super::problem::Problem;
use axum::http::{HeaderMap, HeaderName, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// Name of an answer's content. It is weak, since the content has the same one in all codings,
/// compressed or not.
#[derive(Debug, Clone)]
pub(super) struct Tag(String);

impl Tag {
    /// The tag of this content.
    pub(super) fn of(content: &[u8]) -> Self {
        let digits = blake3::hash(content).to_hex();
        Self(format!("W/\"{}\"", &digits[..32]))
    }

    /// Its header.
    pub(super) fn header(&self) -> [(HeaderName, String); 1] {
        [(header::ETAG, self.0.clone())]
    }

    /// The answer 304, if `If-None-Match` names this tag.
    pub(super) fn unchanged(&self, asked: &HeaderMap) -> Option<Response> {
        let unchanged = || (StatusCode::NOT_MODIFIED, self.header()).into_response();
        self.is_in(asked).then(|| varied(unchanged()))
    }

    /// True if `If-None-Match` names this tag, by the weak comparison of RFC 9110.
    fn is_in(&self, asked: &HeaderMap) -> bool {
        let lists = asked.get_all(header::IF_NONE_MATCH).into_iter();
        lists.filter_map(|list| list.to_str().ok()).any(|list| {
            let mut tags = list.split(',').map(str::trim);
            tags.any(|other| other == "*" || opaque(other) == opaque(&self.0))
        })
    }
}

/// A tag without its mark of weakness.
fn opaque(tag: &str) -> &str {
    tag.strip_prefix("W/").unwrap_or(tag)
}

/// The answer with the header that keeps caches from giving one coding to a client of another.
pub(super) fn varied(mut response: Response) -> Response {
    let vary = HeaderValue::from_static("accept-encoding");
    response.headers_mut().insert(header::VARY, vary);
    response
}

/// The document as JSON, or 304 if `If-None-Match` names its tag.
pub(super) fn json(asked: &HeaderMap, document: &impl Serialize) -> Result<Response, Problem> {
    let body = serde_json::to_vec(document).map_err(|error| Problem::internal(&error))?;
    let tag = Tag::of(&body);
    let json = [(header::CONTENT_TYPE, "application/json")];
    let unchanged = tag.unchanged(asked);
    Ok(unchanged.unwrap_or_else(|| varied((tag.header(), json, body).into_response())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_document_is_not_sent_twice() {
        let first = json(&HeaderMap::new(), &[1, 2]).unwrap();
        assert_eq!(first.status(), StatusCode::OK);
        let tag = first.headers()[header::ETAG].clone();
        let strong = format!("\"x\", {}", opaque(tag.to_str().unwrap()));
        for value in [tag, strong.parse().unwrap(), HeaderValue::from_static("*")] {
            let mut asked = HeaderMap::new();
            asked.insert(header::IF_NONE_MATCH, value);
            let again = json(&asked, &[1, 2]).unwrap();
            assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
            assert_eq!(again.headers()[header::VARY], "accept-encoding");
            let other = json(&asked, &[1, 3]).unwrap();
            let is_star = asked[header::IF_NONE_MATCH] == "*";
            assert_eq!(other.status() == StatusCode::OK, !is_star);
        }
    }
}
