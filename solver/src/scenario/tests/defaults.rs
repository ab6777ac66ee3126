//! Defaults, and legal values at the limits.

use super::{accepted, minimal, set, with};
use crate::scenario::accuracy::QUANTITIES;
use crate::scenario::{Precision, Scenario};
use serde_json::{Value, json};

#[test]
fn the_minimal_scenario_has_the_documented_defaults() {
    // Typed from the contract, not from the code.
    let expected = json!({
        "title": "",
        "channel": {"inclination_deg": 40.0, "incline_length_m": 1.0, "runout_length_m": 2.0,
                    "width_m": 0.2, "base_friction": 0.4, "side_friction": 0.0},
        "flow": {"volume_m3": 0.01,
                 "release": {"height_m": 0.15, "toe_distance_m": 0.05},
                 "material": {"bulk_density_kg_m3": 1500.0, "grain_density_kg_m3": 2600.0, "grain_diameter_m": 0.001,
                              "static_friction": 0.6, "limiting_friction": 0.86, "reference_inertial_number": 0.279,
                              "poissons_ratio": 0.3, "youngs_modulus_pa": null}},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}, "sphero_radius_m": 0.002, "density_kg_m3": 2000.0,
                    "position": {"downstream_m": 0.04, "lateral_m": 0.0, "elevation_m": null},
                    "yaw_deg": 0.0, "orientation": null, "velocity_m_s": [0.0, 0.0, 0.0],
                    "angular_velocity_rad_s": [0.0, 0.0, 0.0],
                    "friction": 0.4, "restitution": 0.3, "rolling_friction": 0.0,
                    "flow_friction": 0.4, "flow_restitution": 0.0,
                    "contact_modulus_pa": null, "fixed": false, "motion": null}],
        "gravity_m_s2": 9.81, "duration_s": 2.3, "sample_interval_s": 0.01, "flow_snapshots": 61,
        "flow_snapshot_points": 5000,
        "numerics": {"cell_size_m": null, "points_per_cell": 8, "sound_speed_m_s": null,
                     "courant": null, "flow_courant": null, "precision": "single",
                     "symmetry": "auto", "approach": "auto", "coupling": "half_spacing",
                     "ending": "auto", "threads": null},
        "accuracy": {"error_bars": false, "target": null, "quantity": null, "body": 0,
                     "budget_point_steps": 2e10}
    });
    let filled = serde_json::to_value(accepted(&minimal())).unwrap();
    assert_eq!(filled, expected);
}

// Of 10,000 m³ on 30°, 74 m up: 9.4 s down, 5.3 s to stop, 1.4 s at rest, and as much again.
#[test]
fn a_large_flow_lasts_as_long_as_it_takes() {
    let mut scenario = json!({
        "channel": {"inclination_deg": 30, "incline_length_m": 106.6, "runout_length_m": 150,
                    "width_m": 20, "base_friction": 0.35},
        "flow": {"volume_m3": 10000, "release": {"height_m": 8, "toe_distance_m": 20}},
        "bodies": []
    });
    assert_eq!(accepted(&scenario).duration_s, 33.0);
    // It leaves before it stops.
    set(&mut scenario, "/channel/runout_length_m", json!(20));
    assert_eq!(accepted(&scenario).duration_s, 24.0);
    set(&mut scenario, "/duration_s", json!(2.5));
    assert_eq!(accepted(&scenario).duration_s, 2.5);
    set(&mut scenario, "/flow", json!(null));
    set(&mut scenario, "/duration_s", json!(null));
    assert!(
        Scenario::from_value(&scenario).is_err(),
        "null is no number"
    );
}

#[test]
fn the_filled_scenario_reads_back_equal() {
    let scenario = accepted(&minimal());
    let text = serde_json::to_string(&scenario).unwrap();
    assert_eq!(Scenario::from_json(&text), Ok(scenario));
}

