//! The parser answers for any input.

use super::{minimal, with};
use crate::scenario::shape::REGULAR_SOLIDS;
use crate::scenario::{Scenario, ScenarioError};
use nalgebra::Vector3;
use proptest::prelude::*;
use serde_json::{Value, json};

fn any_json() -> impl Strategy<Value = Value> {
    let number = prop_oneof![
        any::<f64>().prop_map(|x| json!(x)),
        (-10.0..10.0_f64).prop_map(|x| json!(x)),
        any::<i64>().prop_map(|x| json!(x)),
        any::<u64>().prop_map(|x| json!(x)),
        Just(json!(0)),
    ];
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::Bool),
        number,
        ".{0,12}".prop_map(Value::String),
    ];
    leaf.prop_recursive(3, 24, 6, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..5).prop_map(Value::Array),
            prop::collection::btree_map("[a-z~/]{0,6}", inner, 0..5)
                .prop_map(|members| Value::Object(members.into_iter().collect())),
        ]
    })
}

/// Pointers to all values inside a value.
fn pointers(value: &Value, here: &str, found: &mut Vec<String>) {
    found.push(here.to_owned());
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                pointers(item, &format!("{here}/{index}"), found);
            }
        }
        Value::Object(members) => {
            for (key, member) in members {
                pointers(member, &format!("{here}/{key}"), found);
            }
        }
        _ => {}
    }
}

/// Every kind of shape, about 4 cm large.
fn shape() -> impl Strategy<Value = Value> {
    let length = || 0.01..0.05_f64;
    let solids = prop::sample::select(REGULAR_SOLIDS.map(|(name, _)| name).to_vec());
    let place = prop::array::uniform3(-0.02..0.02_f64);
    // A tetrahedron that always has a volume, and points round it.
    let places = prop::collection::vec(place, 0..12).prop_map(|mut places| {
        places.extend([[0.01; 3], [0.01, -0.01, -0.01]]);
        places.extend([[-0.01, 0.01, -0.01], [-0.01, -0.01, 0.01]]);
        places
    });
    prop_oneof![
        length().prop_map(|side| json!({"cube": {"side_m": side}})),
        prop::array::uniform3(length()).prop_map(|sides| json!({"box": {"sides_m": sides}})),
        (solids, length()).prop_map(|(solid, size)| json!({
            "regular": {"solid": solid, "size_m": 0.5 * size}
        })),
        places.prop_map(|places| json!({"polyhedron": {"vertices_m": places}})),
        length().prop_map(|radius| json!({"ball": {"radius_m": 0.5 * radius}})),
        (length(), 0.0..0.03_f64).prop_map(|(radius, more)| json!({
            "capsule": {"radius_m": 0.5 * radius, "length_m": 1.01 * radius + more}
        })),
    ]
}

/// The scenario with all fields and any shape, some of them replaced by anything.
fn damaged() -> impl Strategy<Value = Value> {
    let damage = prop::collection::vec((any::<prop::sample::Index>(), any_json()), 1..4);
    (shape(), damage).prop_map(|(shape, damage)| {
        let scenario = with("/bodies/0/shape", shape);
        let scenario = Scenario::from_value(&scenario).expect("the minimal scenario");
        let mut value = serde_json::to_value(scenario).expect("a scenario is JSON");
        for (place, replacement) in damage {
            let mut all = Vec::new();
            pointers(&value, "", &mut all);
            let target: &String = place.get(&all);
            if let Some(target) = value.pointer_mut(target) {
                *target = replacement;
            }
        }
        value
    })
}

/// Either a valid scenario, or violations with a text.
fn answers(result: Result<Scenario, ScenarioError>, document: &Value) -> Result<(), TestCaseError> {
    match result {
        Ok(scenario) => {
            for body in 0..scenario.bodies.len() {
                let pose = scenario.initial_pose(body);
                prop_assert!(pose.position.iter().all(|x| x.is_finite()));
            }
            let text = serde_json::to_string(&scenario).unwrap();
            prop_assert_eq!(Scenario::from_json(&text), Ok(scenario));
        }
        Err(ScenarioError::Invalid(violations)) => {
            prop_assert!(!violations.is_empty());
            for violation in violations {
                let there = document.pointer(&violation.pointer);
                if there.is_none() {
                    prop_assert_eq!(&violation.value, &Value::Null);
                }
                prop_assert!(!violation.allowed.is_empty() && violation.detail.ends_with('.'));
            }
        }
        Err(malformed) => prop_assert!(false, "JSON is well formed: {malformed}"),
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_json_is_answered(value in any_json()) {
        answers(Scenario::from_value(&value), &value)?;
        answers(Scenario::from_json(&value.to_string()), &value)?;
    }

    #[test]
    fn a_damaged_scenario_is_answered(value in damaged()) {
        answers(Scenario::from_value(&value), &value)?;
    }

    #[test]
    fn any_text_is_answered(text in ".{0,60}") {
        let _ = Scenario::from_json(&text);
    }

    #[test]
    fn any_shape_is_taken_and_comes_back(shape in shape(), yaw in -180.0..180.0_f64) {
        let mut value = with("/bodies/0/shape", shape);
        value["bodies"][0]["yaw_deg"] = json!(yaw);
        let scenario = Scenario::from_json(&value.to_string()).unwrap();
        prop_assert_eq!(Scenario::from_json(&scenario.to_json()).unwrap(), scenario.clone());
        // It lies on the floor, clear of the incline, and is rounded.
        let (pose, solid) = (scenario.initial_pose(0), scenario.shape_of(0));
        let down = pose.orientation.inverse_transform_vector(&-Vector3::z());
        prop_assert!((pose.position.z - solid.extent_along(&down)).abs() < 1e-15);
        prop_assert!(pose.position.x > solid.bounding_radius());
        let round = solid.faces().is_empty();
        let (width, diameter) = (solid.least_width(), 2.0 * solid.sphero_radius());
        let rounded_only = width == diameter;
        prop_assert!(width >= diameter && rounded_only == round);
    }

    #[test]
    fn numbers_come_back_with_the_same_bits(
        inclination in 0.0..89.0_f64,
        friction in 0.0..10.0_f64,
        volume in 0.0..0.03_f64,
        side in 0.001..0.1_f64,
        yaw in -180.0..180.0_f64,
        rolling in 0.0..10.0_f64,
    ) {
        let mut value = minimal();
        value["channel"]["inclination_deg"] = json!(inclination);
        value["channel"]["base_friction"] = json!(friction);
        value["flow"]["volume_m3"] = json!(volume.min(0.028));
        value["bodies"][0]["shape"]["cube"]["side_m"] = json!(side);
        value["bodies"][0]["yaw_deg"] = json!(yaw);
        value["bodies"][0]["rolling_friction"] = json!(rolling);
        let scenario = Scenario::from_json(&value.to_string()).unwrap();
        prop_assert_eq!(scenario.bodies[0].rolling_friction.to_bits(), rolling.to_bits());
        prop_assert_eq!(scenario.channel().unwrap().inclination_deg.to_bits(), inclination.to_bits());
        let text = serde_json::to_string_pretty(&scenario).unwrap();
        prop_assert_eq!(Scenario::from_json(&text).unwrap(), scenario);
    }
}
