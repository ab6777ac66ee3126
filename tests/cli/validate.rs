//! `scree validate`.

use crate::command::{Scene, ask, ask_with_input, tiny};
use serde_json::json;

#[test]
fn a_legal_scenario_is_resolved() {
    let scene = Scene::new(&tiny());
    let answer = ask(&[&"validate", &scene.file()]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    // 1e-4 m³ of 1500 kg/m³; a cube of 2 cm on the floor has its centre at 1 cm.
    for fact in [
        "0.150 kg",
        "0.0150, 0.0000, 0.0100 m on the floor",
        "cells of 0.0100 m",
    ] {
        assert!(answer.stdout.contains(fact), "{fact}: {}", answer.stdout);
    }
}

#[test]
fn the_paper_scene_is_legal() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/configs/scenarios/source_paper.json"
    );
    let answer = ask(&[&"validate", &path]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
}

#[test]
fn all_violations_are_listed_at_once() {
    let mut scenario = tiny();
    scenario["channel"]["inclination_deg"] = json!(95);
    scenario["channel"]["colour"] = json!("red");
    scenario["bodies"][0]["density_kg_m3"] = json!(-1);
    let answer = ask_with_input(&["validate", "-"], &scenario.to_string());
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    let wanted = [
        "standard input breaks 3 rules",
        "/channel/inclination_deg",
        "value:   95",
        "[°]",
        "/channel/colour",
        "/bodies/0/density_kg_m3",
        "[kg/m³]",
    ];
    for phrase in wanted {
        assert!(
            answer.stderr.contains(phrase),
            "{phrase}: {}",
            answer.stderr
        );
    }
}

#[test]
fn what_is_no_json_is_told_where() {
    let answer = ask_with_input(&["validate", "-"], "{\n  \"channel\": }");
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("line 2"), "{}", answer.stderr);
}

#[test]
fn a_file_that_is_not_there_is_invalid_input() {
    let answer = ask(&[&"validate", &"no-such-file.json"]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(
        answer.stderr.contains("no-such-file.json"),
        "{}",
        answer.stderr
    );
}
