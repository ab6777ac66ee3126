//! Bodies of answers.

use crate::cli::failure::Failure;
use serde::de::DeserializeOwned;
use uuid::Uuid;

/// Text of an answer.
///
/// # Errors
/// It is no text.
pub(super) fn text(answer: Vec<u8>) -> Result<String, Failure> {
    String::from_utf8(answer)
        .map_err(|error| Failure::other("the service's answer is no text", error))
}

/// Document in an answer.
///
/// # Errors
/// It has another form.
pub(super) fn understood<T: DeserializeOwned>(text: &str) -> Result<T, Failure> {
    let what = "the service's answer is not understood; the service may be of another version";
    serde_json::from_str(text).map_err(|error| Failure::other(what, error))
}

/// Identifier in an answer.
///
/// # Errors
/// It has another form.
pub(super) fn identifier(text: &str) -> Result<Uuid, Failure> {
    let what = "the service's answer has no identifier";
    text.parse()
        .map_err(|error: uuid::Error| Failure::other(what, error))
}
