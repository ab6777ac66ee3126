//! `scree run` that is interrupted, and resumed.

use crate::command::{Answer, Scene, ask, json_file, long, scree, tiny};
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Limit on the size of files [512 bytes].
const LIMIT_BLOCKS: u32 = 3600;

/// A run that is killed if the test fails before it has ended.
struct Running(Option<Child>);

impl Drop for Running {
    fn drop(&mut self) {
        if let Some(child) = &mut self.0 {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

impl Running {
    fn start(scene: &Scene, out: Option<&Path>) -> Self {
        let mut command = scree();
        command.arg("run").arg(scene.file());
        out.map(|out| command.arg("--out").arg(out));
        Self::of(command)
    }

    fn of(mut command: Command) -> Self {
        let child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn();
        Self(Some(child.expect("the binary starts")))
    }

    fn signal(&self, name: &str) {
        let id = self.0.as_ref().expect("running").id().to_string();
        let sent = Command::new("kill").args([name, &id]).status();
        assert!(sent.expect("kill is there").success());
    }

    fn end(mut self) -> Output {
        let child = self.0.take().expect("running");
        child.wait_with_output().expect("the binary ends")
    }
}

fn wait_for(path: &Path) {
    let began = Instant::now();
    while !path.exists() {
        assert!(
            began.elapsed() < Duration::from_secs(60),
            "{}",
            path.display()
        );
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// The results without what differs between any two runs: wall times.
fn results(folder: &Path) -> (Value, Vec<String>) {
    let mut outcome = json_file(&folder.join("outcome.json"));
    for key in ["wall_s", "point_steps_per_s"] {
        outcome["cost"][key] = Value::Null;
    }
    outcome["accuracy"] = Value::Null;
    let names = ["trajectory-0.json", "motion.svg", "aerial.svg"];
    let files = names.map(|name| fs::read_to_string(folder.join(name)).expect(name));
    (outcome, files.to_vec())
}

fn uninterrupted(scene: &Scene) -> (Value, Vec<String>) {
    let out = scene.path("uninterrupted");
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    results(&out)
}

fn resume(folder: &Path) -> (Value, Vec<String>) {
    let answer = ask(&[&"run", &"--resume", &folder]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    assert!(answer.stdout.contains("written to"), "{}", answer.stdout);
    assert!(!folder.join(".scree-partial").exists());
    results(folder)
}

/// Interrupted twice, by Ctrl-C and SIGTERM, beside an earlier run's results.
#[test]
fn a_stopped_run_is_resumed_to_the_same_bits() {
    let scene = Scene::new(&long());
    let out = scene.path("results");
    fs::create_dir(&out).unwrap();
    for name in ["outcome.json", "trajectory-7.json", "notes.json"] {
        fs::write(out.join(name), "{}").unwrap();
    }
    let running = Running::start(&scene, Some(&out));
    wait_for(&out.join(".scree-partial/state"));
    running.signal("-INT");
    let ended = running.end();
    let stderr = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(130), "{stderr}");
    assert!(ended.stdout.is_empty());
    assert!(stderr.contains("stopped by Ctrl-C"), "{stderr}");
    let how = format!("`scree run --resume {}`", out.display());
    assert!(stderr.contains(&how), "{stderr}");
    for name in ["outcome.json", "trajectory-7.json"] {
        assert_eq!(fs::read_to_string(out.join(name)).unwrap(), "{}");
    }

    let mut command = scree();
    command.arg("run").arg("--resume").arg(&out);
    let running = Running::of(command);
    std::thread::sleep(Duration::from_millis(300));
    running.signal("-TERM");
    let ended = running.end();
    let stderr = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(143), "{stderr}");

    assert_eq!(resume(&out), uninterrupted(&scene));
    assert!(!out.join("trajectory-7.json").exists());
    assert_eq!(fs::read_to_string(out.join("notes.json")).unwrap(), "{}");
    let again = ask(&[&"run", &"--resume", &out]);
    assert_eq!(again.code, Some(2));
    assert!(
        again.stderr.contains("no interrupted run"),
        "{}",
        again.stderr
    );
}

/// Killed without a chance to save anything: the state saved before is enough, and the lock
/// file that is left locks nobody out.
#[test]
fn a_killed_study_is_resumed_to_the_same_bits() {
    let mut scenario = long();
    scenario["accuracy"] = json!({"error_bars": true});
    let scene = Scene::new(&scenario);
    let out = scene.path("results");
    let running = Running::start(&scene, Some(&out));
    wait_for(&out.join(".scree-partial/state"));
    running.signal("-KILL");
    assert_eq!(running.end().status.code(), None);
    let refused = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
    assert!(refused.stderr.contains("--resume"), "{}", refused.stderr);
    assert_eq!(resume(&out), uninterrupted(&scene));
}

#[test]
fn a_run_that_is_killed_at_its_start_begins_anew() {
    let scene = Scene::new(&long());
    let out = scene.path("results");
    let running = Running::start(&scene, Some(&out));
    wait_for(&out.join(".scree-partial/scenario.json"));
    running.signal("-KILL");
    running.end();
    assert!(
        !out.join(".scree-partial/state").exists(),
        "a state so soon"
    );
    assert_eq!(resume(&out), uninterrupted(&scene));
}

/// Formats are those that the run was begun with, unless others are asked for.
#[test]
fn a_resumed_run_writes_the_formats_asked_for() {
    let scene = Scene::new(&long());
    for (other, expected) in [(None, "csv"), (Some("ndjson"), "ndjson")] {
        let out = scene.path(expected);
        let mut command = scree();
        command.arg("run").arg(scene.file()).arg("--out").arg(&out);
        command.args(["--format", "csv"]);
        let running = Running::of(command);
        wait_for(&out.join(".scree-partial/state"));
        running.signal("-TERM");
        assert_eq!(running.end().status.code(), Some(143));

        let mut command = scree();
        command.arg("run").arg("--resume").arg(&out);
        command.args(other.iter().flat_map(|other| ["--format", *other]));
        let ended = Running::of(command).end();
        let stderr = String::from_utf8_lossy(&ended.stderr);
        assert_eq!(ended.status.code(), Some(0), "{stderr}");
        let names = ["json", "ndjson", "csv", "npz"].map(|format| format!("trajectory-0.{format}"));
        let there: Vec<_> = names
            .iter()
            .filter(|name| out.join(name).exists())
            .collect();
        assert_eq!(there, [&format!("trajectory-0.{expected}")]);
    }
}

/// A disk that has space for the state, but not for the results: the last words tell how to
/// continue from the state. A limit on the size of files stands for the disk.
#[test]
fn a_disk_that_is_full_at_the_end_loses_only_the_end() {
    let mut scenario = long();
    scenario["sample_interval_s"] = json!(1e-4);
    scenario["numerics"]["ending"] = json!("full");
    let scene = Scene::new(&scenario);
    let out = scene.path("results");
    let script = format!(
        "trap '' XFSZ; ulimit -f {LIMIT_BLOCKS}; exec {} run {} --out {}",
        env!("CARGO_BIN_EXE_scree"),
        scene.file().display(),
        out.display()
    );
    let output = Command::new("sh").args(["-c", &script]).output().unwrap();
    let answer = Answer::from(output);
    assert_eq!(answer.code, Some(1), "{}", answer.stderr);
    for words in ["cannot write", "trajectory-0.json", "--resume", "too large"] {
        assert!(answer.stderr.contains(words), "{words}: {}", answer.stderr);
    }
    assert_eq!(resume(&out), uninterrupted(&scene));
}

#[test]
fn without_a_folder_ctrl_c_just_stops() {
    let mut scenario = long();
    scenario["duration_s"] = json!(30);
    let scene = Scene::new(&scenario);
    let running = Running::start(&scene, None);
    std::thread::sleep(Duration::from_millis(700));
    running.signal("-INT");
    let ended = running.end();
    let stderr = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(130), "{stderr}");
    assert!(ended.stdout.is_empty());
    assert!(stderr.contains("no --out was given"), "{stderr}");
}

/// Progress is plain lines where there is no terminal.
#[test]
fn progress_into_a_pipe_is_lines_with_share_time_and_remaining_time() {
    let mut scenario = long();
    scenario["duration_s"] = json!(2);
    let scene = Scene::new(&scenario);
    let mut running = Running::start(&scene, None);
    let stderr = running.0.as_mut().unwrap().stderr.take().unwrap();
    let mut line = String::new();
    BufReader::new(stderr).read_line(&mut line).unwrap();
    running.signal("-INT");
    assert_eq!(running.end().status.code(), Some(130));
    for words in [" %  t = ", " s, ", "min to go\n"] {
        assert!(line.contains(words), "{words}: {line}");
    }
    assert!(line.chars().all(|c| c == '\n' || !c.is_control()), "{line}");
}

/// While a run goes on, nobody else may use its folder; a second Ctrl-C ends it at once.
#[test]
fn a_folder_in_use_is_refused() {
    let mut scenario = long();
    scenario["duration_s"] = json!(30);
    let scene = Scene::new(&scenario);
    let out = scene.path("results");
    let running = Running::start(&scene, Some(&out));
    wait_for(&out.join(".scree-partial/state"));
    let whole = format!("{} is in use by another run", out.display());
    for arguments in [
        &[
            &"run" as &dyn AsRef<std::ffi::OsStr>,
            &scene.file(),
            &"--out",
            &out,
        ][..],
        &[&"run", &"--resume", &out],
        &[&"demo", &"--out", &out],
    ] {
        let refused = ask(arguments);
        assert_eq!((refused.code, refused.stdout.as_str()), (Some(1), ""));
        assert!(refused.stderr.contains(&whole), "{}", refused.stderr);
    }
    running.signal("-INT");
    running.signal("-INT");
    assert_eq!(running.end().status.code(), Some(130));
}

/// Interrupts a run, changes its saved files and tries to resume it.
#[test]
fn what_cannot_be_resumed_is_refused_with_the_reason() {
    let scene = Scene::new(&long());
    let out = scene.path("results");
    let running = Running::start(&scene, Some(&out));
    let partial = out.join(".scree-partial");
    wait_for(&partial.join("state"));
    running.signal("-TERM");
    assert_eq!(running.end().status.code(), Some(143));

    let refused_with = |name: &str, change: &dyn Fn(&mut Vec<u8>), reason: &str| {
        let path = partial.join(name);
        let sound = fs::read(&path).unwrap();
        let mut changed = sound.clone();
        change(&mut changed);
        fs::write(&path, changed).unwrap();
        let answer = ask(&[&"run", &"--resume", &out]);
        assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
        assert!(
            answer.stderr.contains(reason),
            "{reason}: {}",
            answer.stderr
        );
        assert!(
            answer.stderr.contains(".scree-partial"),
            "{}",
            answer.stderr
        );
        fs::write(&path, sound).unwrap();
    };
    let other_commit = |bytes: &mut Vec<u8>| {
        let key = b"\"commit\":\"";
        let place = bytes.windows(key.len()).position(|part| part == key);
        bytes[place.unwrap() + key.len()] = b'x';
    };
    refused_with("state", &other_commit, "of commit x");
    let longer = |bytes: &mut Vec<u8>| bytes.push(b' ');
    refused_with("scenario.json", &longer, "is not the scenario");
    let damage = |bytes: &mut Vec<u8>| *bytes.last_mut().unwrap() ^= 1;
    refused_with("state", &damage, "state is damaged");
    let cut = |bytes: &mut Vec<u8>| bytes.truncate(bytes.len() - 1);
    refused_with("records", &cut, "records is damaged");
    // Records after the state are those of an attempt that was cut off.
    let mut records = fs::read(partial.join("records")).unwrap();
    records.extend(b"cut off");
    fs::write(partial.join("records"), records).unwrap();
    assert_eq!(resume(&out), uninterrupted(&scene));
}

/// A run that was killed while its files were moved: they are whole, and are moved now.
#[test]
fn a_run_that_was_killed_at_its_very_end_is_delivered() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let whole = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(whole.code, Some(0), "{}", whole.stderr);
    let new = out.join(".scree-partial/new");
    fs::create_dir_all(&new).unwrap();
    for name in ["aerial.svg", "outcome.json"] {
        fs::rename(out.join(name), new.join(name)).unwrap();
    }
    let names = [
        "trajectory-0.json",
        "motion.svg",
        "aerial.svg",
        "outcome.json",
    ];
    let list = json!({"place": "Whole", "files": names}).to_string();
    fs::write(out.join(".scree-partial/new.json"), list).unwrap();
    let answer = ask(&[&"run", &"--resume", &out, &"--json"]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    let outcome: Value = serde_json::from_str(&answer.stdout).unwrap();
    assert_eq!(outcome, json_file(&out.join("outcome.json")));
    assert!(names.iter().all(|name| out.join(name).exists()));
    assert!(!out.join(".scree-partial").exists());
}
