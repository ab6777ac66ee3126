//! Inconsistent fields.

use super::{accepted, check, refused, set, with};
use serde_json::json;

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
fn what_accuracy_asks_for_has_to_make_sense() {
    let goal = |quantity: &str| json!({"target": 0.05, "quantity": quantity});
    check(&[
        (
            "a target of nothing",
            "/accuracy",
            json!({"target": 0.05}),
            "/accuracy/quantity",
            "\"onset_time_s\" or",
        ),
        (
            "a quantity without a target",
            "/accuracy",
            json!({"quantity": "front_m"}),
            "/accuracy/quantity",
            "null without accuracy.target",
        ),
        (
            "a target beyond a body's reach",
            "/accuracy",
            json!({"target": 0.0, "quantity": "front_m"}),
            "/accuracy/target",
            "0.001 <= x <= 1",
        ),
        (
            "the second of one body",
            "/accuracy",
            json!({"target": 0.05, "quantity": "stop_time_s", "body": 1}),
            "/accuracy/body",
            "0 <= x <= 0, whole",
        ),
        (
            "the fourth of one body, about nothing",
            "/accuracy/body",
            json!(3),
            "/accuracy/body",
            "0 <= x <= 0, whole",
        ),
        (
            "bars of a word",
            "/accuracy/error_bars",
            json!("yes"),
            "/accuracy/error_bars",
            "true or false",
        ),
    ]);
    let mut scenario = with("/accuracy", goal("displacement_m"));
    set(&mut scenario, "/numerics/cell_size_m", json!(0.01));
    assert_eq!(refused(&scenario)[0].pointer, "/numerics/cell_size_m");
    let mut scenario = with("/accuracy", goal("displacement_m"));
    set(&mut scenario, "/bodies", json!([]));
    assert_eq!(refused(&scenario)[0].pointer, "/accuracy/body");
    set(&mut scenario, "/accuracy/quantity", json!("front_m"));
    accepted(&scenario);
    set(&mut scenario, "/accuracy/body", json!(1));
    assert_eq!(refused(&scenario)[0].pointer, "/accuracy/body");
}

#[test]
fn bands_need_a_flow() {
    for (accuracy, blamed) in [
        (json!({"error_bars": true}), "/accuracy/error_bars"),
        (
            json!({"target": 0.05, "quantity": "displacement_m"}),
            "/accuracy/target",
        ),
    ] {
        for flow in [json!(null), json!({"volume_m3": 0})] {
            let mut scenario = with("/accuracy", accuracy.clone());
            set(&mut scenario, "/flow", flow);
            let found = refused(&scenario);
            assert_eq!((found.len(), found[0].pointer.as_str()), (1, blamed));
        }
    }
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

// At the least sound speed, √(2 g H), the weight compresses the volume by a third.
#[test]
fn a_release_carries_itself() {
    let least = (2.0 * 9.81 * 0.15f64).sqrt();
    let found = refused(&with("/numerics/sound_speed_m_s", json!(0.99 * least)));
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].pointer, "/numerics/sound_speed_m_s");
    assert_eq!(found[0].allowed, "x >= 1.71552, or null");
    assert!(
        found[0].detail.contains("own weight"),
        "{}",
        found[0].detail
    );
    accepted(&with("/numerics/sound_speed_m_s", json!(1.71552)));
    // E = 3 (1 − 2ν) ρ c² at ν = 0.3.
    let modulus = 1.2 * 1500.0 * least.powi(2);
    let pointer = "/flow/material/youngs_modulus_pa";
    assert_eq!(
        refused(&with(pointer, json!(0.99 * modulus)))[0].pointer,
        pointer
    );
    accepted(&with(pointer, json!(1.01 * modulus)));
}

// A cube of 40 mm weighs 0.127 kg: at rest on one vertex it sinks in by half its sphero
// radius of 2 mm at E* = ¾ m g/(1 mm)^1.5/√(2 mm) = 0.66 MPa.
#[test]
fn a_contact_that_is_given_carries_its_body() {
    let pointer = "/bodies/0/contact_modulus_pa";
    let found = refused(&with(pointer, json!(6e5)));
    assert_eq!((found.len(), found[0].pointer.as_str()), (1, pointer));
    assert!(
        found[0].allowed.starts_with("x >= 6617"),
        "{}",
        found[0].allowed
    );
    accepted(&with(pointer, json!(7e5)));
    for (field, value) in [
        ("velocity_m_s", json!([0, 0, -5])),
        ("angular_velocity_rad_s", json!([150, 0, 0])),
        ("position", json!({"downstream_m": 0.1, "elevation_m": 1.2})),
    ] {
        let mut scenario = with(pointer, json!(7e5));
        set(&mut scenario, &format!("/bodies/0/{field}"), value);
        assert_eq!(refused(&scenario)[0].pointer, pointer);
    }
    let mut barrier = with(pointer, json!(6e5));
    set(&mut barrier, "/bodies/0/fixed", json!(true));
    accepted(&barrier);
}
