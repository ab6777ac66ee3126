//! Poses and release.

use super::{accepted, minimal, set, with};
use crate::scenario::{Scenario, Support};
use nalgebra::{Vector3, Vector4};
use serde_json::json;

fn cube_with(field: &str, value: serde_json::Value) -> Scenario {
    accepted(&with(&format!("/bodies/0/{field}"), value))
}

/// Positions here are sums of a few numbers below 1 m.
fn close(a: Vector3<f64>, b: [f64; 3]) -> bool {
    (a - Vector3::from(b)).norm() < 1e-14
}

#[test]
fn a_cube_rests_on_the_floor() {
    let scenario = accepted(&minimal());
    let pose = scenario.initial_pose(0);
    assert!(close(pose.position, [0.04, 0.0, 0.02]));
    assert_eq!(pose.orientation.angle(), 0.0);
    assert_eq!(scenario.support_of(0), Support::Floor);
}

#[test]
fn a_cube_rests_flat_on_the_incline() {
    let position = json!({"downstream_m": -0.5, "lateral_m": 0.03});
    let scenario = cube_with("position", position);
    let pose = scenario.initial_pose(0);
    let theta = 40_f64.to_radians();
    // Half a side above the plane z = −x tan θ, along its normal.
    let z = 0.5 * theta.tan() + 0.02 / theta.cos();
    assert!(close(pose.position, [-0.5, 0.03, z]));
    let up = pose.orientation * Vector3::z();
    assert!(close(up, [theta.sin(), 0.0, theta.cos()]));
    let ahead = pose.orientation * Vector3::x();
    assert!(close(ahead, [theta.cos(), 0.0, -theta.sin()]));
    assert_eq!(scenario.support_of(0), Support::Incline);
}

#[test]
fn yaw_turns_about_the_normal_of_the_bed() {
    let mut scenario = with("/bodies/0/yaw_deg", json!(30));
    set(
        &mut scenario,
        "/bodies/0/position/downstream_m",
        json!(-0.5),
    );
    let scenario = accepted(&scenario);
    let orientation = scenario.initial_pose(0).orientation;
    assert!((orientation * Vector3::z() - scenario.bed().normal(-0.1, 0.0)).norm() < 1e-15);
    // Seen from above, x turns towards y.
    let ahead = orientation * Vector3::x();
    assert!((ahead.y - 0.5).abs() < 1e-15);
}

#[test]
fn a_given_orientation_is_lowered_until_it_touches() {
    let half = 22.5_f64.to_radians();
    let on_edge = json!([half.cos(), 0.0, half.sin(), 0.0]);
    let pose = cube_with("orientation", on_edge).initial_pose(0);
    // A core edge at 18 mm √2 below the centre, and the rounding of 2 mm.
    assert!(close(
        pose.position,
        [0.04, 0.0, 0.018 * 2_f64.sqrt() + 0.002]
    ));
}

#[test]
fn an_elevation_is_taken_as_given() {
    let scenario = cube_with("position", json!({"downstream_m": 0.0, "elevation_m": 0.5}));
    assert!(close(scenario.initial_pose(0).position, [0.0, 0.0, 0.5]));
    assert_eq!(scenario.support_of(0), Support::Free);
}

#[test]
fn a_cube_may_touch_every_wall() {
    for position in [
        json!({"downstream_m": 0.1, "lateral_m": 0.08}),
        json!({"downstream_m": 0.1, "lateral_m": -0.08, "elevation_m": 0.02}),
        json!({"downstream_m": 1.98}),
        json!({"downstream_m": 0.02}),
        json!({"downstream_m": -0.98, "elevation_m": 0.9}),
    ] {
        // Level, so that its sides meet the walls flat.
        let mut scenario = with("/bodies/0/position", position);
        set(&mut scenario, "/bodies/0/orientation", json!([1, 0, 0, 0]));
        accepted(&scenario);
    }
    let mut wedged = with("/channel/width_m", json!(0.04));
    set(&mut wedged, "/flow/volume_m3", json!(0.001));
    accepted(&wedged);
}

