//! Faults of a request, field by field.

use crate::jobs::submit::Violation;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

/// Largest number of faults that an answer lists: each may be longer than what it refuses.
const LISTED: usize = 500;

/// Fault of one field of the body or one parameter of the query.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
pub(super) struct FieldError {
    /// JSON pointer (RFC 6901) into the body, "" for the whole document.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pointer: Option<String>,
    /// Name of the query parameter, or of the header.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// Value received, shortened if it is a long text; null if it is missing.
    pub value: Value,
    /// Allowed values, in words or as a range.
    pub allowed: String,
    /// Unit of value and range; null if there is none.
    #[schema(required = true)]
    pub unit: Option<String>,
    /// One sentence for people.
    pub detail: String,
}

/// Faults of a request, of which the first are listed.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct FieldErrors {
    listed: Vec<FieldError>,
    further: usize,
}

impl FieldErrors {
    /// True if there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.listed.is_empty()
    }

    /// Adds a fault, made only if it is listed.
    pub(super) fn add(&mut self, fault: impl FnOnce() -> FieldError) {
        if self.listed.len() < LISTED {
            self.listed.push(fault());
        } else {
            self.further += 1;
        }
    }

    /// One sentence on all of them.
    pub(super) fn summary(&self) -> String {
        match self.listed.as_slice() {
            [only] => only.detail.clone(),
            listed => {
                let count = listed.len() + self.further;
                format!("{count} fields break the rules; see errors")
            }
        }
    }

    /// The list; the last entry tells how many it leaves out.
    pub(super) fn into_list(self) -> Vec<FieldError> {
        let mut list = self.listed;
        if self.further > 0 {
            let further = format!("{} further faults, not listed", self.further);
            list.push(FieldError {
                detail: further,
                ..FieldError::of_body("", Value::Null, "see the documentation")
            });
        }
        list
    }
}

/// Faults of one scenario, whose list is cut already, and says so.
impl From<Vec<Violation>> for FieldErrors {
    fn from(violations: Vec<Violation>) -> Self {
        Self {
            listed: violations.into_iter().map(FieldError::from).collect(),
            further: 0,
        }
    }
}

impl From<FieldError> for FieldErrors {
    fn from(only: FieldError) -> Self {
        Self {
            listed: vec![only],
            further: 0,
        }
    }
}

impl FieldError {
    /// Fault of a value in the body.
    pub(super) fn of_body(pointer: &str, value: Value, allowed: &str) -> Self {
        Self {
            pointer: Some(pointer.to_owned()),
            parameter: None,
            value,
            allowed: allowed.to_owned(),
            unit: None,
            detail: format!("{pointer} is not allowed: {allowed}"),
        }
    }

    /// The same fault in a document that contains this one at `pointer`.
    pub(super) fn under(self, pointer: &str) -> Self {
        let own = self.pointer.unwrap_or_default();
        Self {
            pointer: Some(format!("{pointer}{own}")),
            ..self
        }
    }
}

impl From<Violation> for FieldError {
    fn from(violation: Violation) -> Self {
        Self {
            pointer: Some(violation.pointer),
            parameter: None,
            value: violation.value,
            allowed: violation.allowed,
            unit: violation.unit,
            detail: violation.detail,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_list_is_cut_and_says_so() {
        let fault = |n: usize| FieldError::of_body(&format!("/{n}"), Value::from(n), "none");
        let mut all = FieldErrors::default();
        (0..LISTED + 7).for_each(|n| all.add(|| fault(n)));
        assert!(all.summary().starts_with("507 fields"));
        let list = all.into_list();
        assert_eq!(list.len(), LISTED + 1);
        assert_eq!(list[LISTED].detail, "7 further faults, not listed");
        let one = FieldErrors::from(fault(0));
        assert_eq!(one.summary(), "/0 is not allowed: none");
        assert_eq!(one.into_list().len(), 1);
    }
}
