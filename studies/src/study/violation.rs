//! Violation of a rule by a study document.

use serde::{Deserialize, Serialize};
use std::fmt::Display;

/// Violation of a rule, at a place in the study document.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = StudyViolation))]
pub struct Violation {
    /// Place in the study document, a JSON pointer (RFC 6901).
    pub pointer: String,
    /// Field, its value and what is allowed, in one phrase for people.
    pub message: String,
}

/// What stands between a fault and the rule in a message.
const ALLOWED: &str = ", allowed: ";

impl Violation {
    /// What is allowed: the last part of the message, or all of it if that is the rule itself.
    pub fn allowed(&self) -> &str {
        let parts = self.message.rsplit_once(ALLOWED);
        parts.map_or(&self.message, |(_, allowed)| allowed)
    }

    pub(crate) fn new(pointer: &str, message: impl Into<String>) -> Self {
        Self {
            pointer: pointer.to_owned(),
            message: message.into(),
        }
    }

    /// Violation of a field by its value.
    pub fn of(pointer: &str, value: impl Display, allowed: impl Display) -> Self {
        let field = field(pointer);
        Self::new(pointer, format!("{field} is {value}{ALLOWED}{allowed}"))
    }

    /// Violations of a part of a document, as those of the whole: the part's place is put before
    /// each pointer.
    pub(crate) fn under(place: &str, mut found: Vec<Self>) -> Vec<Self> {
        for violation in &mut found {
            violation.pointer.insert_str(0, place);
        }
        found
    }
}

/// Name of a field for people: the pointer's last token, after that of its list if it is an index,
/// as in "levels[1]".
fn field(pointer: &str) -> String {
    let mut tokens = pointer.rsplit('/');
    let last = tokens.next().unwrap_or_default();
    let list = tokens
        .next()
        .filter(|_| last.bytes().all(|byte| byte.is_ascii_digit()));
    list.map_or(last.to_owned(), |list| format!("{list}[{last}]"))
}