#[test]
fn the_bound_given_for_a_straddling_body_is_where_it_touches() {
    let position = json!({"downstream_m": 0.0});
    let answer = super::refused(&with("/bodies/0/position", position));
    let bound: f64 = answer[0]
        .allowed
        .trim_start_matches("x >= ")
        .parse()
        .unwrap();
    // Level over the foot: the rear lower core edge at (−18, −18) mm from the
    // centre stays 2 mm clear of the plane x sin θ + z cos θ = 0.
    let theta = 40_f64.to_radians();
    let expected = 0.018 + (0.018 * theta.sin() + 0.002) / theta.cos();
    // The bound is given to the nanometre.
    assert!((bound - expected).abs() < 1e-9);
    let place = |z: f64| json!({"downstream_m": 0.0, "elevation_m": z});
    accepted(&with("/bodies/0/position", place(bound)));
    // Touching ends a thousandth of the 2 mm sphero radius deeper.
    accepted(&with("/bodies/0/position", place(bound - 1.9e-6)));
    super::refused(&with("/bodies/0/position", place(bound - 2.1e-6)));
}

// For any origin of the points the centre of mass is placed, and the axes are those of the
// points.
#[test]
fn a_polyhedron_lies_as_its_points_say() {
    let wedge = |shift: f64| {
        let at = |x: f64, y: f64, z: f64| [x + shift, y - shift, z + shift];
        let vertices = [
            at(0.0, 0.0, 0.0),
            at(0.06, 0.0, 0.0),
            at(0.0, 0.03, 0.0),
            at(0.06, 0.03, 0.0),
            at(0.0, 0.0, 0.03),
            at(0.0, 0.03, 0.03),
        ];
        cube_with("shape", json!({"polyhedron": {"vertices_m": vertices}}))
    };
    let scenario = wedge(0.0);
    let (pose, shape) = (scenario.initial_pose(0), scenario.shape_of(0));
    assert_eq!(pose.orientation.angle(), 0.0);
    assert_eq!(pose.position.y, 0.0);
    // The wedge's own centre is a third of the way up and from the steep end;
    // rounding moves it by less than the radius.
    assert!((shape.extent_along(&-Vector3::x()) - 0.02).abs() < shape.sphero_radius());
    assert!((pose.position.z - 0.01).abs() < shape.sphero_radius());
    assert!((pose.position.z - shape.extent_along(&-Vector3::z())).abs() < 1e-16);
    let shifted = wedge(50.0).shape_of(0);
    // Coordinates of 50 m are rounded to 7e-15.
    assert!(
        (shifted.extent_along(&Vector3::x()) - shape.extent_along(&Vector3::x())).abs() < 1e-13
    );
}

#[test]
fn a_flat_channel_has_no_foot() {
    let mut scenario = with("/channel/inclination_deg", json!(0));
    set(
        &mut scenario,
        "/bodies/0/position/downstream_m",
        json!(-0.005),
    );
    let pose = accepted(&scenario).initial_pose(0);
    assert!(close(pose.position, [-0.005, 0.0, 0.02]));
}

#[test]
fn the_release_is_where_the_contract_puts_it() {
    let scenario = accepted(&minimal());
    let release = scenario.release().unwrap();
    let thickness = 0.15 / 40_f64.to_radians().cos();
    assert_eq!(release.front_m, -0.05);
    assert!((release.vertical_thickness_m - thickness).abs() < 1e-15);
    assert!((release.back_m - (-0.05 - 0.01 / (0.2 * thickness))).abs() < 1e-15);
    assert_eq!(release.width_m, 0.2);
    assert!(
        (release.length_m() * release.vertical_thickness_m * release.width_m - 0.01).abs() < 1e-16
    );
    assert!((scenario.bed().elevation(-0.5, 0.0) - 0.5 * 40_f64.to_radians().tan()).abs() < 1e-15);
    assert_eq!(scenario.bed().elevation(0.5, 0.0), 0.0);

    assert_eq!(accepted(&with("/flow", json!(null))).release(), None);
    assert_eq!(accepted(&with("/flow/volume_m3", json!(0))).release(), None);
}

#[test]
fn the_mirrored_scene_is_the_mirror_image() {
    let scene = |y: f64, yaw: f64| {
        let mut scenario = with("/bodies/0/yaw_deg", json!(yaw));
        let position = json!({"downstream_m": -0.4, "lateral_m": y});
        set(&mut scenario, "/bodies/0/position", position);
        accepted(&scenario).initial_pose(0)
    };
    let (left, right) = (scene(0.05, 20.0), scene(-0.05, -20.0));
    assert_eq!(left.position.x, right.position.x);
    assert_eq!(left.position.y, -right.position.y);
    assert_eq!(left.position.z, right.position.z);
    let mirrored = left
        .orientation
        .coords
        .component_mul(&Vector4::new(-1.0, 1.0, -1.0, 1.0));
    assert_eq!(right.orientation.coords, mirrored);
}
