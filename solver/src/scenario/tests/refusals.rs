//! What is refused, where, and how it is put.

use super::{accepted, minimal, refused, set, violations, with};
use crate::scenario::{Scenario, ScenarioError};
use serde_json::{Value, json};

/// (what, JSON pointer to set, value, pointer blamed, part of what is allowed)
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
            assert_eq!(&violation.value, value, "{what}");
        }
    }
}

#[test]
fn single_fields() {
    check(&[
        (
            "unknown key",
            "/colour",
            json!("red"),
            "/colour",
            "one of: title, channel",
        ),
        (
            "unknown nested key",
            "/channel/lenght_m",
            json!(1),
            "/channel/lenght_m",
            "width_m",
        ),
        (
            "unknown in an optional part",
            "/numerics/gpu",
            json!(true),
            "/numerics/gpu",
            "threads",
        ),
        (
            "text for a number",
            "/gravity_m_s2",
            json!("9.81"),
            "/gravity_m_s2",
            "0.01 <= x",
        ),
        (
            "null for a number",
            "/duration_s",
            Value::Null,
            "/duration_s",
            "0 <= x <= 3600",
        ),
        (
            "number for a text",
            "/title",
            json!(7),
            "/title",
            "200 characters",
        ),
        (
            "title too long",
            "/title",
            json!("x".repeat(201)),
            "/title",
            "200 characters",
        ),
        (
            "number for an object",
            "/channel",
            json!(3),
            "/channel",
            "an object",
        ),
        (
            "null for an object",
            "/numerics",
            Value::Null,
            "/numerics",
            "an object",
        ),
        (
            "object for a list",
            "/bodies",
            json!({}),
            "/bodies",
            "a list",
        ),
        (
            "list item no object",
            "/bodies/0",
            json!(4),
            "/bodies/0",
            "an object",
        ),
        (
            "number for a truth value",
            "/bodies/0/fixed",
            json!(1),
            "/bodies/0/fixed",
            "true or false",
        ),
        (
            "below",
            "/channel/inclination_deg",
            json!(-1),
            "/channel/inclination_deg",
            "0 <= x <= 89",
        ),
        (
            "above",
            "/channel/inclination_deg",
            json!(90),
            "/channel/inclination_deg",
            "0 <= x <= 89",
        ),
        (
            "no width",
            "/channel/width_m",
            json!(0),
            "/channel/width_m",
            "0.001 <= x",
        ),
        (
            "negative volume",
            "/flow/volume_m3",
            json!(-0.01),
            "/flow/volume_m3",
            "0 <= x",
        ),
        (
            "negative friction",
            "/bodies/0/friction",
            json!(-0.1),
            "/bodies/0/friction",
            "0 <= x <= 10",
        ),
        (
            "restitution",
            "/bodies/0/restitution",
            json!(1.1),
            "/bodies/0/restitution",
            "0 <= x <= 1",
        ),
        (
            "incompressible",
            "/flow/material/poissons_ratio",
            json!(0.5),
            "/flow/material/poissons_ratio",
            "0.49",
        ),
        (
            "no courant",
            "/numerics/courant",
            json!(0),
            "/numerics/courant",
            "0 < x <= 0.9",
        ),
        (
            "half a point",
            "/numerics/points_per_cell",
            json!(7.5),
            "/numerics/points_per_cell",
            "whole",
        ),
        (
            "no thread",
            "/numerics/threads",
            json!(0),
            "/numerics/threads",
            "1 <= x",
        ),
        (
            "negative count",
            "/flow_snapshots",
            json!(-2),
            "/flow_snapshots",
            "0 <= x",
        ),
        (
            "short vector",
            "/bodies/0/velocity_m_s",
            json!([1, 2]),
            "/bodies/0/velocity_m_s",
            "a list of 3 numbers",
        ),
        (
            "vector of texts",
            "/bodies/0/velocity_m_s",
            json!([0, "a", 0]),
            "/bodies/0/velocity_m_s/1",
            "-1000 <= x",
        ),
        (
            "light is slower",
            "/bodies/0/velocity_m_s",
            json!([0, 0, 1e9]),
            "/bodies/0/velocity_m_s/2",
            "x <= 1000",
        ),
        (
            "zero quaternion",
            "/bodies/0/orientation",
            json!([0, 0, 0, 0]),
            "/bodies/0/orientation",
            "length 1",
        ),
        (
            "long quaternion",
            "/bodies/0/orientation",
            json!([1, 0, 0.1, 0]),
            "/bodies/0/orientation",
            "length 1",
        ),
        (
            "no shape",
            "/bodies/0/shape",
            json!({}),
            "/bodies/0/shape",
            "exactly one of: cube",
        ),
        (
            "two shapes",
            "/bodies/0/shape/sphere",
            json!({}),
            "/bodies/0/shape",
            "exactly one of: cube",
        ),
        (
            "unknown shape",
            "/bodies/0/shape",
            json!({"sphere": {}}),
            "/bodies/0/shape/sphere",
            "one of: cube",
        ),
        (
            "shape by name",
            "/bodies/0/shape",
            json!("cube"),
            "/bodies/0/shape",
            "an object",
        ),
        (
            "cube without side",
            "/bodies/0/shape/cube",
            json!({}),
            "/bodies/0/shape/cube/side_m",
            "0.0001 <= x",
        ),
    ]);
}

