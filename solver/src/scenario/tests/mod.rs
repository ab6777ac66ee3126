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
mod terrain;

use super::{Maps, Scenario, ScenarioError, Violation, excerpt};
use crate::raster::Raster;
use serde_json::{Value, json};
use std::sync::Arc;

/// The shortest legal scenario with a flow and a body.
fn minimal() -> Value {
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
        "flow": {"volume_m3": 0.01},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}]
    })
}

/// Name of the height map of the tests.
const HEIGHT_MAP: &str = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";

/// A plane height map of 40 m × 40 m, 0.2 steep towards the east, by this name.
fn maps() -> Maps {
    let values = (0..400).map(|n| 100.0 - 0.4 * f64::from(n % 20)).collect();
    let mut maps = Maps::default();
    let height = Raster {
        columns: 20,
        rows: 20,
        cell_size: 2.0,
        west: 600_000.0,
        south: 5_000_000.0,
        epsg: Some(32632),
        values,
    };
    maps.insert(HEIGHT_MAP, Arc::new(height));
    maps
}

/// The shortest legal scenario on a terrain with a flow and a body.
fn minimal_on_terrain() -> Value {
    json!({
        "terrain": {"height_map": HEIGHT_MAP},
        "flow": {"releases": [{
            "polygon_m": [[600_004, 5_000_004], [600_012, 5_000_004], [600_012, 5_000_020]],
            "thickness_m": 1
        }]},
        "bodies": [{"shape": {"cube": {"side_m": 1}},
                    "position": {"east_m": 600_020, "north_m": 5_000_015}}]
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
    match Scenario::from_value_with(scenario, &maps()) {
        Ok(scenario) => scenario,
        Err(error) => panic!("{error:?}\n{scenario}"),
    }
}

fn refused(scenario: &Value) -> Vec<Violation> {
    violations(Scenario::from_value_with(scenario, &maps()))
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
