//! `scree serve`.

use crate::command::{Scene, ask, scree, tiny};
use std::io::{BufRead, BufReader};
use std::process::Stdio;
#[cfg(unix)]
use {
    crate::command::Served,
    std::io::{Read, Write},
    std::net::TcpStream,
    std::process::Command,
};

#[cfg(unix)]
#[test]
fn it_tells_its_address_answers_and_stops_when_asked() {
    let scene = Scene::new(&tiny());
    let mut served = Served::start(&scene.path("test.db"), Stdio::piped());

    let mut stream = TcpStream::connect(&served.address).unwrap();
    write!(
        stream,
        "GET /healthz HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
        served.address
    )
    .unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");

    let id = served.child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(served.child.wait().unwrap().code(), Some(0));
    let mut log = String::new();
    let stderr = served.child.stderr.as_mut().unwrap();
    stderr.read_to_string(&mut log).unwrap();
    assert!(log.contains("/healthz"), "{log}");
    assert!(
        !log.contains('\u{1b}'),
        "colours in a log that is no terminal"
    );
    assert!(scene.path("test.db").is_file());
}

#[cfg(unix)]
#[test]
fn it_goes_on_and_stops_in_order_if_nobody_reads_its_log() {
    let scene = Scene::new(&tiny());
    let mut served = Served::start(&scene.path("test.db"), Stdio::piped());
    drop(served.child.stderr.take());

    for _ in 0..3 {
        let mut stream = TcpStream::connect(&served.address).unwrap();
        write!(stream, "GET /healthz HTTP/1.0\r\n\r\n").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        assert!(answer.contains(" 200 "), "{answer}");
    }
    let id = served.child.id().to_string();
    let killed = Command::new("kill").args(["-TERM", &id]).status().unwrap();
    assert!(killed.success());
    assert_eq!(served.child.wait().unwrap().code(), Some(0));
}

#[test]
fn it_ends_with_the_input_of_the_program_that_started_it() {
    let scene = Scene::new(&tiny());
    let mut service = scree()
        // The Python package's, which is no key of the configuration.
        .env("SCREE_BINARY", "scree")
        .args(["serve", "--until-stdin-ends", "--listen", "127.0.0.1:0"])
        .arg("--database")
        .arg(scene.path("test.db"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let mut line = String::new();
    let mut stdout = BufReader::new(service.stdout.take().unwrap());
    stdout.read_line(&mut line).unwrap();
    assert!(line.starts_with("listening on http://127.0.0.1:"), "{line}");
    assert!(service.try_wait().unwrap().is_none());

    drop(service.stdin.take());
    assert_eq!(service.wait().unwrap().code(), Some(0));
}

#[test]
fn an_address_beyond_loopback_is_refused() {
    let scene = Scene::new(&tiny());
    let database = scene.path("test.db");
    let answer = ask(&[
        &"serve",
        &"--listen",
        &"0.0.0.0:0",
        &"--database",
        &database,
    ]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(answer.stderr.contains("loopback"), "{}", answer.stderr);
}

#[test]
fn a_configuration_that_is_not_there_is_invalid_input() {
    let answer = ask(&[&"serve", &"--config", &"no-such-file.toml"]);
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
    assert!(
        answer.stderr.contains("no-such-file.toml"),
        "{}",
        answer.stderr
    );
}
