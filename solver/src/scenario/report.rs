//! Report that collects violations.

use super::Violation;
use super::node::{Node, excerpt, unescaped};
use super::places::Places;
use super::rules::VIOLATIONS;
use serde_json::Value;
use std::cell::RefCell;

/// Collects violations.
#[derive(Debug, Default)]
pub(super) struct Report {
    violations: RefCell<Vec<Violation>>,
}

impl Report {
    /// Adds a violation; `why` continues the field's name.
    pub(super) fn refuse(&self, pointer: &str, allowed: &str, unit: Option<&str>, why: &str) {
        self.violations.borrow_mut().push(Violation {
            pointer: pointer.to_owned(),
            value: Value::Null,
            allowed: allowed.to_owned(),
            unit: unit.map(str::to_owned),
            detail: format!("{} {why}.", field_name(pointer)),
        });
    }

    /// True if there is none.
    pub(super) fn is_empty(&self) -> bool {
        self.violations.borrow().is_empty()
    }

    /// All violations in the order of the document, each with the value at its pointer. A list too
    /// long to be of use is cut, and says so.
    pub(super) fn into_violations(self, document: &Node) -> Vec<Violation> {
        let mut violations = self.violations.into_inner();
        let mut places = Places::of(document);
        violations.sort_by_cached_key(|violation| places.find(&violation.pointer).0);
        let further = violations.len().saturating_sub(VIOLATIONS);
        violations.truncate(VIOLATIONS);
        for violation in &mut violations {
            let found = places.find(&violation.pointer).1;
            violation.value = found.map_or(Value::Null, Node::excerpt);
        }
        if further > 0 {
            violations.push(Violation {
                pointer: String::new(),
                value: Value::Null,
                allowed: "a scenario as in docs/scenario.md".to_owned(),
                unit: None,
                detail: format!("the scenario has {further} further violations, not listed."),
            });
        }
        violations
    }
}

/// "/bodies/0/yaw_deg" as people write it: "bodies[0].yaw_deg".
pub(super) fn field_name(pointer: &str) -> String {
    let mut name = String::new();
    for token in pointer.split('/').skip(1) {
        let token = excerpt(&unescaped(token));
        if token.parse::<usize>().is_ok() {
            name.push_str(&format!("[{token}]"));
        } else {
            let dot = if name.is_empty() { "" } else { "." };
            name.push_str(&format!("{dot}{token}"));
        }
    }
    if name.is_empty() {
        "the scenario".to_owned()
    } else {
        name
    }
}
