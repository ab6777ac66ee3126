//! A study that a service computes.

use super::Remote;
use crate::command::{ask, json_file};
use crate::study::study;
use serde_json::json;
use std::fs;
use std::path::Path;

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn answers_and_files_are_those_of_a_local_study() {
    let remote = Remote::new(&study());
    let file = remote.scene.file();
    let (here, there) = (remote.scene.path("here"), remote.scene.path("there"));
    let out = there.to_str().unwrap();
    let served = remote.ask(&[
        "study",
        file.to_str().unwrap(),
        "--url",
        &remote.url(),
        "--out",
        out,
    ]);
    assert_eq!(served.code, Some(0), "{}", served.stderr);
    let local = ask(&[&"study", &file, &"--out", &here]);
    assert_eq!(local.code, Some(0), "{}", local.stderr);
    let answers = |text: &str| text.split("\n\nwritten to ").next().unwrap().to_owned();
    assert_eq!(answers(&served.stdout), answers(&local.stdout));
    assert_eq!(names(&there), names(&here));
    let both = |name: &str| [&there, &here].map(|folder| json_file(&folder.join(name)));
    for name in ["answers.json", "study.json", "rest-0.geojson"] {
        let [one, other] = both(name);
        assert_eq!(one, other, "{name}");
    }
    let [map, expected] =
        [&there, &here].map(|folder| fs::read(folder.join("rest-0.svg")).unwrap());
    assert!(map == expected);

    // The local command goes on with what the service has computed.
    let members = || fs::read_to_string(there.join("members.ndjson")).unwrap();
    let before = members();
    let again = ask(&[&"study", &file, &"--out", &there]);
    assert_eq!(answers(&again.stdout), answers(&local.stdout));
    assert_eq!(members(), before);

    let id = served.stderr.lines().next().unwrap();
    let id = id.strip_prefix("study ").expect("an identifier");
    let later = remote.scene.path("later");
    let got = remote.ask(&["get", id, "--out", later.to_str().unwrap()]);
    assert_eq!((got.code, got.stderr.as_str()), (Some(0), ""));
    assert!(
        got.stdout.contains(&answers(&local.stdout)),
        "{}",
        got.stdout
    );
    assert_eq!(names(&later), names(&here));
    let watched = remote.ask(&["watch", id]);
    assert_eq!(watched.stdout.trim_end(), answers(&local.stdout));
    assert_eq!(remote.ask(&["dismiss", id]).code, Some(1));
}

#[test]
fn a_study_that_breaks_rules_says_where() {
    let mut wrong = study();
    wrong["questions"][1]["mean"]["quantity"] = json!("runout");
    let remote = Remote::new(&wrong);
    let (file, url) = (remote.scene.file(), remote.url());
    let answer = remote.ask(&["study", file.to_str().unwrap(), "--url", &url]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    for text in ["breaks 1 rule", "/questions/1/mean/quantity", "runout"] {
        assert!(answer.stderr.contains(text), "{}", answer.stderr);
    }
}
