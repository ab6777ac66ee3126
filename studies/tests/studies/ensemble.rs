//! Members of a study: values and scenarios.

use crate::support::{document, study, z};
use scree_studies::{Ensemble, NoSuchMember, SMALLEST_PROBABILITY};
use serde_json::{Value, json};

#[test]
fn a_scenario_has_the_values_at_their_places_and_nothing_else_changed() {
    let study = study(&document());
    let ensemble = Ensemble::of(&study).unwrap();
    let values = ensemble.values(17).unwrap();
    let scenario = ensemble.scenario(17).unwrap();
    let expected = json!({
        "channel": {"base_friction": values[0]},
        "flow": {"volume_m3": values[1]},
        "bodies": [{"yaw_deg": values[2], "shape": "cube"}]
    });
    assert_eq!(scenario, expected);
    assert!((0.3..0.45).contains(&values[0].as_f64().unwrap()));
    assert_ne!(scenario, ensemble.scenario(18).unwrap());
    assert_eq!(
        scenario,
        Ensemble::of(&study).unwrap().scenario(17).unwrap()
    );
}

#[test]
fn there_is_no_member_beyond_the_last() {
    let study = study(&document());
    let ensemble = Ensemble::of(&study).unwrap();
    assert!(ensemble.values(255).is_ok());
    let beyond = NoSuchMember {
        index: 256,
        members: 256,
    };
    assert_eq!(ensemble.values(256), Err(beyond));
    assert_eq!(ensemble.scenario(256), Err(beyond));
}

#[test]
fn a_pointer_reaches_new_keys_escaped_keys_and_items_of_lists() {
    let study = study(&json!({
        "scenario": {"a/b": {"m~n": [10, 20, 30]}, "": {"x": 1}},
        "inputs": [
            {"pointer": "/a~1b/m~0n/2", "distribution": {"list": {"values": [7]}}},
            {"pointer": "/a~1b/new", "distribution": {"list": {"values": [8]}}},
            {"pointer": "//x", "distribution": {"list": {"values": [9]}}},
            {"pointer": "/~01", "distribution": {"list": {"values": [5]}}}
        ],
        "design": {"full_factorial": {"levels": 1}}
    }));
    let ensemble = Ensemble::of(&study).unwrap();
    let expected = json!({"a/b": {"m~n": [10, 20, 7], "new": 8}, "": {"x": 9}, "~1": 5});
    assert_eq!(ensemble.scenario(0).unwrap(), expected);
}

#[test]
fn end_scenarios_carry_each_end_with_the_others_at_their_medians() {
    let study = study(&document());
    let ensemble = Ensemble::of(&study).unwrap();
    let ends = ensemble.end_scenarios().collect::<Vec<_>>();
    let inputs: Vec<usize> = ends.iter().map(|end| end.input).collect();
    assert_eq!(inputs, [0, 0, 1, 1, 2, 2]);
    let median = json!({
        "channel": {"base_friction": 0.375},
        "flow": {"volume_m3": 0.008},
        "bodies": [{"yaw_deg": 45.0, "shape": "cube"}]
    });
    let pointers = [
        "/channel/base_friction",
        "/flow/volume_m3",
        "/bodies/0/yaw_deg",
    ];
    for end in &ends {
        let mut expected = median.clone();
        *expected.pointer_mut(pointers[end.input]).unwrap() = end.value.clone();
        assert_eq!(end.scenario, expected);
    }
    let values: Vec<f64> = ends.iter().map(|end| end.value.as_f64().unwrap()).collect();
    assert_eq!(
        [values[0], values[1], values[4], values[5]],
        [0.3, 0.45, 0.0, 90.0]
    );
    let sigma = 1.5_f64.ln() / z(0.95);
    let largest = 0.008 * (sigma * z(1.0 - SMALLEST_PROBABILITY)).exp();
    assert!((values[3] / largest - 1.0).abs() < 1e-7);
}

#[test]
fn no_member_lies_beyond_the_ends() {
    let mut given = document();
    given["design"]["sobol"]["members"] = json!(1 << 14);
    given["stop"] = Value::Null;
    let study = study(&given);
    let ensemble = Ensemble::of(&study).unwrap();
    let ends = ensemble.end_scenarios().collect::<Vec<_>>();
    for index in 0..ensemble.members() {
        for (input, value) in ensemble.values(index).unwrap().iter().enumerate() {
            let [low, high] = [0, 1].map(|end| ends[2 * input + end].value.as_f64().unwrap());
            assert!((low..=high).contains(&value.as_f64().unwrap()));
        }
    }
}

#[test]
fn end_scenarios_of_an_explicit_design_are_members() {
    let study = study(&json!({
        "scenario": {"a": 0, "b": 0},
        "inputs": [{"pointer": "/a"}, {"pointer": "/b"}],
        "design": {"explicit": {"members": [[2, "x"], [1, 5], [3, "y"], [2, "x"]]}}
    }));
    let ensemble = Ensemble::of(&study).unwrap();
    let ends = ensemble.end_scenarios().collect::<Vec<_>>();
    let found: Vec<(usize, Value)> = ends
        .iter()
        .map(|end| (end.input, end.scenario.clone()))
        .collect();
    let expected = [
        (0, json!({"a": 1, "b": 5})),
        (0, json!({"a": 3, "b": "y"})),
        (1, json!({"a": 1, "b": 5})),
        (1, json!({"a": 2, "b": "x"})),
        (1, json!({"a": 3, "b": "y"})),
    ];
    assert_eq!(found, expected);
}

#[test]
fn members_never_change() {
    // Written down once, to the bit; quantiles and the copula are in it.
    let mut given = document();
    given["inputs"][2]["distribution"] =
        json!({"normal": {"mean": 45.0, "sd": 20.0, "truncate": {"from": 0.0, "to": 90.0}}});
    let study = study(&given);
    let ensemble = Ensemble::of(&study).unwrap();
    let values = [3, 200].map(|index| json!(ensemble.values(index).unwrap()).to_string());
    let expected = [
        "[0.34051127135753634,0.01051526847300013,15.527451082471089]",
        "[0.3022409588098526,0.006711202808479165,34.24788159903983]",
    ];
    assert_eq!(values, expected);
}