#[test]
fn rules_between_fields() {
    let cube_at = |x: f64, y: f64| json!({"downstream_m": x, "lateral_m": y});
    check(&[
        (
            "too much flow",
            "/flow/volume_m3",
            json!(1),
            "/flow/volume_m3",
            "0 <= x <= 0.0372",
        ),
        (
            "toe behind the back wall",
            "/flow/release/toe_distance_m",
            json!(1),
            "/flow/release/toe_distance_m",
            "x < 1",
        ),
        (
            "friction falling",
            "/flow/material/limiting_friction",
            json!(0.5),
            "/flow/material/limiting_friction",
            "x >= 0.6",
        ),
        (
            "friction above the default",
            "/flow/material/static_friction",
            json!(0.9),
            "/flow/material/limiting_friction",
            "x >= 0.9",
        ),
        (
            "bulk denser than grains",
            "/flow/material/bulk_density_kg_m3",
            json!(2700),
            "/flow/material/grain_density_kg_m3",
            "x >= 2700",
        ),
        (
            "radius of a ball",
            "/bodies/0/sphero_radius_m",
            json!(0.02),
            "/bodies/0/sphero_radius_m",
            "0 < x < 0.02",
        ),
        (
            "cells wider than the channel",
            "/numerics/cell_size_m",
            json!(0.3),
            "/numerics/cell_size_m",
            "x <= 0.2",
        ),
        (
            "through the side",
            "/bodies/0/position/lateral_m",
            json!(0.085),
            "/bodies/0/position/lateral_m",
            "-0.08 <= x <= 0.08",
        ),
        (
            "through the back",
            "/bodies/0/position/downstream_m",
            json!(-0.99),
            "/bodies/0/position/downstream_m",
            "<= x <=",
        ),
        (
            "out of the end",
            "/bodies/0/position",
            cube_at(1.99, 0.0),
            "/bodies/0/position/downstream_m",
            "-0.98 <= x <= 1.98",
        ),
        (
            "into the floor",
            "/bodies/0/position/elevation_m",
            json!(0.019),
            "/bodies/0/position/elevation_m",
            "x >= 0.02",
        ),
        (
            "astride the foot, on the floor",
            "/bodies/0/position",
            cube_at(0.0, 0.0),
            "/bodies/0/position/elevation_m",
            "x >= ",
        ),
        (
            "astride the foot, on the slope",
            "/bodies/0/position",
            cube_at(-0.001, 0.0),
            "/bodies/0/position/elevation_m",
            "x >= ",
        ),
        (
            "wider than the channel",
            "/bodies/0/shape/cube/side_m",
            json!(0.21),
            "/bodies/0/position/lateral_m",
            "nothing",
        ),
        (
            "body in body",
            "/bodies/1",
            json!({"shape": {"cube": {"side_m": 0.04}}, "yaw_deg": 10}),
            "/bodies/1/position",
            "clear of bodies[0]",
        ),
        (
            "a moving fixed body",
            "/bodies/0",
            json!({"shape": {"cube": {"side_m": 0.04}}, "fixed": true, "velocity_m_s": [1, 0, 0]}),
            "/bodies/0/velocity_m_s",
            "[0, 0, 0]",
        ),
        (
            "turned twice",
            "/bodies/0",
            json!({"shape": {"cube": {"side_m": 0.04}}, "yaw_deg": 10, "orientation": [1, 0, 0, 0]}),
            "/bodies/0/yaw_deg",
            "orientation",
        ),
    ]);
}

#[test]
fn one_stiffness_is_enough() {
    let mut scenario = with("/numerics/sound_speed_m_s", json!(20));
    set(
        &mut scenario,
        "/flow/material/youngs_modulus_pa",
        json!(1e6),
    );
    let found = refused(&scenario);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].pointer, "/numerics/sound_speed_m_s");
    assert_eq!(found[0].value, json!(20));
    assert!(found[0].detail.contains("youngs_modulus_pa"));
}

#[test]
fn trajectories_are_bounded() {
    let mut scenario = with("/duration_s", json!(60));
    set(&mut scenario, "/sample_interval_s", json!(0.0001));
    let found = refused(&scenario);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].pointer, "/sample_interval_s");
    // 60 s in 500,000 samples.
    assert_eq!(found[0].allowed, "x >= 0.00012");
    set(&mut scenario, "/sample_interval_s", json!(0.00012));
    accepted(&scenario);
}

#[test]
fn keys_are_escaped_in_pointers() {
    let found = refused(&with("/bodies/0/a~b", json!(1)));
    assert_eq!(found[0].pointer, "/bodies/0/a~0b");
    assert_eq!(found[0].value, json!(1));
    assert_eq!(found[0].detail, "bodies[0].a~b is not a known field.");
}

#[test]
fn required_fields() {
    let required = [
        "/channel",
        "/channel/inclination_deg",
        "/channel/incline_length_m",
        "/channel/runout_length_m",
        "/flow",
        "/flow/volume_m3",
        "/bodies",
        "/bodies/0/shape",
    ];
    for pointer in required {
        let mut scenario = minimal();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        scenario
            .pointer_mut(parent)
            .unwrap()
            .as_object_mut()
            .unwrap()
            .remove(key);
        let found = refused(&scenario);
        assert_eq!(found.len(), 1, "{found:#?}");
        assert_eq!(
            (found[0].pointer.as_str(), &found[0].value),
            (pointer, &Value::Null)
        );
        assert!(found[0].detail.contains("missing"));
    }
    assert_eq!(refused(&json!({})).len(), 3);
    assert_eq!(refused(&json!([]))[0].pointer, "");
}

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
fn geometry_is_judged_even_when_something_else_is_wrong() {
    let mut scenario = with("/gravity_m_s2", json!("heavy"));
    set(&mut scenario, "/bodies/0/position/lateral_m", json!(1));
    set(&mut scenario, "/flow/volume_m3", json!(1));
    assert_eq!(refused(&scenario).len(), 3);
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

    let found = refused(&with("/title", json!(vec![1; 20_001])));
    assert_eq!((found.len(), found[0].pointer.as_str()), (1, ""));
}
