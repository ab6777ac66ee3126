//! Commands that use a service elsewhere: `submit`, `watch`, `get`, `dismiss`, and `study` with
//! `--url`.

mod access;
mod interruption;
mod study;

use crate::command::{Answer, Scene, Served, ask, json_file, scree, tiny, unstable};
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Stdio;

/// A service, and the folder of its database and of the scenario.
struct Remote {
    scene: Scene,
    served: Served,
}

impl Remote {
    fn new(scenario: &Value) -> Self {
        let scene = Scene::new(scenario);
        let served = Served::start(&scene.path("test.db"), Stdio::null());
        Self { scene, served }
    }

    fn url(&self) -> String {
        format!("http://{}", self.served.address)
    }

    /// Result of a command for this service.
    fn ask(&self, words: &[&str]) -> Answer {
        at(&self.url(), words)
    }

    /// Identifier of a job of the scenario, after this command.
    fn submit(&self, further: &[&str]) -> String {
        let file = self.scene.file();
        let words = [&["submit", file.to_str().unwrap()], further].concat();
        let answer = self.ask(&words);
        assert_eq!(answer.code, Some(0), "{}", answer.stderr);
        answer.stdout.trim().to_owned()
    }

    /// All jobs of the service.
    fn jobs(&self) -> Vec<Value> {
        let answer = self.ask(&["get", "--json"]);
        let page: Value = serde_json::from_str(&answer.stdout).unwrap();
        page["jobs"].as_array().unwrap().clone()
    }
}

fn at(url: &str, words: &[&str]) -> Answer {
    let output = scree().args(words).env("SCREE_URL", url).output();
    output.expect("the binary starts").into()
}

#[test]
fn results_are_those_of_a_local_run() {
    let remote = Remote::new(&tiny());
    let (here, there) = (remote.scene.path("here"), remote.scene.path("there"));
    let formats = ["--format", "json,ndjson,csv,npz"];
    let id = remote.submit(&["--wait", "--quiet"]);
    let out = there.to_str().unwrap();
    let got = remote.ask(&[&["get", &id, "--out", out], &formats[..]].concat());
    assert_eq!((got.code, got.stderr.as_str()), (Some(0), ""));
    let ran = ask(&[
        &"run",
        &remote.scene.file(),
        &"--out",
        &here,
        &formats[0],
        &formats[1],
    ]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);

    // Up to the cost, in which wall times differ, and the folder.
    let without_cost = |answer: &Answer| {
        let cost = answer.stdout.find("cost ").expect("a cost");
        answer.stdout[..cost].to_owned()
    };
    assert_eq!(without_cost(&got), without_cost(&ran));
    let names = |folder: &Path| {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&there), names(&here));
    same_results(&there, &here);

    let watched = remote.ask(&["watch", &id]);
    assert_eq!(without_cost(&watched), without_cost(&ran));
    let watched = remote.ask(&["watch", &id, "--json"]);
    let job: Value = serde_json::from_str(&watched.stdout).unwrap();
    assert_eq!(job["outcome"], json_file(&there.join("outcome.json")));
}

fn same_results(there: &Path, here: &Path) {
    let both = |name: &str| [there, here].map(|folder| folder.join(name));
    let [outcome, expected] = both("outcome.json").map(|path| json_file(&path));
    for part in ["bodies", "flow", "conservation", "plan", "remarks"] {
        assert_eq!(outcome[part], expected[part], "{part}");
    }
    let [trajectory, expected] = both("trajectory-0.json").map(|path| json_file(&path));
    assert_eq!(trajectory["columns"], expected["columns"]);
    // Word for word, numbers and order of keys too.
    for name in [
        "scenario.json",
        "plan.json",
        "trajectory-0.csv",
        "trajectory-0.ndjson",
        "trajectory-0.npz",
        "motion.svg",
        "aerial.svg",
    ] {
        let [file, expected] = both(name).map(|path| fs::read(path).unwrap());
        assert!(file == expected, "{name} differs");
    }
}

