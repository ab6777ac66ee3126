//! `scree demo`: all the way through a service and back.

use crate::command::{Answer, Scene, ask, json_file, tiny, unstable};

/// The results through HTTP, queue, worker and database equal those computed directly,
/// bit by bit.
#[test]
fn the_service_gives_what_a_local_run_gives() {
    let scene = Scene::new(&tiny());
    let (served, local) = (scene.path("served"), scene.path("local"));
    let answer = ask(&[&"demo", &"--scenario", &scene.file(), &"--out", &served]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    assert!(
        answer.stderr.contains("service on http://127.0.0.1:"),
        "{}",
        answer.stderr
    );
    for word in [
        "onset",
        "conservation",
        "trajectory-0.json",
        "motion.svg",
        "aerial.svg",
    ] {
        assert!(answer.stdout.contains(word), "{word}: {}", answer.stdout);
    }
    let answer = ask(&[&"run", &scene.file(), &"--out", &local, &"--threads", &"1"]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);

    let both = |name: &str| [&served, &local].map(|directory| directory.join(name));
    let [outcome, expected] = both("outcome.json").map(|path| json_file(&path));
    for part in ["bodies", "flow", "conservation"] {
        assert_eq!(outcome[part], expected[part], "{part}");
    }
    let [trajectory, expected] = both("trajectory-0.json").map(|path| json_file(&path));
    assert!(trajectory["job_id"].is_string());
    assert_eq!(trajectory["columns"], expected["columns"]);
    for name in ["motion.svg", "aerial.svg"] {
        let [picture, expected] = both(name).map(|path| std::fs::read_to_string(path).unwrap());
        assert!(picture == expected, "{name} differs");
    }
}

/// Quiet or not, errors are told.
#[test]
fn a_quiet_demo_tells_only_of_errors() {
    let (good, bad) = (Scene::new(&tiny()), Scene::new(&unstable()));
    for (scene, code) in [(&good, 0), (&bad, 3)] {
        let (file, out) = (scene.file(), scene.path("results"));
        let answer = ask(&[&"demo", &"-q", &"--scenario", &file, &"--out", &out]);
        assert_eq!(answer.code, Some(code), "{}", answer.stderr);
        assert_eq!(answer.stderr.is_empty(), code == 0, "{}", answer.stderr);
        assert!(!answer.stderr.contains("service on"), "{}", answer.stderr);
    }
}

/// Runs the demo on another scene, with the results beside the scene's file.
fn demo_of(scene: &Scene) -> Answer {
    let (file, out) = (scene.file(), scene.path("results"));
    ask(&[&"demo", &"--scenario", &file, &"--out", &out])
}

#[test]
fn an_illegal_scenario_is_told_without_a_service() {
    let scene = Scene::new(&serde_json::json!({"channel": {}}));
    let answer = demo_of(&scene);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("/channel"), "{}", answer.stderr);
    assert!(!answer.stderr.contains("service on"), "{}", answer.stderr);
}

#[test]
fn a_numerical_failure_has_its_own_exit_code() {
    let scene = Scene::new(&unstable());
    let answer = demo_of(&scene);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(3), ""));
    assert!(answer.stderr.contains("error: t = "), "{}", answer.stderr);
}

#[test]
fn a_scene_beyond_the_point_limit_is_invalid_input() {
    let mut scenario = tiny();
    scenario["numerics"]["cell_size_m"] = serde_json::json!(1e-4);
    let scene = Scene::new(&scenario);
    let answer = demo_of(&scene);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("cell_size_m"), "{}", answer.stderr);
}
