//! The prescribed motion of a body.

use super::{accepted, check, refused, set, with};
use crate::motion::Velocities;
use crate::scenario::{Motion, Scenario};
use nalgebra::Vector3;
use serde_json::{Value, json};

const POINTER: &str = "/bodies/0/motion";

fn motion(value: Value) -> Motion {
    let scenario = accepted(&with(POINTER, value));
    let text = scenario.to_json();
    assert_eq!(Scenario::from_json(&text).as_ref(), Ok(&scenario));
    scenario.bodies[0].motion.clone().expect("it was given")
}

#[test]
fn velocities_may_stay_or_change() {
    let constant = motion(json!({"velocity_m_s": [1, 0, -2]}));
    let velocities = Velocities {
        linear: Vector3::new(1.0, 0.0, -2.0),
        angular: Vector3::zeros(),
    };
    assert_eq!(constant.prescribed().velocities(7.0), velocities);
    let table = motion(json!({"times_s": [0.5, 1.5], "velocity_m_s": [[0, 0, 0], [2, 0, -4]]}));
    assert_eq!(table.prescribed().velocities(1.0), velocities);
    let turning = motion(json!({"times_s": [2], "angular_velocity_rad_s": [[0, 3, 0]]}));
    assert_eq!(turning.prescribed().velocities(0.0).angular.y, 3.0);
    let resting = motion(json!({}));
    assert!(resting.prescribed().rests_from(0.0));
    assert_eq!(accepted(&with(POINTER, Value::Null)).bodies[0].motion, None);
}

#[test]
fn what_is_wrong_with_a_table_is_told() {
    let first = |motion: Value| {
        let found = refused(&with(POINTER, motion));
        let violation = found.into_iter().next().expect("one at least");
        format!("{} [{}]", violation.detail, violation.allowed)
    };
    let each = "each a list of 3 numbers, each -1000 <= x <= 1000";
    let velocity = "bodies[0].motion.velocity_m_s";
    assert_eq!(
        first(json!({"times_s": [0, 1], "velocity_m_s": [1, 0, 0]})),
        format!(
            "{velocity} is a list of 3 numbers, not of lists, one a velocity. [2 velocities, {each}]"
        )
    );
    assert_eq!(
        first(json!({"times_s": [0, 1], "velocity_m_s": [[1, 0, 0]]})),
        format!("{velocity} has 1 velocity, not 2 velocities. [2 velocities, {each}]")
    );
    assert_eq!(
        first(json!({"times_s": [0], "velocity_m_s": []})),
        format!("{velocity} has 0 velocities, not 1 velocity. [1 velocity, {each}]")
    );
    let found = refused(&with(POINTER, json!({"times_s": 1, "velocity_m_s": []})));
    assert_eq!(
        found[1].detail,
        format!("{velocity} has 0 velocities, not 1 to 1000 velocities.")
    );
    for key in ["velocity_m_s", "angular_velocity_rad_s"] {
        let lacks = first(json!({key: [[1, 0, 0], [2, 0, 0]]}));
        assert!(
            lacks.starts_with("bodies[0].motion.times_s is missing"),
            "{lacks}"
        );
    }
}

#[test]
fn what_is_no_motion_is_refused() {
    let table =
        |times: Value, velocities: Value| json!({"times_s": times, "velocity_m_s": velocities});
    check(&[
        ("a number", POINTER, json!(3), POINTER, "an object"),
        (
            "an unknown key",
            POINTER,
            json!({"speed": 1}),
            "/bodies/0/motion/speed",
            "velocity_m_s",
        ),
        (
            "too fast",
            POINTER,
            json!({"velocity_m_s": [2000, 0, 0]}),
            "/bodies/0/motion/velocity_m_s/0",
            "x <= 1000",
        ),
        (
            "no times",
            POINTER,
            table(json!([]), json!([[0, 0, 0]])),
            "/bodies/0/motion/times_s",
            "1 to 1000 times",
        ),
        (
            "before the start",
            POINTER,
            table(json!([-1, 1]), json!([[0, 0, 0], [1, 0, 0]])),
            "/bodies/0/motion/times_s/0",
            "0 <= x <= 3600",
        ),
        (
            "the same time twice",
            POINTER,
            table(json!([0, 1, 1]), json!([[0, 0, 0], [1, 0, 0], [2, 0, 0]])),
            "/bodies/0/motion/times_s/2",
            "x > 1",
        ),
        (
            "a velocity too few",
            POINTER,
            table(json!([0, 1]), json!([[1, 0, 0]])),
            "/bodies/0/motion/velocity_m_s",
            "2 velocities, each a list of 3 numbers",
        ),
        (
            "a number for a velocity",
            POINTER,
            table(json!([0, 1]), json!([[1, 0, 0], 0])),
            "/bodies/0/motion/velocity_m_s/1",
            "a list of 3 numbers",
        ),
    ]);
}

// For a whole body, so that its other fields can be given, too.
#[test]
fn a_body_moves_in_one_way_only() {
    let body = |key: &str, value: Value| {
        let mut body = json!({"shape": {"cube": {"side_m": 0.04}},
            "motion": {"velocity_m_s": [1, 0, 0]}});
        body[key] = value;
        body
    };
    check(&[
        (
            "fixed",
            "/bodies/0",
            body("fixed", json!(true)),
            "/bodies/0/fixed",
            "false while motion is given",
        ),
        (
            "thrown",
            "/bodies/0",
            body("velocity_m_s", json!([0, 0, 1])),
            "/bodies/0/velocity_m_s",
            "[0, 0, 0]",
        ),
        (
            "spun",
            "/bodies/0",
            body("angular_velocity_rad_s", json!([0, 0, 1])),
            "/bodies/0/angular_velocity_rad_s",
            "[0, 0, 0]",
        ),
    ]);
    accepted(&with("/bodies/0", body("velocity_m_s", json!([0, 0, 0]))));
}

// Driven at 1/√6 of its sound speed a wall takes a third of the volume before it: 2.5 m/s at
// 6.12 m/s, or at E = 3 (1 − 2ν) ρ c² = 67.5 kPa. Its speed is not limited where the stiffness
// is left to the program, or without a flow.
#[test]
fn a_motion_is_slower_than_sound() {
    const SOUND: &str = "/numerics/sound_speed_m_s";
    let driven = |pointer: &str, value: Value| {
        let mut scenario = with(pointer, value);
        let times = json!({"times_s": [0, 0.1], "velocity_m_s": [[0, 0, 0], [1.5, 0, -2]]});
        set(&mut scenario, "/bodies/0/motion", times);
        scenario
    };
    let found = refused(&driven(SOUND, json!(6.12)));
    assert_eq!((found.len(), found[0].pointer.as_str()), (1, SOUND));
    assert_eq!(found[0].allowed, "x >= 6.12373, or null");
    assert_eq!(found[0].unit.as_deref(), Some("m/s"));
    let detail = &found[0].detail;
    assert!(
        detail.contains("bodies[0].motion, which reaches 2.5 m/s"),
        "{detail}"
    );
    accepted(&driven(SOUND, json!(6.13)));
    let modulus = "/flow/material/youngs_modulus_pa";
    assert_eq!(refused(&driven(modulus, json!(6.7e4)))[0].pointer, modulus);
    accepted(&driven(modulus, json!(6.8e4)));
    accepted(&driven(SOUND, json!(null)));
    let mut alone = driven(SOUND, json!(0.1));
    set(&mut alone, "/flow", json!(null));
    accepted(&alone);
}
