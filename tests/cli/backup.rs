//! `scree backup`.

use crate::command::{Scene, Served, ask, tiny};
use std::fs;
use std::process::Stdio;

#[test]
fn it_copies_the_database_of_a_running_service_and_says_what_is_in_it() {
    let scene = Scene::new(&tiny());
    let database = scene.path("test.db");
    let _served = Served::start(&database, Stdio::null());

    let copy = scene.path("copy.db");
    let answer = ask(&[&"backup", &"--database", &database, &copy]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    assert!(answer.stdout.contains("0 jobs"), "{}", answer.stdout);
    assert!(fs::metadata(&copy).unwrap().len() > 0);
    let again = ask(&[&"backup", &"--database", &database, &copy]);
    assert_eq!(again.code, Some(2), "{}", again.stdout);
    assert!(again.stderr.contains("--replace"), "{}", again.stderr);
    let again = ask(&[&"backup", &"--replace", &"--database", &database, &copy]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
}

#[test]
fn it_makes_no_backup_of_what_is_no_database() {
    let scene = Scene::new(&tiny());
    let copy = scene.path("copy.db");
    let text = scene.path("text.db");
    fs::write(&text, "not a database. ".repeat(512)).unwrap();
    for (database, code, reason) in [
        (scene.path("no.db"), 2, "not found"),
        (text, 1, "not a database"),
    ] {
        let answer = ask(&[&"backup", &"--database", &database, &copy]);
        assert_eq!(answer.code, Some(code), "{}", answer.stderr);
        assert!(answer.stderr.contains(reason), "{}", answer.stderr);
        assert!(!copy.exists());
    }
}
