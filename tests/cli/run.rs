//! `scree run`.

use crate::command::{Answer, Scene, ask, ask_with_input, json_file, scree, tiny, unstable};
use serde_json::{Value, json};
use std::process::Stdio;

#[test]
fn a_run_leaves_outcome_trajectories_and_pictures() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results/first");
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    for word in [
        "onset",
        "peak",
        "rest from",
        "conservation",
        "cost",
        "outcome.json",
        "aerial.svg",
    ] {
        assert!(answer.stdout.contains(word), "{word}: {}", answer.stdout);
    }
    let outcome = json_file(&out.join("outcome.json"));
    assert_eq!(outcome["bodies"].as_array().unwrap().len(), 1);
    assert_eq!(outcome["conservation"]["points_lost"], 0);

    let trajectory = json_file(&out.join("trajectory-0.json"));
    assert_eq!(
        (&trajectory["job_id"], &trajectory["body"]),
        (&Value::Null, &json!(0))
    );
    let times = trajectory["columns"]["time_s"].as_array().unwrap();
    // 0.1 s every 0.01 s, both ends.
    assert_eq!(times.len(), 11);
    assert_eq!((&times[0], &times[10]), (&json!(0.0), &json!(0.1)));

    for name in ["motion.svg", "aerial.svg"] {
        let svg = std::fs::read_to_string(out.join(name)).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        assert!(
            document
                .root_element()
                .has_tag_name(("http://www.w3.org/2000/svg", "svg"))
        );
    }
}

#[test]
fn with_json_the_outcome_stands_alone_on_standard_output() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let answer = ask(&[
        &"run",
        &scene.file(),
        &"--json",
        &"--out",
        &out,
        &"--threads",
        &"1",
    ]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    let outcome: Value = serde_json::from_str(&answer.stdout).unwrap();
    assert_eq!(outcome, json_file(&out.join("outcome.json")));
    assert_eq!(outcome["cost"]["threads"], 1);
    assert_eq!(outcome["cost"]["cell_size_m"], 0.01);
}

#[test]
fn a_scene_without_flow_or_bodies_runs() {
    let mut still = tiny();
    still["flow"] = Value::Null;
    let mut bare = tiny();
    bare["bodies"] = json!([]);
    for scenario in [still, bare] {
        let scene = Scene::new(&scenario);
        let out = scene.path("results");
        let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
        assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
        assert!(out.join("motion.svg").is_file() && out.join("aerial.svg").is_file());
    }
}

#[test]
fn an_illegal_scenario_makes_no_files() {
    let mut scenario = tiny();
    scenario["flow"]["volume_m3"] = json!(100);
    let scene = Scene::new(&scenario);
    let out = scene.path("results");
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("/flow"), "{}", answer.stderr);
    assert!(!out.exists());
}

#[test]
fn a_directory_that_cannot_be_made_is_told_before_computing() {
    let scene = Scene::new(&tiny());
    // A file is at the path of the directory.
    let answer = ask(&[&"run", &scene.file(), &"--out", &scene.file()]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("scenario.json"), "{}", answer.stderr);
}

#[test]
fn a_scene_beyond_the_point_limit_is_invalid_input() {
    let mut scenario = tiny();
    scenario["numerics"]["cell_size_m"] = json!(1e-4);
    let answer = ask_with_input(&["run", "-"], &scenario.to_string());
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("cell_size_m"), "{}", answer.stderr);
}

#[test]
fn a_numerical_failure_has_its_own_exit_code_and_keeps_what_there_is() {
    let scene = Scene::new(&unstable());
    let out = scene.path("results");
    let failed = out.join("failed");
    // An earlier run's outcome must not remain beside this one's trajectory;
    // the user's own files stay.
    std::fs::create_dir_all(&failed).unwrap();
    for name in ["trajectory-7.json", "notes.json"] {
        std::fs::write(failed.join(name), "{}").unwrap();
    }
    let answer = ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(3), ""));
    assert!(answer.stderr.contains("t = "), "{}", answer.stderr);
    let place = failed.display().to_string();
    assert!(answer.stderr.contains(&place), "{}", answer.stderr);
    assert!(!answer.stderr.contains("earlier"), "{}", answer.stderr);
    let trajectory = json_file(&failed.join("trajectory-0.json"));
    assert!(trajectory["columns"]["time_s"].as_array().unwrap().len() > 1);
    assert!(!out.join("outcome.json").exists());
    assert!(!failed.join("trajectory-7.json").exists());
    assert!(failed.join("notes.json").exists());
    assert!(!out.join(".scree-partial").exists());
}

