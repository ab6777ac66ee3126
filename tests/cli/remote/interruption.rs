//! Answers that are lost, services that restart, and commands that are stopped.

use super::{Remote, at};
use crate::command::tiny;
use std::io::{Read, Write};
use std::net::{TcpListener, TcpStream};
use std::thread::{self, JoinHandle};
#[cfg(unix)]
use {
    crate::command::{Served, long, scree},
    crate::study::study,
    std::io::{BufRead, BufReader},
    std::process::{Child, Command, Stdio},
};

/// A proxy that hands on so many requests to the service, of which it loses the answers to the
/// first ones. Each request has a connection of its own.
fn losing_proxy(service: &str, requests: usize, lost: usize) -> (String, JoinHandle<()>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", listener.local_addr().unwrap());
    let service = service.to_owned();
    let proxy = thread::spawn(move || {
        for place in 0..requests {
            let (mut client, _) = listener.accept().unwrap();
            let mut upstream = TcpStream::connect(&service).unwrap();
            let request = request(&mut client);
            upstream.write_all(&request).unwrap();
            // The service ends the connection after the answer, so that all of it is here.
            let mut answer = Vec::new();
            upstream.read_to_end(&mut answer).unwrap();
            if place >= lost {
                client.write_all(&answer).unwrap();
            }
        }
    });
    (url, proxy)
}

/// A request with its body, which asks for the connection to be ended after the answer.
fn request(client: &mut TcpStream) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut piece = [0; 4096];
    loop {
        let length = client.read(&mut piece).unwrap();
        bytes.extend_from_slice(&piece[..length]);
        let text = String::from_utf8_lossy(&bytes).into_owned();
        if let Some((head, body)) = text.split_once("\r\n\r\n") {
            let named = |line: &str| {
                let (name, value) = line.split_once(": ")?;
                name.eq_ignore_ascii_case("content-length")
                    .then(|| value.parse::<usize>().unwrap())
            };
            if body.len() == head.lines().find_map(named).unwrap_or(0) {
                let head = head.replacen("\r\n", "\r\nConnection: close\r\n", 1);
                return format!("{head}\r\n\r\n{body}").into_bytes();
            }
        }
        assert!(length > 0, "the request is cut off: {text}");
    }
}

#[test]
fn a_lost_answer_makes_no_second_job() {
    let remote = Remote::new(&tiny());
    let (url, proxy) = losing_proxy(&remote.served.address, 3, 2);
    let file = remote.scene.file();
    let answer = at(&url, &["submit", file.to_str().unwrap()]);
    proxy.join().unwrap();
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    assert_eq!(answer.stderr.matches("trying again").count(), 1);
    let jobs = remote.jobs();
    assert_eq!(jobs.len(), 1);
    assert_eq!(jobs[0]["id"], answer.stdout.trim());
}

#[test]
fn an_answer_that_stays_away_may_be_that_of_a_job() {
    let remote = Remote::new(&tiny());
    // Then nobody listens any more.
    let (url, proxy) = losing_proxy(&remote.served.address, 1, 1);
    let file = remote.scene.file();
    let words = ["submit", file.to_str().unwrap(), "--patience", "1"];
    let answer = at(&url, &words);
    proxy.join().unwrap();
    assert_eq!((answer.code, answer.stdout.as_str()), (Some(1), ""));
    assert!(
        answer.stderr.contains("may have been accepted"),
        "{}",
        answer.stderr
    );
    assert_eq!(remote.jobs().len(), 1);
}

#[test]
fn a_service_without_room_is_asked_again_when_it_says() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", listener.local_addr().unwrap());
    let answers = ["429 Too Many Requests\r\nRetry-After: 1", "200 OK"];
    let service = thread::spawn(move || {
        let came = answers.map(|answer| {
            let (mut client, _) = listener.accept().unwrap();
            request(&mut client);
            let body = "{\"jobs\": []}";
            let length = body.len();
            write!(
                client,
                "HTTP/1.1 {answer}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n{body}"
            )
            .unwrap();
            std::time::Instant::now()
        });
        came[1] - came[0]
    });
    let answer = at(&url, &["get"]);
    assert_eq!(answer.code, Some(0), "{}", answer.stderr);
    assert!(service.join().unwrap().as_secs_f64() >= 0.99);
}

/// A command that is killed if the test fails before it has ended.
#[cfg(unix)]
struct Running(Child);

#[cfg(unix)]
impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[cfg(unix)]
impl Running {
    fn start(url: &str, words: &[&str]) -> Self {
        let mut command = scree();
        command.args(words).env("SCREE_URL", url);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        Self(command.spawn().expect("the binary starts"))
    }

