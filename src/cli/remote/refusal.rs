//! Failures of requests that give nothing: no answer, a refusal, or another's answer.

use super::connection::in_client_file;
use crate::cli::failure::Failure;
use crate::cli::scenario_file::broken_rules;
use scree_solver::scenario::Violation;
use serde::Deserialize;
use serde_json::Value;
use thiserror::Error;

/// Media type of a problem document.
pub(super) const PROBLEM: &str = "application/problem+json";

/// Request that gave nothing.
#[derive(Debug, Error)]
pub(super) enum RequestError {
    /// No answer, or none that is whole.
    #[error("no answer from {url}: {cause}")]
    Unreachable {
        url: String,
        cause: String,
        /// True if a repetition may be answered.
        is_temporary: bool,
        /// True if there was no connection at all.
        is_unconnected: bool,
    },
    /// A refusal by the service.
    #[error("{url} refused: {}: {}", problem.title, problem.detail)]
    Refused { url: String, problem: Box<Problem> },
    /// An answer that is none of the service's, such as that of a proxy or of another program.
    #[error("{url} answered {status}: {beginning}")]
    Unexpected {
        url: String,
        status: u16,
        beginning: String,
    },
}

/// Problem document of a refusal (RFC 9457).
#[derive(Debug, Deserialize)]
pub(super) struct Problem {
    #[serde(rename = "type")]
    kind: String,
    title: String,
    status: u16,
    detail: String,
    #[serde(default)]
    errors: Vec<FieldError>,
}

/// Fault of one field or parameter.
#[derive(Debug, Deserialize)]
struct FieldError {
    pointer: Option<String>,
    parameter: Option<String>,
    #[serde(default)]
    value: Value,
    allowed: String,
    unit: Option<String>,
    detail: String,
}

impl RequestError {
    /// True if a repetition may be answered otherwise. A key is in use while the service still
    /// stores a request whose connection broke.
    pub(super) fn is_temporary(&self) -> bool {
        match self {
            Self::Unreachable { is_temporary, .. } => *is_temporary,
            Self::Refused { problem, .. } => {
                problem.is("key-in-use") || matches!(problem.status, 429 | 503)
            }
            // Of a proxy whose service restarts.
            Self::Unexpected { status, .. } => matches!(status, 429 | 502..=504),
        }
    }

    /// True if there was no connection at all.
    pub(super) fn is_unconnected(&self) -> bool {
        matches!(
            self,
            Self::Unreachable {
                is_unconnected: true,
                ..
            }
        )
    }

    /// True if there was a connection, and it broke.
    pub(super) fn has_broken(&self) -> bool {
        matches!(
            self,
            Self::Unreachable {
                is_unconnected: false,
                ..
            }
        )
    }

    /// The last error of a submission whose answer may have been lost.
    pub(super) fn after_sending(mut self) -> Self {
        if let Self::Unreachable { cause, .. } = &mut self {
            cause.push_str(
                "\nwhat was sent may have been accepted all the same: `scree get` lists the newest jobs",
            );
        }
        self
    }

    /// True if the service says that what was asked for does not exist.
    pub(super) fn is_missing(&self) -> bool {
        matches!(self, Self::Refused { problem, .. } if problem.status == 404)
    }

    /// Failure of a command that sent a document of this name.
    pub(super) fn about(self, name: &str) -> Failure {
        match self {
            Self::Refused { problem, .. } if !problem.errors.is_empty() => {
                Failure::Input(problem.faults(name))
            }
            Self::Refused { problem, .. } if problem.is_of_the_document() => {
                Failure::Input(format!("{name}: {}: {}", problem.title, problem.detail))
            }
            other => other.into(),
        }
    }
}

impl From<RequestError> for Failure {
    fn from(error: RequestError) -> Self {
        let text = error.to_string();
        match error {
            RequestError::Refused { problem, .. } if !problem.errors.is_empty() => {
                Self::Input(problem.faults("the request"))
            }
            RequestError::Refused { problem, .. } if problem.asks_for_a_token() => {
                Self::Other(format!(
                    "{text}\na token can be given by SCREE_TOKEN, --token-file, or {}",
                    in_client_file("token")
                ))
            }
            RequestError::Refused { problem, .. }
                if problem.status == 404 || problem.is_of_the_document() =>
            {
                Self::Input(text)
            }
            _ => Self::Other(text),
        }
    }
}

impl Problem {
    fn is(&self, kind: &str) -> bool {
        self.kind.strip_prefix("urn:scree:problem:") == Some(kind)
    }

    /// True if the document that was sent is at fault.
    fn is_of_the_document(&self) -> bool {
        matches!(self.status, 400 | 413 | 415 | 422)
    }

    fn asks_for_a_token(&self) -> bool {
        self.is("no-token") || self.is("not-allowed")
    }

    /// All faults, as `scree validate` tells them; those of parameters are none of the document.
    fn faults(self, name: &str) -> String {
        let is_of_document = self.errors.iter().any(|error| error.parameter.is_none());
        let name = if is_of_document { name } else { "the request" };
        let violations: Vec<Violation> = self.errors.into_iter().map(Violation::from).collect();
        broken_rules(&violations, name)
    }
}

impl From<FieldError> for Violation {
    fn from(error: FieldError) -> Self {
        Self {
            pointer: error.pointer.or(error.parameter).unwrap_or_default(),
            value: error.value,
            allowed: error.allowed,
            unit: error.unit,
            detail: error.detail,
        }
    }
}
