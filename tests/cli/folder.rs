//! The folder of a run's results.

use crate::command::{Scene, ask, json_file, tiny};
use serde_json::{Value, json};
use std::path::Path;

/// Names of the results in a folder, in the order of the alphabet.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.filter(|name| !name.starts_with('.')).collect();
    names.sort();
    names
}

/// An outcome without what differs between any two runs.
fn timeless(mut outcome: Value) -> Value {
    for key in ["wall_s", "point_steps_per_s"] {
        outcome["cost"][key] = Value::Null;
    }
    outcome["accuracy"] = Value::Null;
    outcome
}

/// The scenario has its defaults written out, and is the scenario of the same outcome.
#[test]
fn scenario_and_plan_are_beside_the_results() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    let outcome = json_file(&out.join("outcome.json"));

    let written = out.join("scenario.json");
    let scenario = json_file(&written);
    assert_eq!(scenario["gravity_m_s2"], 9.81);
    assert_eq!(scenario["flow"]["material"]["bulk_density_kg_m3"], 1500.0);
    let again = ask(&[&"run", &written, &"--json"]);
    let again: Value = serde_json::from_str(&again.stdout).unwrap();
    assert_eq!(timeless(again), timeless(outcome.clone()));

    let plan = json_file(&out.join("plan.json"));
    assert_eq!(plan, outcome["plan"]);
    let planned = ask(&[&"plan", &scene.file(), &"--json"]);
    let planned: Value = serde_json::from_str(&planned.stdout).unwrap();
    assert_eq!(plan, planned["plan"]);
}

#[test]
fn trajectories_are_in_the_formats_asked_for_and_in_no_other() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let run = |formats: &[&str]| {
        let mut arguments: Vec<&dyn AsRef<std::ffi::OsStr>> = vec![&"run"];
        let file = scene.file();
        arguments.extend([&file as &dyn AsRef<_>, &"--out", &out]);
        for format in formats {
            arguments.extend([&"--format" as &dyn AsRef<_>, format]);
        }
        let answer = ask(&arguments);
        assert_eq!(answer.code, Some(0), "{}", answer.stderr);
        let mut names = names(&out);
        names.retain(|name| name.starts_with("trajectory"));
        names
    };
    assert_eq!(run(&[]), ["trajectory-0.json"]);
    let two = ["trajectory-0.csv", "trajectory-0.npz"];
    assert_eq!(run(&["npz", "csv"]), two);
    assert_eq!(run(&["csv,npz"]), two);
    let table = std::fs::read_to_string(out.join("trajectory-0.csv")).unwrap();
    // A heading, and a sample every 0.01 s of 0.1 s.
    assert_eq!(table.lines().count(), 12);
    assert!(table.starts_with("time_s,"), "{table}");
    let archive = std::fs::read(out.join("trajectory-0.npz")).unwrap();
    assert!(archive.starts_with(b"PK"));
    assert_eq!(run(&["ndjson"]), ["trajectory-0.ndjson"]);
    let lines = std::fs::read_to_string(out.join("trajectory-0.ndjson")).unwrap();
    let first: Value = serde_json::from_str(lines.lines().next().unwrap()).unwrap();
    assert_eq!(first["time_s"], 0.0);
}

/// A file that is named like a result, but is of no run, is somebody's own.
#[test]
fn no_file_of_the_users_is_replaced() {
    let scene = Scene::new(&tiny());
    let own = scene.path("own");
    std::fs::create_dir(&own).unwrap();
    let file = own.join("scenario.json");
    let text = tiny().to_string();
    std::fs::write(&file, &text).unwrap();
    for command in [&["run"][..], &["demo", "--scenario"]] {
        let mut arguments: Vec<&dyn AsRef<std::ffi::OsStr>> = Vec::new();
        arguments.extend(command.iter().map(|word| word as &dyn AsRef<_>));
        arguments.extend([&file as &dyn AsRef<_>, &"--out", &own]);
        for outcome in [None, Some("{}")] {
            if let Some(text) = outcome {
                std::fs::write(own.join("outcome.json"), text).unwrap();
            }
            let refused = ask(&arguments);
            assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
            let reason = "scenario.json would be replaced";
            assert!(refused.stderr.contains(reason), "{}", refused.stderr);
            assert_eq!(std::fs::read_to_string(&file).unwrap(), text);
        }
        std::fs::remove_file(own.join("outcome.json")).unwrap();
    }
}

/// The scenario that a run has written may be run again in its place.
#[test]
fn a_written_scenario_is_run_again_in_its_folder() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let first = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(first.code, Some(0), "{}", first.stderr);
    let written = out.join("scenario.json");
    let before = std::fs::read_to_string(&written).unwrap();
    let again = ask(&[&"run", &written, &"--out", &out]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert_eq!(std::fs::read_to_string(&written).unwrap(), before);
}

/// The scenario of a failed run is beside its trajectories.
#[test]
fn a_failed_run_leaves_its_scenario() {
    let scene = Scene::new(&crate::command::unstable());
    let out = scene.path("results");
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(answer.code, Some(3), "{}", answer.stderr);
    let failed = out.join("failed");
    let expected = ["scenario.json", "trajectory-0.json", "trajectory-1.json"];
    assert_eq!(names(&failed), expected);
    let scenario = json_file(&failed.join("scenario.json"));
    assert_eq!(scenario["bodies"][1]["density_kg_m3"], json!(1e6));
}
