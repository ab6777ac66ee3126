//! Arguments: help, version, and invalid arguments.

use crate::command::{ask, scree};
use std::process::Stdio;

#[test]
fn help_and_version_are_answers() {
    let help = ask(&[&"--help"]);
    assert_eq!(help.code, Some(0));
    for command in [
        "serve",
        "backup",
        "run",
        "study",
        "submit",
        "watch",
        "get",
        "dismiss",
        "plan",
        "validate",
        "terrain",
        "demo",
        "bench",
        "verify",
        "Exit codes",
    ] {
        assert!(help.stdout.contains(command), "{command}: {}", help.stdout);
    }
    let version = ask(&[&"--version"]);
    let start = concat!("scree ", env!("CARGO_PKG_VERSION"), " (");
    assert!(version.stdout.starts_with(start), "{}", version.stdout);
    assert!(version.stdout.len() > start.len() + 6, "{}", version.stdout);
}

#[test]
fn shells_and_manuals_learn_the_command_line() {
    for shell in ["bash", "zsh", "fish"] {
        let script = ask(&[&"completions", &shell]);
        assert_eq!((script.code, script.stderr.as_str()), (Some(0), ""));
        for word in ["validate", "resume", "token-file", "format", "quiet"] {
            assert!(script.stdout.contains(word), "{shell}: {word}");
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("man");
    let answer = ask(&[&"man", &pages]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    for name in [
        "scree.1",
        "scree-run.1",
        "scree-serve.1",
        "scree-terrain-put.1",
    ] {
        let page = std::fs::read_to_string(pages.join(name)).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
    }
}

#[test]
fn arguments_not_understood_are_invalid_input() {
    let wrong: [&[&dyn AsRef<std::ffi::OsStr>]; 11] = [
        &[],
        &[&"simulate"],
        &[&"run"],
        &[&"run", &"a.json", &"--threads", &"0"],
        &[&"run", &"a.json", &"--format", &"csv"],
        &[&"run", &"a.json", &"--out", &"b", &"--format", &"xls"],
        &[&"submit"],
        &[&"get", &"--out", &"b"],
        &[
            &"study",
            &"a.json",
            &"--url",
            &"http://a",
            &"--threads",
            &"1",
        ],
        &[&"serve", &"--listen", &"somewhere"],
        &[&"bench", &"--only", &"s300k"],
    ];
    for arguments in wrong {
        let answer = ask(arguments);
        assert_eq!(answer.code, Some(2), "{}", answer.stderr);
        assert_eq!(answer.stdout, "");
        assert!(answer.stderr.contains("Usage") || answer.stderr.contains("--help"));
    }
}

/// `scree … | head -0`: the reader is closed before the first byte. Rust's own
/// `println!` panics in this case.
#[test]
fn a_reader_that_left_is_no_error() {
    let mut child = scree()
        .args(["validate", "-"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().unwrap();
    std::io::Write::write_all(&mut stdin, crate::command::tiny().to_string().as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
}
