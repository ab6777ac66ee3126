//! `scree verify`.

use crate::command::ask;
use serde_json::Value;

#[test]
fn a_case_that_holds_is_no_failure() {
    let answer = ask(&[&"verify", &"--case", &"mass", &"--json"]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    let report: Value = serde_json::from_str(&answer.stdout).unwrap();
    assert!(report["machine"]["cores"].as_u64() >= Some(1));
    assert_eq!(report["count"]["failed"], 0);
    let [case] = &report["cases"].as_array().unwrap()[..] else {
        panic!("one case was asked for");
    };
    assert_eq!(case["case"]["number"], "2");
    assert_eq!(case["case"]["not_yet_expressible"], Value::Null);
    for value in case["found"]["values"].as_array().unwrap() {
        assert_eq!(value["verdict"], "pass");
        assert!(value["measured"].is_f64() && value["reference"].is_f64());
        assert!(value["cost"]["wall_s"].as_f64() >= Some(0.0));
    }
}

// Known failure: the shallow theory of the dam break is not exact for a flow in three
// dimensions.
#[test]
fn a_case_that_misses_is_shown_and_told_by_the_exit_code() {
    let answer = ask(&[&"verify", &"--case", &"dam-break"]);
    assert_eq!(answer.code, Some(4));
    assert!(answer.stderr.contains("failed"), "{}", answer.stderr);
    for words in ["reference", "verdict", "pass", "FAIL", "reported only"] {
        assert!(answer.stdout.contains(words), "{}", answer.stdout);
    }
}

#[test]
fn an_unknown_case_is_invalid_input() {
    let answer = ask(&[&"verify", &"--case", &"perpetual-motion"]);
    assert_eq!(answer.code, Some(2));
    assert!(answer.stderr.contains("free-fall"), "{}", answer.stderr);
}

#[test]
fn tables_go_between_the_marks_of_a_document() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("accuracy.md");
    let marked = "# A\n<!-- tables of scree verify: begin -->\nold\n\
                  <!-- tables of scree verify: end -->\nB\n";
    std::fs::write(&file, marked).unwrap();
    let asked = || ask(&[&"verify", &"--case", &"mass", &"--markdown", &file]);
    assert_eq!(asked().code, Some(0));
    let text = std::fs::read_to_string(&file).unwrap();
    assert!(
        text.starts_with("# A\n") && text.ends_with("\nB\n"),
        "{text}"
    );
    assert!(text.contains("| pass |") && !text.contains("old"), "{text}");
    std::fs::write(&file, "no marks").unwrap();
    assert_eq!(asked().code, Some(1));
}
