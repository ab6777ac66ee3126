//! `scree plan`.

use crate::command::{Scene, ask, ask_with_input, tiny};
use serde_json::{Value, json};

fn planned(scenario: &Value) -> Value {
    let scene = Scene::new(scenario);
    let answer = ask(&[&"plan", &scene.file(), &"--json", &"--threads", &"1"]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    serde_json::from_str(&answer.stdout).expect("JSON")
}

/// True if the choice that begins with this text is taken.
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
fn hints_are_told_in_words_and_in_json() {
    let mut steep = tiny();
    steep["channel"]["inclination_deg"] = json!(0.698);
    let hints = planned(&steep)["plan"]["hints"].clone();
    assert_eq!(hints[0]["field"], "/channel/inclination_deg");
    let answer = ask_with_input(&["plan", "-", "--threads", "1"], &steep.to_string());
    let line = format!(
        "hint /channel/inclination_deg: {}",
        hints[0]["detail"].as_str().unwrap()
    );
    assert!(
        answer.stdout.lines().any(|told| told == line),
        "{}",
        answer.stdout
    );
}

#[test]
fn a_plan_with_a_target_does_not_pass_for_one_of_its_runs() {
    let mut scene = tiny();
    scene["accuracy"] = json!({"target": 0.1, "quantity": "displacement_m"});
    if let Some(numerics) = scene["numerics"].as_object_mut() {
        numerics.remove("cell_size_m");
    }
    let answer = ask_with_input(&["plan", "-", "--threads", "1"], &scene.to_string());
    let told = |start: &str| {
        answer
            .stdout
            .lines()
            .filter(|line| line.starts_with(start))
            .count()
    };
    assert_eq!(
        told("cost if there were no target: "),
        1,
        "{}",
        answer.stdout
    );
    assert_eq!(
        told("hint /accuracy/target: the target of 0.1 for displacement_m chooses"),
        1
    );
    assert!(
        told("first for the target: cells of ") >= 3,
        "{}",
        answer.stdout
    );
    assert_eq!(told("for error bars"), 0);
}

#[test]
fn a_scene_of_nothing_keeps_no_nodes() {
    let mut empty = tiny();
    empty["flow"] = Value::Null;
    empty["bodies"] = json!([]);
    assert!(!taken(
        &planned(&empty),
        "nodes are kept only where points are"
    ));
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