    /// Exit code, standard output, and what is left of standard error.
    fn end(mut self) -> (Option<i32>, String, String) {
        let texts = [
            read_all(self.0.stdout.take()),
            read_all(self.0.stderr.take()),
        ];
        let [stdout, stderr] = texts;
        (self.0.wait().unwrap().code(), stdout, stderr)
    }
}

#[cfg(unix)]
fn read_all(stream: Option<impl Read>) -> String {
    let mut text = String::new();
    if let Some(mut stream) = stream {
        stream.read_to_string(&mut text).unwrap();
    }
    text
}

#[cfg(unix)]
fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([name, &id]).status();
    assert!(sent.expect("kill is there").success());
}

#[cfg(unix)]
#[test]
fn a_job_is_watched_across_a_restart_of_the_service() {
    let mut remote = Remote::new(&long());
    let id = remote.submit(&[]);
    let mut watch = Running::start(&remote.url(), &["watch", &id]);
    while !remote.ask(&["get", &id]).stdout.contains("running") {
        assert!(watch.0.try_wait().unwrap().is_none());
    }
    signal(&remote.served.child, "-TERM");
    assert_eq!(remote.served.child.wait().unwrap().code(), Some(0));
    let mut lines = BufReader::new(watch.0.stderr.take().unwrap()).lines();
    let told = lines.find(|line| line.as_ref().unwrap().contains("trying again"));
    assert!(told.is_some());

    let address = remote.served.address.clone();
    let database = remote.scene.path("test.db");
    remote.served = Served::start_with(&["--listen", &address], &database, Stdio::null());
    let (code, stdout, _) = watch.end();
    let rest: Vec<_> = lines.map(Result::unwrap).collect();
    assert_eq!(code, Some(0), "{rest:?}");
    assert!(stdout.contains("conservation"), "{stdout}");
    assert!(!rest.join("\n").contains("trying again"), "{rest:?}");
}

#[cfg(unix)]
#[test]
fn a_command_that_is_stopped_leaves_the_job_running_until_it_is_dismissed() {
    let remote = Remote::new(&long());
    let file = remote.scene.file();
    let mut waiting = Running::start(
        &remote.url(),
        &["submit", file.to_str().unwrap(), "--wait", "--quiet"],
    );
    let mut id = String::new();
    let mut stdout = BufReader::new(waiting.0.stdout.take().unwrap());
    stdout.read_line(&mut id).unwrap();
    let id = id.trim();
    signal(&waiting.0, "-INT");
    let (code, _, stderr) = waiting.end();
    assert_eq!(code, Some(130), "{stderr}");
    assert!(stderr.contains(&format!("`scree watch {id}`")), "{stderr}");

    let status = |id: &str| remote.ask(&["get", id]).stdout;
    assert!(status(id).contains("running") || status(id).contains("waits"));
    let out = remote.scene.path("results");
    let early = remote.ask(&["get", id, "--out", out.to_str().unwrap()]);
    assert_eq!(early.code, Some(1), "{}", early.stderr);
    assert!(!out.exists());
    assert_eq!(remote.ask(&["dismiss", id]).code, Some(0));
    let watched = remote.ask(&["watch", id]);
    assert_eq!(watched.code, Some(1), "{}", watched.stderr);
    assert!(watched.stderr.contains("dismissed"), "{}", watched.stderr);
}

#[cfg(unix)]
#[test]
fn a_study_that_is_no_longer_followed_goes_on() {
    let mut study = study();
    study["scenario"] = long();
    let remote = Remote::new(&study);
    let (file, url) = (remote.scene.file(), remote.url());
    let words = ["study", file.to_str().unwrap(), "--url", &url];
    let mut following = Running::start(&url, &words);
    let mut stderr = BufReader::new(following.0.stderr.take().unwrap());
    let mut line = String::new();
    stderr.read_line(&mut line).unwrap();
    let id = line.trim().strip_prefix("study ").expect("an identifier");
    signal(&following.0, "-TERM");
    let (code, stdout, _) = following.end();
    let rest = read_all(Some(stderr));
    assert_eq!((code, stdout.as_str()), (Some(143), ""), "{rest}");
    let how = format!("`scree watch {id} --url {url}`");
    assert!(rest.contains(&how), "{rest}");

    let got = remote.ask(&["get", id]);
    assert!(got.stdout.starts_with("running, "), "{}", got.stdout);
    assert_eq!(remote.ask(&["dismiss", id]).code, Some(0));
    let got = remote.ask(&["get", id]);
    assert!(got.stdout.starts_with("dismissed, "), "{}", got.stdout);
}
