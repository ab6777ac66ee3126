//! Body of a request that contains a scenario.

use super::problem::Problem;
use crate::jobs::submit::excerpt;
use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, HeaderName, StatusCode, header};
use hyper::body::Body as _;
use serde::de::DeserializeOwned;
use tokio::time::{Instant, timeout_at};

/// Limits of the body of a request.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyLimits {
    /// Time by which it must be there.
    pub deadline: Instant,
    /// Largest length [bytes].
    pub bytes: usize,
}

/// The text of a JSON body.
pub(super) struct ScenarioText(pub(super) String);

impl<S: Send + Sync> FromRequest<S> for ScenarioText {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        check_media_type(request.headers())?;
        // Inserted by a layer that every request passes.
        let limits = request.extensions().get::<BodyLimits>().copied();
        let limits = limits.ok_or_else(|| Problem::internal("a body without limits"))?;
        // A length that is announced is refused before the body is asked for (100 Continue).
        if request.body().size_hint().lower() > limits.bytes as u64 {
            return Err(too_large(LARGEST_BODY, limits.bytes));
        }
        let body = timeout_at(limits.deadline, Bytes::from_request(request, state)).await;
        let body = body.map_err(|_| too_slow("limits.body_read_timeout_s"))?;
        let bytes = body.map_err(|rejection| match rejection.status() {
            StatusCode::PAYLOAD_TOO_LARGE => too_large(LARGEST_BODY, limits.bytes),
            _ => malformed(&rejection.body_text()),
        })?;
        let text = String::from_utf8(bytes.into());
        text.map(Self)
            .map_err(|error| malformed(&format!("the body is not UTF-8: {error}")))
    }
}

/// Key of the largest body.
const LARGEST_BODY: &str = "limits.request_body_bytes";

/// A body larger than this key of the configuration allows.
pub(super) fn too_large(key: &str, limit: usize) -> Problem {
    Problem::new(
        StatusCode::PAYLOAD_TOO_LARGE,
        "too-large",
        "Body too large",
        format!("the body is larger than {key} of this service, {limit} bytes"),
    )
}

/// A body that takes longer than this key of the configuration allows.
pub(super) fn too_slow(key: &str) -> Problem {
    Problem::new(
        StatusCode::REQUEST_TIMEOUT,
        "too-slow",
        "Body too slow",
        format!("the body took longer than {key} of this service"),
    )
}

/// A body that is not JSON.
pub(super) fn malformed(detail: &str) -> Problem {
    Problem::new(
        StatusCode::BAD_REQUEST,
        "malformed-json",
        "Malformed JSON",
        detail,
    )
}

/// A document around scenarios, which are read later; `kind` is that of the problem if the
/// document has other members than it may have.
pub(super) fn read_envelope<T: DeserializeOwned>(
    text: &str,
    (kind, title): (&str, &'static str),
) -> Result<T, Problem> {
    serde_json::from_str(text).map_err(|error| {
        if !error.is_data() {
            return malformed(&error.to_string());
        }
        let status = StatusCode::UNPROCESSABLE_ENTITY;
        Problem::new(status, kind, title, without_long_texts(&error))
    })
}

/// The parser's message, which repeats a wrong key or text in full.
fn without_long_texts(error: &serde_json::Error) -> String {
    let position = format!(" at line {} column {}", error.line(), error.column());
    let message = error.to_string().replace(&position, "");
    format!("{}{position}", excerpt(&message))
}

/// Checks that the body is declared as JSON in UTF-8, uncompressed.
fn check_media_type(headers: &HeaderMap) -> Result<(), Problem> {
    let essence = essence(headers);
    let is_json = essence == "application/json"
        || (essence.starts_with("application/") && essence.ends_with("+json"));
    if !is_json {
        return Err(unsupported(
            "a scenario is sent as Content-Type: application/json",
        ));
    }
    let content_type = text(headers, header::CONTENT_TYPE).unwrap_or_default();
    let mut parameters = content_type.split(';').map(str::trim).skip(1);
    let charset = parameters.find_map(|part| part.strip_prefix("charset="));
    if charset.is_some_and(|charset| charset.trim_matches('"') != "utf-8") {
        return Err(unsupported("JSON is sent in UTF-8"));
    }
    check_encoding(headers)
}

/// Media type of the body, without parameters.
pub(super) fn essence(headers: &HeaderMap) -> String {
    let content_type = text(headers, header::CONTENT_TYPE).unwrap_or_default();
    let essence = content_type.split(';').next().unwrap_or_default();
    essence.trim().to_owned()
}

fn text(headers: &HeaderMap, name: HeaderName) -> Option<String> {
    let value = headers.get(name)?.to_str().ok()?;
    Some(value.trim().to_ascii_lowercase())
}

/// Checks that the body is declared as uncompressed.
pub(super) fn check_encoding(headers: &HeaderMap) -> Result<(), Problem> {
    match text(headers, header::CONTENT_ENCODING).as_deref() {
        None | Some("identity") => Ok(()),
        Some(_) => Err(unsupported(
            "a body is sent as it is, without Content-Encoding",
        )),
    }
}

pub(super) fn unsupported(rule: &str) -> Problem {
    Problem::new(
        StatusCode::UNSUPPORTED_MEDIA_TYPE,
        "unsupported-media-type",
        "Unsupported media type",
        rule,
    )
}
