//! `scree serve`.

use crate::command::{Scene, ask, scree, tiny};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

/// A service that is killed if the test fails before it has stopped it.
struct Served(Child);

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[cfg(unix)]
#[test]
fn it_tells_its_address_answers_and_stops_when_asked() {
    let scene = Scene::new(&tiny());
    let child = scree()
        .args(["serve", "--listen", "127.0.0.1:0", "--database"])
        .arg(scene.path("test.db"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut served = Served(child);
    let mut line = String::new();
    let stdout = served.0.stdout.take().unwrap();
    BufReader::new(stdout).read_line(&mut line).unwrap();
    let address = line
        .trim()
        .strip_prefix("listening on http://")
        .expect("the address")
        .to_owned();

    let mut stream = TcpStream::connect(&address).unwrap();
    write!(
        stream,
        "GET /healthz HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n"
    )
    .unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");

    let id = served.0.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(served.0.wait().unwrap().code(), Some(0));
    let mut log = String::new();
    let stderr = served.0.stderr.as_mut().unwrap();
    stderr.read_to_string(&mut log).unwrap();
    assert!(log.contains("/healthz"), "{log}");
    assert!(
        !log.contains('\u{1b}'),
        "colours in a log that is no terminal"
    );
    assert!(scene.path("test.db").is_file());
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
