//! Work of one and of two worker processes on the members of a study.

use super::cluster::{Server, Worker};
use crate::client::{ask, get};
use crate::served::{Served, scene};
use crate::{at_length, tell};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

const SETTINGS: [(&str, &str); 1] = [("SCREE_WORKERS__COUNT", "0")];

fn study(members: usize, duration_s: f64) -> Value {
    json!({
        "scenario": scene(duration_s),
        "inputs": [{"pointer": "/channel/base_friction",
                    "distribution": {"uniform": {"from": 0.3, "to": 0.5}}}],
        "design": {"sobol": {"members": members, "seed": 1}},
        "questions": [],
    })
}

/// Elapsed time of a study with so many worker processes, and wall time of its members together.
fn run(server: &Server, workers: usize, members: usize, duration_s: f64) -> (f64, f64) {
    let place = server.place(&SETTINGS);
    let front = place.serve();
    let began = Instant::now();
    let workers: Vec<_> = (0..workers).map(|_| Worker::start(&place, &[])).collect();
    let document = study(members, duration_s).to_string();
    let answer = ask(&front.address, "POST", "/v1/studies", &document).expect("an answer");
    assert_eq!(answer.status, 202, "{}", answer.body);
    let path = format!("/v1/studies/{}", answer.body["id"].as_str().expect("an id"));
    // Seldom, so that the polls cost nothing.
    while get(&front.address, &path)["status"] != "successful" {
        assert!(began.elapsed() < Duration::from_secs(3_600));
        std::thread::sleep(Duration::from_millis(200));
    }
    let elapsed_s = began.elapsed().as_secs_f64();
    let wall_s = wall_time(&front, &path, members);
    drop(workers);
    (elapsed_s, wall_s)
}

fn wall_time(front: &Served, study: &str, members: usize) -> f64 {
    let pages = (0..members).step_by(1_000).map(|first| {
        let path = format!("{study}/members?from={first}&limit=1000");
        get(&front.address, &path)["members"].clone()
    });
    let all: Vec<Value> = pages
        .flat_map(|page| page.as_array().cloned().unwrap_or_default())
        .collect();
    assert_eq!(all.len(), members);
    let wall = |member: &Value| member["outcome"]["finished"]["quantities"]["wall_s"].as_f64();
    all.iter().filter_map(wall).sum()
}

/// The long form's figures need a machine with two free cores and the optimised program
/// (`ATTACK_BINARY`).
#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn two_worker_processes_do_twice_the_work() {
    let _turn = crate::turn();
    let members = at_length(32, 1_024);
    let duration_s = [1.0, 3.0][at_length(0, 1)];
    let single = Server::start();
    let (one_s, one_wall_s) = run(&single, 1, members, duration_s);
    drop(single);
    let double = Server::start();
    let (two_s, two_wall_s) = run(&double, 2, members, duration_s);
    tell(&format!(
        "{members} members of {:.3} s: one worker process {one_s:.1} s elapsed, {one_wall_s:.1} s in \
         members; two {two_s:.1} s elapsed, {two_wall_s:.1} s in members; ratio {:.2}; elapsed over \
         members beyond their own time: {:.2} % and {:.2} %",
        one_wall_s / members as f64,
        one_s / two_s,
        100.0 * (one_s / one_wall_s - 1.0),
        100.0 * (2.0 * two_s / two_wall_s - 1.0),
    ));
    if at_length(0, 1) == 1 {
        assert!(one_s / two_s >= 1.9);
    }
}
