//! Wording of refusals.

use super::{accepted, minimal, refused, set, violations, with};
use crate::scenario::{Scenario, ScenarioError};
use serde_json::{Value, json};

#[test]
fn all_at_once_in_document_order() {
    let text = r#"{
        "bodies": [{"friction": -1, "shape": {"cube": {"side_m": 0.04}}, "position": {"lateral_m": 0.5}},
                   {"shape": {"ball": 1}, "fixed": "no"}, {}],
        "gravity_m_s2": 0, "speed": 3,
        "channel": {"width_m": "wide", "inclination_deg": 95, "incline_length_m": 1, "width_m": 2},
        "flow": {"material": {"static_friction": 2}, "volume_m3": 1}
    }"#;
    let found = violations(Scenario::from_json(text));
    let pointers: Vec<&str> = found.iter().map(|v| v.pointer.as_str()).collect();
    assert_eq!(
        pointers,
        [
            "/bodies/0/friction",
            "/bodies/1/shape/ball",
            "/bodies/1/fixed",
            "/bodies/2/shape",
            "/gravity_m_s2",
            "/speed",
            "/channel/width_m",
            "/channel/width_m",
            "/channel/inclination_deg",
            "/channel/runout_length_m",
            "/flow/material/limiting_friction",
        ]
    );
    let inclination = &found[8];
    assert_eq!(inclination.value, json!(95));
    assert_eq!(inclination.allowed, "0 <= x <= 89");
    assert_eq!(inclination.unit.as_deref(), Some("°"));
    assert_eq!(
        inclination.detail,
        "channel.inclination_deg is 95, outside 0 <= x <= 89."
    );
}

#[test]
fn a_wrong_word_is_named_with_the_right_ones() {
    let found = refused(&with("/numerics/precision", json!("half")));
    assert_eq!(found[0].value, json!("half"));
    assert_eq!(found[0].allowed, r#""single" or "double""#);
    assert_eq!(found[0].unit, None);
    assert_eq!(
        found[0].detail,
        r#"numerics.precision is "half", not "single" or "double"."#
    );
    let found = refused(&with("/numerics/precision", json!(32)));
    assert_eq!(
        found[0].detail,
        r#"numerics.precision must be "single" or "double"."#
    );
}

#[test]
fn geometry_is_judged_even_when_something_else_is_wrong() {
    let mut scenario = with("/gravity_m_s2", json!("heavy"));
    set(&mut scenario, "/bodies/0/position/lateral_m", json!(1));
    set(&mut scenario, "/flow/volume_m3", json!(1));
    assert_eq!(refused(&scenario).len(), 3);
}

#[test]
fn keys_are_escaped_in_pointers() {
    let found = refused(&with("/bodies/0/a~b", json!(1)));
    assert_eq!(found[0].pointer, "/bodies/0/a~0b");
    assert_eq!(found[0].value, json!(1));
    assert_eq!(found[0].detail, "bodies[0].a~b is not a known field.");
}

#[test]
fn repeated_keys() {
    let text = minimal()
        .to_string()
        .replacen("{", r#"{"duration_s": 1, "duration_s": 2, "#, 1);
    let found = violations(Scenario::from_json(&text));
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].pointer, "/duration_s");
    assert!(found[0].detail.contains("more than once"));
}

#[test]
fn texts_that_are_no_json() {
    for text in [
        "",
        "{",
        "{\"title\": }",
        "not json",
        "{} {}",
        "{\"gravity_m_s2\": NaN}",
        "{\"gravity_m_s2\": 1e999}",
    ] {
        assert!(
            matches!(
                Scenario::from_json(text),
                Err(ScenarioError::Malformed { .. })
            ),
            "{text}"
        );
    }
    let deep = "[".repeat(100_000);
    assert!(matches!(
        Scenario::from_json(&deep),
        Err(ScenarioError::Malformed { .. })
    ));
    let Err(ScenarioError::Malformed {
        message,
        line,
        column,
    }) = Scenario::from_json("{\n  x")
    else {
        panic!("that is no JSON");
    };
    assert_eq!(
        (message.as_str(), line, column),
        ("key must be a string", 2, 3)
    );
}

#[test]
fn answers_stay_small() {
    let many = Value::Array(vec![minimal()["bodies"][0].clone(); 257]);
    let found = refused(&with("/bodies", many));
    assert_eq!((found.len(), found[0].pointer.as_str()), (1, "/bodies"));
    assert!(found[0].value.to_string().len() < 100);

    let mut scenario = minimal();
    for key in 0..1000 {
        scenario[format!("key{key}")] = json!(1);
    }
    let found = refused(&scenario);
    assert_eq!(found.len(), 501);
    assert!(found[500].detail.contains("500 further"));

    let found = refused(&with("/numerics/precision", json!("x".repeat(100_000))));
    assert!(found[0].detail.chars().count() < 200);
    let start = format!("{}… (100000 characters)", "x".repeat(80));
    assert_eq!(found[0].value, start.as_str());

    let found = refused(&with(&format!("/{}", "k".repeat(5_000)), json!(1)));
    assert!(found[0].detail.chars().count() < 200);
    let found = refused(&with("/title", json!(["x".repeat(5_000)])));
    assert!(found[0].value.to_string().len() < 200);

    let found = refused(&with("/title", json!(vec![1; 80_001])));
    assert_eq!((found.len(), found[0].pointer.as_str()), (1, ""));
}

#[test]
fn a_document_of_unknown_keys_is_answered_at_once() {
    let mut scenario = minimal();
    for key in 0..79_000 {
        scenario[format!("key{key}")] = json!(1);
    }
    let start = std::time::Instant::now();
    let found = refused(&scenario);
    assert!(found[500].detail.contains("78500 further"));
    // Pairs of keys compared would take 5 s.
    assert!(start.elapsed().as_secs_f64() < 2.0);
}

#[test]
fn the_most_bodies_of_the_most_points_are_legal() {
    // Points on a unit ball, along a spiral that every body begins elsewhere.
    let place = |body: usize, k: usize| {
        let z = (2 * k + 1) as f64 / 32.0 - 1.0;
        let angle = 2.4 * k as f64 + body as f64;
        let radius = (1.0 - z * z).sqrt();
        [radius * angle.cos(), radius * angle.sin(), z].map(|c| (c * 1e4).round() / 1e4)
    };
    let body = |body: usize| {
        let points: Vec<_> = (0..32).map(|k| place(body, k)).collect();
        json!({
            "shape": {"polyhedron": {"vertices_m": points}},
            "position": {"downstream_m": 11 + 3 * (body / 16), "lateral_m": 3 * (body % 16)},
        })
    };
    let scenario = json!({
        "channel": {
            "inclination_deg": 40, "incline_length_m": 10, "runout_length_m": 200, "width_m": 110,
        },
        "flow": null,
        "bodies": (0..256).map(body).collect::<Vec<_>>(),
        "duration_s": 0.01,
    });
    assert_eq!(accepted(&scenario).bodies.len(), 256);
}
