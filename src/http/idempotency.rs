//! Idempotency-Key: a repeated request gets the answer that the first one got.

use super::problem::Problem;
use crate::jobs::JobService;
use crate::jobs::store::{KeptAnswer, Key};
use axum::body::Body;
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// Idempotency-Key of the request, if it has one.
pub(super) fn key(headers: &HeaderMap, request: &str) -> Result<Option<Key>, Problem> {
    let mut values = headers.get_all("idempotency-key").iter();
    let Some(value) = values.next() else {
        return Ok(None);
    };
    if values.next().is_some() {
        return Err(invalid("a request has one Idempotency-Key"));
    }
    let text = value.to_str().unwrap_or_default();
    let is_legal =
        (1..=255).contains(&text.len()) && text.bytes().all(|byte| byte.is_ascii_graphic());
    if !is_legal {
        return Err(invalid(
            "an Idempotency-Key has 1 to 255 visible ASCII characters",
        ));
    }
    Ok(Some(Key {
        text: text.to_owned(),
        request_hash: *blake3::hash(request.as_bytes()).as_bytes(),
    }))
}

fn invalid(rule: &str) -> Problem {
    Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "invalid-key",
        "Invalid Idempotency-Key",
        rule,
    )
}

/// The answer in the form in which it is sent and kept.
pub(super) fn answer(
    status: StatusCode,
    location: Option<String>,
    document: &impl Serialize,
) -> Result<KeptAnswer, Problem> {
    let body = serde_json::to_string(document).map_err(|error| Problem::internal(&error))?;
    Ok(KeptAnswer {
        status: status.as_u16(),
        location,
        body,
    })
}

/// Sends an answer, kept before for repetitions if the request has a key.
pub(super) async fn send(
    jobs: &JobService,
    submitter: Option<&str>,
    key: Option<&Key>,
    answer: KeptAnswer,
) -> Response {
    response(match key {
        Some(key) => jobs.keep_answer(submitter, key, answer).await,
        None => answer,
    })
}

/// A kept answer as a response.
pub(super) fn response(answer: KeptAnswer) -> Response {
    let status = StatusCode::from_u16(answer.status).unwrap_or(StatusCode::OK);
    let json = HeaderValue::from_static("application/json");
    let mut response = (status, Body::from(answer.body)).into_response();
    let headers = response.headers_mut();
    headers.insert(header::CONTENT_TYPE, json);
    let location = answer.location.map(HeaderValue::try_from);
    if let Some(Ok(location)) = location {
        headers.insert(header::LOCATION, location);
    }
    response
}
