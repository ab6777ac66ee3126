//! Answers with an ETag: a client that already has the answer gets 304 and no body.

use super::problem::Problem;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// The document as JSON, or 304 if `If-None-Match` names its tag.
pub(super) fn json(asked: &HeaderMap, document: &impl Serialize) -> Result<Response, Problem> {
    let body = serde_json::to_vec(document).map_err(|error| Problem::internal(&error))?;
    let digits = blake3::hash(&body).to_hex();
    let tag = format!("\"{}\"", &digits[..32]);
    let value = HeaderValue::from_str(&tag).map_err(|error| Problem::internal(&error))?;
    let tag_header = [(header::ETAG, value)];
    if names(asked, &tag) {
        return Ok((StatusCode::NOT_MODIFIED, tag_header).into_response());
    }
    let json = [(header::CONTENT_TYPE, "application/json")];
    Ok((tag_header, json, body).into_response())
}

/// True if `If-None-Match` names this tag, by the weak comparison of RFC 9110.
fn names(asked: &HeaderMap, tag: &str) -> bool {
    let lists = asked.get_all(header::IF_NONE_MATCH).into_iter();
    lists.filter_map(|list| list.to_str().ok()).any(|list| {
        let mut tags = list.split(',').map(str::trim);
        tags.any(|other| other == "*" || other.strip_prefix("W/").unwrap_or(other) == tag)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_document_is_not_sent_twice() {
        let first = json(&HeaderMap::new(), &[1, 2]).unwrap();
        assert_eq!(first.status(), StatusCode::OK);
        let tag = first.headers()[header::ETAG].clone();
        let weak = format!("\"x\", W/{}", tag.to_str().unwrap());
        for value in [tag, weak.parse().unwrap(), HeaderValue::from_static("*")] {
            let mut asked = HeaderMap::new();
            asked.insert(header::IF_NONE_MATCH, value);
            let again = json(&asked, &[1, 2]).unwrap();
            assert_eq!(again.status(), StatusCode::NOT_MODIFIED);
            let other = json(&asked, &[1, 3]).unwrap();
            let is_star = asked[header::IF_NONE_MATCH] == "*";
            assert_eq!(other.status() == StatusCode::OK, !is_star);
        }
    }
}
