//! Violations of the rules of a study.

mod designs;
mod inputs;
mod questions;

use crate::support::{document, study};
use scree_studies::Ensemble;
use serde_json::{Value, json};

/// Violations of the document with a value set at a pointer, as pointers and messages.
fn violations(changes: &[(&str, Value)]) -> Vec<(String, String)> {
    let mut given = document();
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match given.pointer_mut(parent).unwrap() {
            Value::Array(array) => array[key.parse::<usize>().unwrap()] = value.clone(),
            parent => parent[key] = value.clone(),
        }
    }
    let found = study(&given).violations();
    found
        .into_iter()
        .map(|one| (one.pointer, one.message))
        .collect()
}

/// Asserts that one change gives one violation.
fn assert_refused(changes: &[(&str, Value)], pointer: &str, message: &str) {
    let expected = (pointer.to_owned(), message.to_owned());
    assert_eq!(violations(changes), [expected], "after {changes:?}");
}

#[test]
fn the_document_is_valid() {
    assert_eq!(violations(&[]), []);
}

#[test]
fn stopping_rules() {
    assert_refused(
        &[("/stop/region", json!(0.8))],
        "/stop/region",
        "region is 0.8, allowed: a probability that a rest question has among its regions",
    );
    assert_refused(
        &[("/stop/area_changes_less_than", json!(0.0))],
        "/stop/area_changes_less_than",
        "area_changes_less_than is 0, allowed: 0 < x < 1",
    );
    assert_refused(
        &[("/stop/max_members", json!(255))],
        "/stop/max_members",
        "max_members is 255, allowed: x >= 256, the members of the design",
    );
    assert_refused(
        &[("/stop/budget_point_steps", json!(0.0))],
        "/stop/budget_point_steps",
        "budget_point_steps is 0, allowed: x > 0",
    );
    assert_refused(
        &[(
            "/design",
            json!({"latin_hypercube": {"members": 100, "seed": 1}}),
        )],
        "/stop",
        "a stopping rule needs a design that can be enlarged: sobol or saltelli",
    );
}

#[test]
fn all_violations_come_at_once_and_no_ensemble_has_any() {
    let mut given = document();
    given["inputs"][0]["pointer"] = json!("/nowhere/at/all");
    given["inputs"][1]["distribution"]["lognormal"]["p95"] = json!(0.001);
    given["design"]["sobol"]["members"] = json!(0);
    let study = study(&given);
    let found: Vec<String> = study
        .violations()
        .into_iter()
        .map(|one| one.pointer)
        .collect();
    let expected = [
        "/inputs/0/pointer",
        "/inputs/1/distribution/lognormal/p95",
        "/design/sobol/members",
    ];
    assert_eq!(found, expected);
    assert_eq!(Ensemble::of(&study).unwrap_err(), study.violations());
}

#[test]
fn what_is_too_large_is_told_before_anything_else_is_looked_at() {
    let input = |place: usize| {
        json!({"pointer": format!("/{place}"),
               "distribution": {"uniform": {"from": 0.0, "to": 1.0}}})
    };
    let mut given = document();
    given["inputs"] = (0..101).map(input).collect();
    let question = given["questions"][0].clone();
    given["questions"] = vec![question; 33].into();
    let pointers = |given: &Value| -> Vec<String> {
        let found = study(given).violations();
        found.into_iter().map(|one| one.pointer).collect()
    };
    assert_eq!(pointers(&given), ["/inputs", "/questions"]);

    let mut given = document();
    given["inputs"][0]["distribution"] = json!({"list": {"values": vec![0.3; 1_001]}});
    given["questions"][1]["exceeds"]["thresholds"] = json!(vec![0.1; 101]);
    let expected = [
        "/inputs/0/distribution/list/values",
        "/questions/1/exceeds/thresholds",
    ];
    assert_eq!(pointers(&given), expected);
}
