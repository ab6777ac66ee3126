//! `scree plan`.

use crate::command::{Scene, ask, ask_with_input, tiny};
use serde_json::{Value, json};

fn planned(scenario: &Value) -> Value {
    let scene = Scene::new(scenario);
    let answer = ask(&[&"plan", &scene.file(), &"--json", &"--threads", &"1"]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    serde_json::from_str(&answer.stdout).expect("JSON")
}

/// Whether a choice that begins like this is taken.
fn taken(planned: &Value, what: &str) -> bool {
    let choices = planned["plan"]["choices"].as_array().expect("a list");
    let begins = |choice: &&Value| {
        choice["what"]
            .as_str()
            .is_some_and(|of| of.starts_with(what))
    };
    let choice = choices.iter().find(begins).expect("such a choice");
    assert!(!choice["why"].as_str().expect("a reason").is_empty());
    choice["taken"].as_bool().expect("yes or no")
}

#[test]
fn a_symmetric_scene_is_computed_by_halves_unless_told_otherwise() {
    let halves = planned(&tiny());
    assert!(taken(&halves, "half of the flow"));
    let mut full = tiny();
    full["numerics"]["symmetry"] = json!("full");
    let full = planned(&full);
    assert!(!taken(&full, "half of the flow"));
    let points = |planned: &Value| planned["plan"]["cost"]["point_steps"].as_u64();
    assert_eq!(points(&full), points(&halves).map(|half| 2 * half));
}

#[test]
fn the_time_lies_within_its_bounds() {
    let planned = planned(&tiny());
    let time = |key: &str| planned["wall_time"][key].as_f64().expect("a time");
    assert!(time("expected_s") > 0.0);
    assert!(time("low_s") <= time("expected_s") && time("expected_s") <= time("high_s"));
}

#[test]
fn what_a_scene_does_not_allow_is_said() {
    let mut askew = tiny();
    askew["bodies"][0]["yaw_deg"] = json!(20);
    askew["numerics"]["symmetry"] = json!("mirror");
    let answer = ask_with_input(&["plan", "-"], &askew.to_string());
    assert_eq!(answer.code, Some(2));
    let why = "numerics.symmetry can't be \"mirror\" in this scene: body 0 is not symmetric";
    assert!(answer.stderr.contains(why), "{}", answer.stderr);
}