#[test]
fn precision_is_read_and_written_by_its_word() {
    for (word, precision) in [("single", Precision::Single), ("double", Precision::Double)] {
        let scenario = accepted(&with("/numerics/precision", json!(word)));
        assert_eq!(scenario.numerics.precision, precision);
        let text = scenario.to_json();
        assert!(text.contains(&format!(r#""precision":"{word}""#)), "{text}");
        assert_eq!(Scenario::from_json(&text), Ok(scenario));
    }
    let unsaid = accepted(&minimal()).numerics.precision;
    assert_eq!(unsaid, Precision::Single);
}

#[test]
fn quantities_are_read_and_written_by_their_keys() {
    for (word, quantity) in QUANTITIES {
        let accuracy = json!({"target": 0.05, "quantity": word});
        let scenario = accepted(&with("/accuracy", accuracy));
        assert_eq!(scenario.accuracy.goal(), Some((0.05, quantity)));
        assert_eq!(quantity.key(), word);
        let text = scenario.to_json();
        assert!(text.contains(&format!(r#""quantity":"{word}""#)), "{text}");
        assert_eq!(Scenario::from_json(&text), Ok(scenario));
    }
}

#[test]
fn defaults_follow_the_size_of_the_body() {
    let scenario = accepted(&with("/bodies/0/shape/cube/side_m", json!(0.1)));
    assert_eq!(scenario.bodies[0].sphero_radius_m, 0.005);
    assert_eq!(scenario.bodies[0].position.place.coordinates()[0], 0.1);
}

#[test]
fn defaults_of_every_shape_follow_its_size() {
    let tetrahedron = [[0., 0., 0.], [0.03, 0., 0.], [0., 0.03, 0.], [0., 0., 0.03]];
    // Inradius of a corner of a cube of side a: a/(3 + √3).
    let of_corner = 0.03 / (3.0 + 3_f64.sqrt()) / 10.0;
    for (shape, radius, downstream) in [
        (json!({"box": {"sides_m": [0.02, 0.06, 0.04]}}), 0.001, 0.06),
        (
            json!({"regular": {"solid": "cube", "size_m": 0.04}}),
            0.002,
            0.04 * 3_f64.sqrt(),
        ),
        (
            json!({"regular": {"solid": "tetrahedron", "size_m": 0.04}}),
            0.04 * 6_f64.sqrt() / 120.0,
            0.04,
        ),
        (
            json!({"polyhedron": {"vertices_m": tetrahedron}}),
            of_corner,
            0.03 * 2_f64.sqrt(),
        ),
        (json!({"ball": {"radius_m": 0.02}}), 0.02, 0.04),
        (
            json!({"capsule": {"radius_m": 0.01, "length_m": 0.05}}),
            0.01,
            0.05,
        ),
    ] {
        let scenario = accepted(&with("/bodies/0/shape", shape));
        let body = &scenario.bodies[0];
        assert!((body.sphero_radius_m - radius).abs() < 1e-15, "{body:?}");
        assert!(
            (body.position.place.coordinates()[0] - downstream).abs() < 1e-15,
            "{body:?}"
        );
    }
}

#[test]
fn hard_cases_are_legal() {
    let edges: &[(&str, Value)] = &[
        ("/flow", Value::Null),
        ("/bodies", json!([])),
        ("/flow/volume_m3", json!(0)),
        ("/duration_s", json!(0)),
        ("/channel/inclination_deg", json!(0)),
        ("/channel/inclination_deg", json!(89)),
        ("/channel/base_friction", json!(5)),
        ("/channel/side_friction", json!(5)),
        ("/bodies/0/friction", json!(0)),
        ("/bodies/0/friction", json!(5)),
        ("/bodies/0/restitution", json!(1)),
        ("/bodies/0/rolling_friction", json!(10)),
        ("/bodies/0/flow_restitution", json!(1)),
        ("/bodies/0/density_kg_m3", json!(75)),
        ("/bodies/0/density_kg_m3", json!(75_000)),
        ("/bodies/0/velocity_m_s", json!([-20, 0, 0])),
        ("/bodies/0/fixed", json!(true)),
        ("/flow/material/youngs_modulus_pa", json!(1e4)),
        ("/flow/material/youngs_modulus_pa", json!(1e9)),
        ("/flow/material/grain_diameter_m", json!(1e-9)),
        ("/flow/material/reference_inertial_number", json!(1e-9)),
        ("/flow/material/limiting_friction", json!(0.6)),
        ("/flow/material/poissons_ratio", json!(0)),
        ("/numerics/cell_size_m", json!(0.16)),
        ("/numerics/cell_size_m", json!(0.00125)),
        ("/numerics/points_per_cell", json!(1)),
        ("/numerics/precision", json!("single")),
        ("/numerics/precision", json!("double")),
        ("/numerics/threads", json!(3)),
        ("/numerics/flow_courant", json!(1)),
        (
            "/accuracy",
            json!({"error_bars": true, "target": null, "quantity": null}),
        ),
        ("/accuracy", json!({"target": 1, "quantity": "runout_m"})),
        ("/title", json!("Größe ✓")),
    ];
    for (pointer, value) in edges {
        accepted(&with(pointer, value.clone()));
    }
}

#[test]
fn a_whole_number_may_be_written_with_a_point() {
    let scenario = accepted(&with("/flow_snapshots", json!(3.0)));
    assert_eq!(scenario.flow_snapshots, 3);
}

#[test]
fn a_quaternion_nearly_of_unit_length_is_normalised_once() {
    let mut scenario = with("/bodies/0/orientation", json!([0.9239, 0.0, 0.3827, 0.0]));
    set(
        &mut scenario,
        "/bodies/0/position",
        json!({"elevation_m": 0.1}),
    );
    let first = accepted(&scenario);
    let quaternion = first.bodies[0].orientation.unwrap();
    let norm: f64 = quaternion.iter().map(|part| part * part).sum();
    assert!((norm - 1.0).abs() < 1e-15);
    let again = accepted(&serde_json::to_value(&first).unwrap());
    assert_eq!(again, first);
}

#[test]
fn the_largest_release_may_be_taken_at_its_word() {
    let answer = super::refused(&with("/flow/volume_m3", json!(1)));
    let words = answer[0].allowed.rsplit(' ').next().unwrap();
    let largest: f64 = words.parse().unwrap();
    // 0.2 m wide, 0.15 m / cos 40° thick, 1 m − 0.05 m long.
    let exact = 0.2 * 0.15 / 40_f64.to_radians().cos() * 0.95;
    assert!(largest <= exact && largest > exact * (1.0 - 1e-5));
    accepted(&with("/flow/volume_m3", json!(largest)));
    accepted(&with("/flow/volume_m3", json!(exact)));
}

#[test]
fn two_cubes_may_stand_on_each_other() {
    let second = json!({"shape": {"cube": {"side_m": 0.04}}, "position": {"elevation_m": 0.06}});
    accepted(&with("/bodies/1", second));
}
