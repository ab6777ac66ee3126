//! Tests of the scenario, and their fixtures.

mod agreement;
mod answers;
mod builder;
mod defaults;
#[cfg(feature = "schema")]
mod document;
mod fields;
mod motion;
mod placement;
mod random;

use super::{Scenario, ScenarioError, Violation, excerpt};
use serde_json::{Value, json};

/// The shortest legal scenario with a flow and a body.
fn minimal() -> Value {
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
        "flow": {"volume_m3": 0.01},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]
    })
}

/// The minimal scenario with one more value set at a JSON pointer; objects on the path are made
/// as needed.
fn with(pointer: &str, value: Value) -> Value {
    let mut scenario = minimal();
    set(&mut scenario, pointer, value);
    scenario
}

fn set(scenario: &mut Value, pointer: &str, value: Value) {
    let mut here = scenario;
    for token in pointer.split('/').skip(1) {
        here = match here {
            Value::Array(items) => {
                let index: usize = token.parse().expect("an index");
                if index >= items.len() {
                    items.resize(index + 1, Value::Null);
                }
                &mut items[index]
            }
            object => &mut object[token],
        };
    }
    *here = value;
}

fn accepted(scenario: &Value) -> Scenario {
    match Scenario::from_value(scenario) {
        Ok(scenario) => scenario,
        Err(error) => panic!("{error:?}\n{scenario}"),
    }
}

fn refused(scenario: &Value) -> Vec<Violation> {
    violations(Scenario::from_value(scenario))
}

fn violations(result: Result<Scenario, ScenarioError>) -> Vec<Violation> {
    match result {
        Err(ScenarioError::Invalid(violations)) => {
            assert!(!violations.is_empty());
            violations
        }
        other => panic!("expected violations, not {other:?}"),
    }
}

/// (name, JSON pointer to set, value, pointer reported, part of the allowed values)
type Case = (
    &'static str,
    &'static str,
    Value,
    &'static str,
    &'static str,
);

fn check(cases: &[Case]) {
    for (what, pointer, value, blamed, allowed) in cases {
        let found = refused(&with(pointer, value.clone()));
        let pointers: Vec<&str> = found.iter().map(|v| v.pointer.as_str()).collect();
        assert_eq!(pointers, [*blamed], "{what}: {found:#?}");
        let violation = &found[0];
        assert!(violation.allowed.contains(allowed), "{what}: {violation:?}");
        let key = blamed
            .rsplit('/')
            .find(|token| token.parse::<usize>().is_err())
            .unwrap();
        assert!(violation.detail.contains(key), "{what}: {violation:?}");
        assert!(violation.detail.ends_with('.'), "{what}: {violation:?}");
        if pointer == blamed {
            let told = value
                .as_str()
                .map_or(value.clone(), |text| excerpt(text).into());
            assert_eq!(violation.value, told, "{what}");
        }
    }
}
