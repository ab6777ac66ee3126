//! Scenarios from code.

use super::{accepted, minimal};
use crate::scenario::{BodyBuilder, Motion, Precision, Scenario, ScenarioBuilder, ScenarioError};
use serde_json::json;

fn shortest() -> ScenarioBuilder {
    Scenario::builder(40.0, 1.0, 2.0)
        .flow(0.01)
        .body(BodyBuilder::cube(0.04))
}

/// Pointers of the fields that are refused.
fn refused(builder: &ScenarioBuilder) -> Vec<String> {
    match builder.build() {
        Err(ScenarioError::Invalid(violations)) => {
            violations.into_iter().map(|one| one.pointer).collect()
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_built_scenario_is_the_one_of_its_json() {
    assert_eq!(shortest().build(), Ok(accepted(&minimal())));
    let pushed = Motion::Constant {
        velocity_m_s: [0.1, 0.0, 0.0],
        angular_velocity_rad_s: [0.0; 3],
    };
    let built = Scenario::builder(30.0, 1.0, 2.0)
        .width(0.4)
        .flow(0.02)
        .release(0.1, 0.2)
        .flow_friction(0.5, 0.7)
        .body(
            BodyBuilder::cuboid([0.04, 0.05, 0.06])
                .at(0.3, 0.1)
                .elevation(0.2)
                .density(2500.0)
                .friction(0.3, 0.2)
                .velocity([0.0, 0.0, -1.0]),
        )
        .body(BodyBuilder::ball(0.02).at(0.5, 0.0).fixed())
        .body(BodyBuilder::cube(0.05).at(0.8, -0.1).motion(&pushed))
        .duration(1.5)
        .cell_size(0.02)
        .precision(Precision::Double)
        .error_bars()
        .set("/flow/material/poissons_ratio", 0.25);
    let written = json!({
        "channel": {"inclination_deg": 30, "incline_length_m": 1, "runout_length_m": 2,
                    "width_m": 0.4},
        "flow": {"volume_m3": 0.02, "release": {"height_m": 0.1, "toe_distance_m": 0.2},
                 "material": {"static_friction": 0.5, "limiting_friction": 0.7,
                              "poissons_ratio": 0.25}},
        "bodies": [
            {"shape": {"box": {"sides_m": [0.04, 0.05, 0.06]}},
             "position": {"downstream_m": 0.3, "lateral_m": 0.1, "elevation_m": 0.2},
             "density_kg_m3": 2500, "friction": 0.3, "flow_friction": 0.2,
             "velocity_m_s": [0, 0, -1]},
            {"shape": {"ball": {"radius_m": 0.02}},
             "position": {"downstream_m": 0.5, "lateral_m": 0}, "fixed": true},
            {"shape": {"cube": {"side_m": 0.05}},
             "position": {"downstream_m": 0.8, "lateral_m": -0.1},
             "motion": {"velocity_m_s": [0.1, 0, 0]}}
        ],
        "duration_s": 1.5,
        "numerics": {"cell_size_m": 0.02, "precision": "double"},
        "accuracy": {"error_bars": true}
    });
    assert_eq!(built.build(), Ok(accepted(&written)));
}

#[test]
fn a_builder_is_refused_like_json() {
    let built = Scenario::builder(95.0, 1.0, 2.0).body(BodyBuilder::cube(f64::NAN));
    let found = refused(&built);
    assert_eq!(
        found,
        ["/bodies/0/shape/cube/side_m", "/channel/inclination_deg"]
    );
    // A body that is not there, and a key that none knows.
    let found = refused(&shortest().set("/bodies/1/yaw_deg", 10.0));
    assert_eq!(found, ["/~1bodies~11~1yaw_deg"]);
    let found = refused(&shortest().set("/flow/colour", "red"));
    assert_eq!(found, ["/flow/colour"]);
    let turned = shortest().set("/bodies/0/yaw_deg", 10.0).build().unwrap();
    assert_eq!(turned.bodies[0].yaw_deg, 10.0);
}
