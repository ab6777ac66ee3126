//! A scenario from a file or from standard input.

use super::failure::Failure;
use super::scenario_maps;
use scree_solver::scenario::{Scenario, ScenarioError, Violation};
use std::fmt::Write as _;
use std::io::Read;
use std::path::Path;

/// Longest value shown in a list of violations.
const VALUE_CHARS: usize = 60;

/// Reads a scenario; `-` is standard input.
///
/// # Errors
/// An unreadable file, text that is not JSON, or a scenario that breaks rules; the message
/// lists all of them.
pub(super) fn read(path: &Path) -> Result<Scenario, Failure> {
    parse(&read_text(path)?, &name(path))
}

/// Text of the scenario file, whose maps have absolute paths.
///
/// # Errors
/// An unreadable file, or one that is not UTF-8.
pub(super) fn read_text(path: &Path) -> Result<String, Failure> {
    let mut text = String::new();
    let read = if path == Path::new("-") {
        std::io::stdin().read_to_string(&mut text).map(|_| ())
    } else {
        std::fs::read_to_string(path).map(|read| text = read)
    };
    read.map_err(|error| Failure::path("read", Path::new(&name(path)), &error))?;
    Ok(scenario_maps::with_absolute_paths(text, path))
}

/// A scenario from its text; `name` stands for the file in messages.
///
/// # Errors
/// As for [`read`].
pub(super) fn parse(text: &str, name: &str) -> Result<Scenario, Failure> {
    scenario_maps::read(text)?.map_err(|error| Failure::Input(explain(&error, name)))
}

/// Name of the file in messages.
pub(super) fn name(path: &Path) -> String {
    if path == Path::new("-") {
        return "standard input".to_owned();
    }
    path.display().to_string()
}

/// Message about the faults of a scenario, for people.
fn explain(error: &ScenarioError, name: &str) -> String {
    match error {
        ScenarioError::Malformed { .. } => format!("{name} is {error}"),
        ScenarioError::Invalid(violations) => broken_rules(violations, name),
    }
}

/// Message about the rules that the file of this name breaks, for people.
pub(super) fn broken_rules(violations: &[Violation], name: &str) -> String {
    let rules = if violations.len() == 1 {
        "rule"
    } else {
        "rules"
    };
    let mut text = format!("{name} breaks {} {rules}:", violations.len());
    for violation in violations {
        text.push_str("\n\n");
        text.push_str(&describe(violation));
    }
    text
}

fn describe(violation: &Violation) -> String {
    let pointer = match violation.pointer.as_str() {
        "" => "(the whole document)",
        pointer => pointer,
    };
    let unit = violation
        .unit
        .as_ref()
        .map_or(String::new(), |unit| format!(" [{unit}]"));
    let mut text = format!("  {pointer}\n");
    let _ = writeln!(text, "    {}", violation.detail);
    let _ = writeln!(
        text,
        "    value:   {}",
        shortened(&violation.value.to_string())
    );
    let _ = write!(text, "    allowed: {}{unit}", violation.allowed);
    text
}

fn shortened(value: &str) -> String {
    if value.chars().count() <= VALUE_CHARS {
        return value.to_owned();
    }
    let head: String = value.chars().take(VALUE_CHARS - 1).collect();
    format!("{head}…")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn violation(pointer: &str, unit: Option<&str>) -> Violation {
        Violation {
            pointer: pointer.to_owned(),
            value: json!(95.0),
            allowed: "0 <= x <= 89".to_owned(),
            unit: unit.map(str::to_owned),
            detail: "the incline is too steep".to_owned(),
        }
    }

    #[test]
    fn every_violation_is_told_with_pointer_value_range_and_unit() {
        let first = violation("/channel/inclination_deg", Some("°"));
        let error = ScenarioError::Invalid(vec![first, violation("", None)]);
        let text = explain(&error, "steep.json");
        let expected = "steep.json breaks 2 rules:

  /channel/inclination_deg
    the incline is too steep
    value:   95.0
    allowed: 0 <= x <= 89 [°]

  (the whole document)
    the incline is too steep
    value:   95.0
    allowed: 0 <= x <= 89";
        assert_eq!(text, expected);
    }

    #[test]
    fn a_long_value_is_cut() {
        let mut long = violation("/title", None);
        long.value = json!("x".repeat(500));
        let text = describe(&long);
        assert!(text.lines().all(|line| line.chars().count() < 80), "{text}");
    }
}
