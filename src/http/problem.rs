//! Problem documents (RFC 9457).

use super::field_errors::{FieldError, FieldErrors};
use crate::jobs::store::{StoreError, StoreErrorKind};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use std::fmt::Display;
use utoipa::ToSchema;
use uuid::Uuid;

/// Media type of a problem document.
pub(super) const MEDIA_TYPE_TEXT: &str = "application/problem+json";
const MEDIA_TYPE: HeaderValue = HeaderValue::from_static(MEDIA_TYPE_TEXT);

/// Seconds after which a client may retry if the database is unavailable.
const RETRY_AFTER_S: u8 = 5;

/// Seconds after which a client may retry if there is too much of something.
const RETRY_BUSY_AFTER_S: u8 = 10;

/// Problem document: reason why a request failed (RFC 9457).
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub(super) struct Problem {
    /// Kind of problem, as a stable name.
    #[serde(rename = "type")]
    pub kind: String,
    /// Name of the kind, for people.
    pub title: &'static str,
    /// HTTP status.
    pub status: u16,
    /// Cause of this occurrence.
    pub detail: String,
    /// All faults of the request, field by field.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[schema(required = false)]
    pub errors: Vec<FieldError>,
    /// Seconds after which a retry may succeed.
    #[serde(skip)]
    pub retry_after_s: Option<u8>,
    /// Identifier of the details of an internal error in the service's log.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_id: Option<String>,
}

impl Problem {
    /// A problem of this kind.
    pub(super) fn new(
        status: StatusCode,
        kind: &str,
        title: &'static str,
        detail: impl Into<String>,
    ) -> Self {
        Self {
            kind: format!("urn:scree:problem:{kind}"),
            title,
            status: status.as_u16(),
            detail: detail.into(),
            errors: Vec::new(),
            retry_after_s: None,
            error_id: None,
        }
    }

    /// There is too much of something, of the caller's or in all.
    pub(super) fn busy(kind: &str, title: &'static str, detail: &str) -> Self {
        let detail = format!("{detail}; try again later");
        Self::new(StatusCode::TOO_MANY_REQUESTS, kind, title, detail)
            .retry_after(RETRY_BUSY_AFTER_S)
    }

    /// The same problem, with the seconds after which a retry may succeed.
    pub(super) fn retry_after(self, seconds: u8) -> Self {
        Self {
            retry_after_s: Some(seconds),
            ..self
        }
    }

    /// The same problem of a document that has the refused one at `pointer`.
    pub(super) fn under(self, pointer: &str) -> Self {
        let errors = self.errors.into_iter();
        Self {
            errors: errors.map(|error| error.under(pointer)).collect(),
            ..self
        }
    }

    /// The thing asked for does not exist.
    pub(super) fn not_found(what: &str, detail: impl Into<String>) -> Self {
        Self::new(StatusCode::NOT_FOUND, what, "Not found", detail)
    }

    /// The request does not go together with the state of what it is about.
    pub(super) fn conflict(kind: &str, title: &'static str, detail: impl Into<String>) -> Self {
        Self::new(StatusCode::CONFLICT, kind, title, detail)
    }

    /// A body that is JSON, but not a legal scenario.
    pub(super) fn invalid_scenario(faults: FieldErrors) -> Self {
        let status = StatusCode::UNPROCESSABLE_ENTITY;
        let detail = faults.summary();
        Self {
            errors: faults.into_list(),
            ..Self::new(status, "invalid-scenario", "Invalid scenario", detail)
        }
    }

    /// A query with parameters that are unknown or not allowed.
    pub(super) fn invalid_query(faults: FieldErrors) -> Self {
        let status = StatusCode::UNPROCESSABLE_ENTITY;
        let detail = faults.summary();
        Self {
            errors: faults.into_list(),
            ..Self::new(status, "invalid-query", "Invalid query", detail)
        }
    }

    /// An internal error: the details go to the log, the client
    /// gets their identifier.
    pub(super) fn internal(error: &(impl Display + ?Sized)) -> Self {
        let error_id = Uuid::now_v7().to_string();
        tracing::error!(error_id, %error, "internal error");
        let detail = "the service's log has the details under this error_id";
        let status = StatusCode::INTERNAL_SERVER_ERROR;
        Self {
            error_id: Some(error_id),
            ..Self::new(status, "internal", "Internal error", detail)
        }
    }
}

impl From<StoreError> for Problem {
    fn from(error: StoreError) -> Self {
        Self::from(&error)
    }
}

impl From<&StoreError> for Problem {
    fn from(error: &StoreError) -> Self {
        match error.kind() {
            StoreErrorKind::Defect => Self::internal(error),
            StoreErrorKind::Damaged => Self {
                kind: "urn:scree:problem:damaged-record".to_owned(),
                title: "Damaged record",
                detail: format!("{error}; a backup may still have it"),
                ..Self::internal(error)
            },
            StoreErrorKind::Full => {
                tracing::error!(%error, "no room");
                let detail = "there is no room for it on the disk; what is stored is safe";
                let status = StatusCode::INSUFFICIENT_STORAGE;
                Self::new(status, "storage-full", "No room", detail)
            }
            StoreErrorKind::Unavailable => {
                tracing::error!(%error, "the database can't be used");
                let detail =
                    "the database can't be used now; /readyz and the service's log say why";
                let status = StatusCode::SERVICE_UNAVAILABLE;
                Self::new(status, "storage-unavailable", "No database", detail)
                    .retry_after(RETRY_AFTER_S)
            }
        }
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let status = StatusCode::from_u16(self.status).unwrap_or(StatusCode::INTERNAL_SERVER_ERROR);
        let retry_after_s = self.retry_after_s;
        let mut response = (status, axum::Json(self)).into_response();
        response
            .headers_mut()
            .insert(header::CONTENT_TYPE, MEDIA_TYPE);
        if let Some(seconds) = retry_after_s {
            response
                .headers_mut()
                .insert(header::RETRY_AFTER, u16::from(seconds).into());
        }
        response
    }
}
