//! Body of a request that contains a scenario.

use super::problem::Problem;
use axum::body::Bytes;
use axum::extract::{FromRequest, Request};
use axum::http::{HeaderMap, StatusCode, header};
use tokio::time::{Instant, timeout_at};

/// Deadline for the body of a request.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyDeadline(pub(super) Instant);

/// The text of a JSON body.
pub(super) struct ScenarioText(pub(super) String);

impl<S: Send + Sync> FromRequest<S> for ScenarioText {
    type Rejection = Problem;

    async fn from_request(request: Request, state: &S) -> Result<Self, Problem> {
        if !is_json(request.headers()) {
            return Err(Problem::new(
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                "unsupported-media-type",
                "Unsupported media type",
                "a scenario is sent as Content-Type: application/json",
            ));
        }
        let deadline = request.extensions().get().copied();
        let body = Bytes::from_request(request, state);
        let body = match deadline {
            Some(BodyDeadline(deadline)) => {
                timeout_at(deadline, body).await.map_err(|_| too_slow())?
            }
            None => body.await,
        };
        let bytes = body.map_err(|rejection| match rejection.status() {
            StatusCode::PAYLOAD_TOO_LARGE => Problem::new(
                StatusCode::PAYLOAD_TOO_LARGE,
                "too-large",
                "Body too large",
                "the body is larger than limits.request_body_bytes of this service",
            ),
            _ => malformed(&rejection.body_text()),
        })?;
        let text = String::from_utf8(bytes.into());
        text.map(Self)
            .map_err(|error| malformed(&format!("the body is not UTF-8: {error}")))
    }
}

fn too_slow() -> Problem {
    Problem::new(
        StatusCode::REQUEST_TIMEOUT,
        "too-slow",
        "Body too slow",
        "the body took longer than limits.body_read_timeout_s of this service",
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

fn is_json(headers: &HeaderMap) -> bool {
    let content_type = headers
        .get(header::CONTENT_TYPE)
        .and_then(|value| value.to_str().ok());
    let essence = content_type
        .and_then(|text| text.split(';').next())
        .unwrap_or_default();
    let essence = essence.trim().to_ascii_lowercase();
    essence == "application/json"
        || (essence.starts_with("application/") && essence.ends_with("+json"))
}
