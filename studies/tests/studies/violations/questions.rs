//! Violations by questions.

use super::{assert_refused, violations};
use serde_json::{Value, json};

#[test]
fn questions() {
    assert_refused(
        &[("/questions/0/rest/regions/1", json!(1.0))],
        "/questions/0/rest/regions/1",
        "regions[1] is 1, allowed: 0 < x < 1",
    );
    assert_refused(
        &[("/questions/1/exceeds/thresholds", json!([]))],
        "/questions/1/exceeds/thresholds",
        "thresholds is empty, allowed: at least one number",
    );
    assert_refused(
        &[("/questions/1/exceeds/quantity", json!(""))],
        "/questions/1/exceeds/quantity",
        "quantity is empty, allowed: a name",
    );
    assert_refused(
        &[("/questions/2/buried/deeper_than_m", json!(-0.1))],
        "/questions/2/buried/deeper_than_m",
        "deeper_than_m is -0.1, allowed: x >= 0 [m]",
    );
    assert_refused(
        &[("/questions/3/quantiles/probabilities/0", json!(0.0))],
        "/questions/3/quantiles/probabilities/0",
        "probabilities[0] is 0, allowed: 0 < x < 1",
    );
    assert_refused(
        &[("/questions/3/quantiles/quantity", json!(""))],
        "/questions/3/quantiles/quantity",
        "quantity is empty, allowed: a name",
    );
    assert_refused(
        &[("/questions/4/sensitivity/quantity", json!(""))],
        "/questions/4/sensitivity/quantity",
        "quantity is empty, allowed: a name",
    );
}

#[test]
fn questions_that_a_design_cannot_answer() {
    let probability = "a probability needs a design of random members, not morris or one_at_a_time";
    let sensitivity = "sensitivity needs a saltelli, morris or random design, not one_at_a_time";
    let none = [("/stop", Value::Null), ("/correlations", json!([]))];
    for design in [
        json!({"morris": {"trajectories": 4, "levels": 4, "seed": 1}}),
        json!({"one_at_a_time": {"levels": 3}}),
    ] {
        let changes = [
            ("/design", design.clone()),
            none[0].clone(),
            none[1].clone(),
        ];
        let mut expected: Vec<(String, String)> =
            ["0/rest", "1/exceeds", "2/buried", "3/quantiles"]
                .map(|place| (format!("/questions/{place}"), probability.to_owned()))
                .to_vec();
        if design.get("one_at_a_time").is_some() {
            expected.push((
                "/questions/4/sensitivity".to_owned(),
                sensitivity.to_owned(),
            ));
        }
        assert_eq!(violations(&changes), expected);
    }
}
