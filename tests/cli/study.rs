//! `scree study`: answers, files, and how it goes on.

use crate::command::{Answer, Scene, ask, json_file, tiny};
use serde_json::{Value, json};
use std::ffi::OsStr;
use std::path::Path;

/// A study of the tiny scene.
pub(crate) fn study() -> Value {
    json!({
        "title": "a small study",
        "scenario": tiny(),
        "inputs": [{"pointer": "/channel/base_friction",
                    "distribution": {"uniform": {"from": 0.3, "to": 0.5}}}],
        "design": {"sobol": {"members": 16, "seed": 7}},
        "questions": [
            {"rest": {"body": 0, "regions": [0.5]}},
            {"mean": {"quantity": "runout_m"}},
            {"sensitivity": {"quantity": "runout_m"}},
        ],
    })
}

fn compute(study: &Scene, out: &Path, further: &[&str]) -> Answer {
    let file = study.file();
    let mut arguments: Vec<&dyn AsRef<OsStr>> = vec![&"study", &file, &"--out", &out];
    arguments.extend(further.iter().map(|one| one as &dyn AsRef<OsStr>));
    let answer = ask(&arguments);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    answer
}

#[test]
fn answers_are_printed_and_all_files_are_there() {
    let scene = Scene::new(&study());
    let out = scene.path("results");
    let answer = compute(&scene, &out, &[]);
    for text in [
        "16 members finished",
        "where body 0 comes to rest",
        "mean of runout_m: ",
    ] {
        assert!(answer.stdout.contains(text), "{}", answer.stdout);
    }
    let answers = json_file(&out.join("answers.json"));
    assert_eq!(answers["members"]["finished"], 16);
    for name in [
        "members.csv",
        "members.ndjson",
        "members.npz",
        "rest-0.geojson",
        "rest-0.svg",
        "scatter.svg",
        "study.json",
    ] {
        assert!(out.join(name).exists(), "{name}");
    }
}

#[test]
fn a_study_goes_on_with_more_members_and_finer_levels() {
    let scene = Scene::new(&study());
    let out = scene.path("results");
    compute(&scene, &out, &["--quiet"]);
    let members = || std::fs::read_to_string(out.join("members.ndjson")).unwrap();
    let before = members();
    let mut larger = study();
    larger["scenario"]["numerics"]["cell_size_m"] = tiny()["numerics"]["cell_size_m"].clone();
    let coarse = larger["scenario"]["numerics"]["cell_size_m"]
        .as_f64()
        .unwrap();
    larger["finer_levels"] = json!([{"cell_size_m": coarse / 1.5, "members": 8}]);
    let larger = Scene::new(&larger);
    let answer = compute(&larger, &out, &["--quiet"]);
    assert!(
        answer.stdout.contains("24 members finished"),
        "{}",
        answer.stdout
    );
    assert!(answer.stdout.contains("levels"), "{}", answer.stdout);
    assert!(
        members().starts_with(&before),
        "members were computed again"
    );
    let levels = json_file(&out.join("answers.json"))["levels"].clone();
    assert_eq!([&levels[0]["finished"], &levels[1]["finished"]], [16, 8]);
}

#[test]
fn a_study_that_breaks_rules_says_where() {
    let mut wrong = study();
    wrong["inputs"][0]["distribution"] = json!({"uniform": {"from": 0.3, "to": 50.0}});
    wrong["questions"][1]["mean"]["quantity"] = json!("runout");
    let scene = Scene::new(&wrong);
    let answer = ask(&[&"study", &scene.file()]);
    assert_eq!(answer.code, Some(2), "{}", answer.stderr);
    for text in [
        "/questions/1/mean/quantity",
        "/channel/base_friction = 50.0",
    ] {
        assert!(answer.stderr.contains(text), "{}", answer.stderr);
    }
}
