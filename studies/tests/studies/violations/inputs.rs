//! Violations by inputs and their correlations.

use super::{assert_refused, violations};
use crate::support::{document, study};
use serde_json::{Value, json};

/// Asserts that a distribution of the second input gives one violation, below its place.
fn assert_distribution(distribution: Value, pointer: &str, message: &str) {
    let changes = [
        ("/inputs/1/distribution", distribution),
        ("/correlations", json!([])),
    ];
    assert_refused(
        &changes,
        &format!("/inputs/1/distribution{pointer}"),
        message,
    );
}

#[test]
fn distributions() {
    assert_distribution(
        json!({"lognormal": {"median": 0.008, "p95": 0.008}}),
        "/lognormal/p95",
        "p95 is 0.008, allowed: median < x, with median = 0.008",
    );
    assert_distribution(
        json!({"lognormal": {"median": 0.0, "p95": 1.0}}),
        "/lognormal/median",
        "median is 0, allowed: x > 0",
    );
    assert_distribution(
        json!({"uniform": {"from": 2.0, "to": 1.0}}),
        "/uniform/to",
        "to is 1, allowed: from < x, with from = 2",
    );
    assert_distribution(
        json!({"uniform": {"from": -1e308, "to": 1e308}}),
        "/uniform/to",
        &format!("to is {}, allowed: from < x, with from = -{}", 1e308, 1e308),
    );
    assert_distribution(
        json!({"normal": {"mean": 1.0, "sd": 0.0}}),
        "/normal/sd",
        "sd is 0, allowed: x > 0",
    );
    assert_distribution(
        json!({"normal": {"mean": 1.0, "sd": 0.1, "truncate": {"from": 1.0, "to": 1.0}}}),
        "/normal/truncate/to",
        "to is 1, allowed: from < x, with from = 1",
    );
    assert_distribution(
        json!({"normal": {"mean": 0.0, "sd": 1.0, "truncate": {"from": 6.0, "to": 7.0}}}),
        "/normal/truncate",
        "truncate keeps a probability of 9.9e-10 of the normal distribution, allowed: at least \
         1e-6",
    );
    assert_distribution(
        json!({"triangular": {"from": 0.0, "mode": 1.5, "to": 1.0}}),
        "/triangular/mode",
        "mode is 1.5, allowed: 0 <= x <= 1",
    );
    assert_distribution(
        json!({"choice": {"values": []}}),
        "/choice/values",
        "values is empty, allowed: at least one value",
    );
    assert_distribution(
        json!({"choice": {"values": [{"value": "a", "weight": 1}, {"value": "b", "weight": -1}]}}),
        "/choice/values/1/weight",
        "weight is -1, allowed: x > 0",
    );
    assert_distribution(
        json!({"list": {"values": []}}),
        "/list/values",
        "values is empty, allowed: at least one value",
    );
}

#[test]
fn numbers_that_only_a_program_can_give() {
    let mut study = study(&document());
    let nan = scree_studies::Uniform {
        from: f64::NAN,
        to: 1.0,
    };
    study.inputs[0].distribution = Some(scree_studies::Distribution::Uniform(nan));
    let infinite = scree_studies::Normal {
        mean: f64::INFINITY,
        sd: 1.0,
        truncate: None,
    };
    study.inputs[1].distribution = Some(scree_studies::Distribution::Normal(infinite));
    let found: Vec<String> = study
        .violations()
        .into_iter()
        .map(|one| one.pointer)
        .collect();
    let expected = [
        "/inputs/0/distribution/uniform/from",
        "/inputs/1/distribution/normal/mean",
    ];
    assert_eq!(found, expected);
}

#[test]
fn inputs() {
    assert_eq!(
        violations(&[("/inputs", json!([])), ("/correlations", json!([]))])[0],
        (
            "/inputs".to_owned(),
            "inputs is empty, allowed: at least one input".to_owned()
        )
    );
    let pointers = [
        ("bodies", "allowed: a path that begins with /"),
        ("", "allowed: a path that begins with /"),
        ("/a~2b", "allowed: ~ only as ~0 (for ~) and ~1 (for /)"),
        ("/a~", "allowed: ~ only as ~0 (for ~) and ~1 (for /)"),
    ];
    for (pointer, allowed) in pointers {
        let message = format!("pointer is {pointer:?}, {allowed}");
        assert_refused(
            &[("/inputs/2/pointer", json!(pointer))],
            "/inputs/2/pointer",
            &message,
        );
    }
    for pointer in [
        "/bodies/1/yaw_deg",
        "/bodies/1",
        "/bodies/-",
        "/bodies/00/yaw_deg",
        "/channel/base_friction/x",
        "/nothing/below",
    ] {
        let allowed = "allowed: a place in the scenario, or a new key of an object in it";
        let message = format!("pointer is {pointer:?}, {allowed}");
        assert_refused(
            &[("/inputs/2/pointer", json!(pointer))],
            "/inputs/2/pointer",
            &message,
        );
    }
    for pointer in ["/flow/volume_m3", "/flow"] {
        let message = format!(
            "pointer is {pointer:?}, allowed: a place that does not overlap that of input 1"
        );
        assert_refused(
            &[("/inputs/2/pointer", json!(pointer))],
            "/inputs/2/pointer",
            &message,
        );
    }
    assert_refused(
        &[("/inputs/2/distribution", Value::Null)],
        "/inputs/2/distribution",
        "distribution is missing, allowed: to leave it out in an explicit design",
    );
}

#[test]
fn correlations() {
    assert_refused(
        &[("/correlations/0/inputs", json!([0, 3]))],
        "/correlations/0/inputs/1",
        "inputs[1] is 3, allowed: an index below 3, the number of inputs",
    );
    assert_refused(
        &[("/correlations/0/inputs", json!([1, 1]))],
        "/correlations/0/inputs",
        "inputs is twice 1, allowed: two inputs",
    );
    assert_refused(
        &[("/correlations/0/rank", json!(-1.0))],
        "/correlations/0/rank",
        "rank is -1, allowed: -1 < x < 1",
    );
    assert_refused(
        &[(
            "/correlations",
            json!([{"inputs": [0, 1], "rank": 0.5}, {"inputs": [1, 0], "rank": 0.1}]),
        )],
        "/correlations/1/inputs",
        "inputs has the pair of correlation 0 again",
    );
    let contradiction = json!([
        {"inputs": [0, 1], "rank": 0.9},
        {"inputs": [1, 2], "rank": 0.9},
        {"inputs": [0, 2], "rank": -0.9}
    ]);
    assert_refused(
        &[("/correlations", contradiction)],
        "/correlations",
        "the correlations of the inputs 0 and 1, 0 and 2, 1 and 2 contradict each other: their \
         matrix isn't positive definite",
    );
    let shapes = json!({"choice": {"values": [{"value": "cube", "weight": 1}]}});
    assert_refused(
        &[("/inputs/1/distribution", shapes)],
        "/correlations/0/inputs/1",
        "inputs[1] is 1, a choice with values that aren't numbers, allowed: an input with numbers",
    );
}