#[test]
fn an_earlier_result_outlives_a_failure_until_the_next_result_is_whole() {
    let (scene, bad) = (Scene::new(&tiny()), Scene::new(&unstable()));
    let out = scene.path("results");
    let run = |scene: &Scene| ask(&[&"run", &scene.file(), &"--out", &out]);
    assert_eq!(run(&scene).code, Some(0));
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let names = [
        "outcome.json",
        "trajectory-0.json",
        "motion.svg",
        "aerial.svg",
    ];
    let earlier = names.map(read);

    let answer = run(&bad);
    assert_eq!(answer.code, Some(3));
    let said = "still has the results of an earlier run";
    assert!(answer.stderr.contains(said), "{}", answer.stderr);
    assert_eq!(names.map(read), earlier);
    assert!(out.join("failed/trajectory-1.json").exists());

    assert_eq!(run(&scene).code, Some(0));
    assert_ne!(names.map(read), earlier, "wall times differ");
    assert!(!out.join("failed").exists());
}

/// A limit on the size of files stands for a full disk: writing fails in the middle of a file.
#[cfg(unix)]
#[test]
fn a_full_disk_names_the_file_and_spares_the_earlier_result() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    std::fs::create_dir(&out).unwrap();
    std::fs::write(out.join("outcome.json"), "earlier").unwrap();
    let script = format!(
        "trap '' XFSZ; ulimit -f 6; exec {} run {} --out {}",
        env!("CARGO_BIN_EXE_scree"),
        scene.file().display(),
        out.display()
    );
    let mut command = std::process::Command::new("sh");
    let answer = Answer::from(command.args(["-c", &script]).output().unwrap());
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(1), ""));
    for words in ["cannot write", "trajectory-0.json", "too large"] {
        assert!(answer.stderr.contains(words), "{words}: {}", answer.stderr);
    }
    let kept = std::fs::read_to_string(out.join("outcome.json")).unwrap();
    assert_eq!(kept, "earlier");
    assert!(!out.join("trajectory-0.json").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_told() {
    let scene = Scene::new(&tiny());
    let full = std::fs::File::options().write(true).open("/dev/full");
    let mut command = scree();
    command.arg("run").arg(scene.file()).arg("--json");
    let answer = Answer::from(command.stdout(full.unwrap()).output().unwrap());
    assert_eq!(answer.code, Some(1));
    let reason = "cannot write standard output: No space left on device";
    assert!(answer.stderr.contains(reason), "{}", answer.stderr);
}

/// A reader that left has lost the outcome if it is nowhere else.
#[test]
fn an_outcome_that_nobody_reads_is_an_error_unless_it_is_in_a_file() {
    let scene = Scene::new(&tiny());
    let out = scene.path("results");
    let unread = |arguments: &[&dyn AsRef<std::ffi::OsStr>]| {
        let mut command = scree();
        command.arg("run").arg(scene.file());
        command.args(arguments.iter().map(|argument| argument.as_ref()));
        let pipes = command.stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = pipes.spawn().unwrap();
        drop(child.stdout.take());
        Answer::from(child.wait_with_output().unwrap())
    };
    let answer = unread(&[]);
    assert_eq!(answer.code, Some(1));
    let reason = "cannot write standard output: Broken pipe";
    assert!(answer.stderr.contains(reason), "{}", answer.stderr);
    assert_eq!(unread(&[&"--out", &out]).code, Some(0));
    assert!(out.join("outcome.json").exists());
}

#[cfg(unix)]
#[test]
fn results_go_into_no_file_and_no_link_to_nowhere() {
    let scene = Scene::new(&tiny());
    let link = scene.path("link");
    std::os::unix::fs::symlink("nowhere", &link).unwrap();
    let refused = ask(&[&"run", &scene.file(), &"--out", &link]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(
        refused.stderr.contains("link is a link to nowhere"),
        "{}",
        refused.stderr
    );
    let refused = ask(&[&"run", &scene.file(), &"--out", &scene.file()]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("is a file"), "{}", refused.stderr);
}