#[test]
fn several_files_are_several_jobs_that_can_be_listed() {
    let remote = Remote::new(&tiny());
    let file = remote.scene.file();
    let file = file.to_str().unwrap();
    let ids = remote.submit(&[file, "--label", "sweep", "--label", "a=1"]);
    let ids: Vec<&str> = ids.lines().collect();
    assert_eq!(ids.len(), 2);
    remote.submit(&["--wait", "--quiet"]);

    let listed = remote.ask(&["get", "--label", "sweep"]);
    let first_words = |text: &str| {
        let words = text.lines().filter_map(|line| line.split(' ').next());
        words.map(str::to_owned).collect::<Vec<_>>()
    };
    // Newest first.
    assert_eq!(first_words(&listed.stdout), [ids[1], ids[0]]);
    assert!(listed.stdout.contains("tiny"), "{}", listed.stdout);
    assert!(listed.stdout.contains("a=1"), "{}", listed.stdout);
    let newest = remote.ask(&["get", "--status", "successful,failed", "--limit", "1"]);
    assert_eq!(newest.stdout.lines().count(), 1, "{}", newest.stdout);
    let none = remote.ask(&["get", "--label", "other"]);
    assert_eq!((none.code, none.stdout.as_str()), (Some(0), ""));
}

#[test]
fn a_refused_scenario_is_told_as_by_validate_and_none_after_it_is_submitted() {
    let mut wrong = tiny();
    wrong["channel"]["inclination_deg"] = json!(95);
    wrong["channel"]["colour"] = json!("red");
    let remote = Remote::new(&wrong);
    let good = Scene::new(&tiny());
    let (wrong, good) = (remote.scene.file(), good.file());
    let (wrong, good) = (wrong.to_str().unwrap(), good.to_str().unwrap());
    let refused = remote.ask(&["submit", good, wrong, good]);
    let expected = ask(&[&"validate", &wrong]);
    assert_eq!((refused.code, expected.code), (Some(2), Some(2)));
    assert_eq!(refused.stdout.lines().count(), 1, "{}", refused.stdout);
    let (told, rest) = refused.stderr.split_once("\n\nnot submitted: ").unwrap();
    assert_eq!(told, expected.stderr.trim_end());
    assert_eq!(rest.trim_end(), good);
    assert_eq!(remote.jobs().len(), 1);

    let unread = remote.ask(&["submit", good, "no-such-file.json"]);
    assert_eq!((unread.code, unread.stdout.as_str()), (Some(2), ""));
    assert_eq!(remote.jobs().len(), 1);
    let label = remote.ask(&["submit", good, "--label", "a b"]);
    assert_eq!(label.code, Some(2), "{}", label.stderr);
    assert!(
        label.stderr.contains("the request breaks 1 rule"),
        "{}",
        label.stderr
    );
}

#[test]
fn a_numerical_failure_has_the_exit_code_of_a_local_run() {
    let remote = Remote::new(&unstable());
    let file = remote.scene.file();
    let failed = remote.ask(&["submit", file.to_str().unwrap(), "--wait", "--quiet"]);
    assert_eq!(failed.code, Some(3), "{}", failed.stderr);
    let id = failed.stdout.trim();
    assert!(failed.stderr.contains(id), "{}", failed.stderr);
    assert!(failed.stderr.contains("t = "), "{}", failed.stderr);

    let out = remote.scene.path("results");
    let got = remote.ask(&["get", id, "--out", out.to_str().unwrap()]);
    assert_eq!((got.code, got.stdout.as_str()), (Some(3), ""));
    assert!(out.join("failed/trajectory-1.json").is_file());
    assert!(!out.join("outcome.json").exists());
}

#[test]
fn what_is_not_there_is_invalid_input() {
    let remote = Remote::new(&tiny());
    let unknown = "01890a5d-ac96-774b-bcce-b302099a8057";
    for command in ["watch", "get", "dismiss"] {
        let answer = remote.ask(&[command, unknown]);
        assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
        assert!(
            answer.stderr.contains("has no job or study"),
            "{}",
            answer.stderr
        );
        assert!(answer.stderr.contains(&remote.url()), "{}", answer.stderr);
        assert_eq!(remote.ask(&[command, "seven"]).code, Some(2));
    }
}

#[test]
fn an_address_at_which_nobody_listens_is_told_at_once() {
    let answer = at("http://127.0.0.1:1", &["get"]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(1), ""));
    let start = "error: no answer from http://127.0.0.1:1: ";
    assert!(answer.stderr.starts_with(start), "{}", answer.stderr);
}
