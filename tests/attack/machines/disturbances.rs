//! kill -9 of workers, of the service and of the database server, and workers that are suspended for
//! longer than their leases: nothing is lost, nothing runs to its end twice, and all results have the
//! bits of an undisturbed run.

use super::cluster::{Server, Worker};
use crate::client::{ask, get};
use crate::served::{Place, Served, has_ended, scene};
use crate::{at_length, tell};
use serde_json::Value;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};

const SETTINGS: [(&str, &str); 5] = [
    ("SCREE_WORKERS__COUNT", "0"),
    ("SCREE_QUEUE__LEASE_S", "1.5"),
    ("SCREE_QUEUE__HEARTBEAT_INTERVAL_S", "0.3"),
    ("SCREE_RECORDING__STATE_INTERVAL_S", "0.1"),
    ("SCREE_RECORDING__FLUSH_INTERVAL_S", "0.05"),
];

/// Time for which a worker is suspended: its leases run out meanwhile, and its jobs go to others.
const SUSPENDED: Duration = Duration::from_millis(2_500);

const WORKERS: usize = 2;

/// Scenarios of different lengths.
fn scenario(number: usize) -> Value {
    scene(1.0 + 0.75 * (number % 16) as f64)
}

/// Fingerprints of the scenarios, each run once without any disturbance.
fn fingerprints() -> BTreeMap<usize, Value> {
    let place = Place::new(&[]);
    let served = place.serve();
    let submitted: Vec<_> = (0..16)
        .map(|number| served.submit(&scenario(number)))
        .collect();
    let fingerprint =
        |job: &String| served.wait_for_success(job)["provenance"]["fingerprint"].clone();
    submitted.iter().map(fingerprint).enumerate().collect()
}

struct Cluster {
    server: Server,
    place: Place,
    front: Option<Served>,
    workers: Vec<Worker>,
    /// Acknowledged jobs, and the numbers of their scenarios.
    jobs: Vec<(String, usize)>,
    counts: BTreeMap<&'static str, usize>,
}

impl Cluster {
    fn start() -> Self {
        let server = Server::start();
        let place = server.place(&SETTINGS);
        let front = place.serve();
        let workers = (0..WORKERS).map(|_| Worker::start(&place, &[])).collect();
        Self {
            front: Some(front),
            workers,
            place,
            server,
            jobs: Vec::new(),
            counts: BTreeMap::new(),
        }
    }

    fn address(&self) -> &str {
        &self.front.as_ref().expect("a front").address
    }

    /// Submits until so many jobs are acknowledged; while the database is away, none is.
    fn submit(&mut self, count: usize) {
        let began = Instant::now();
        let wanted = self.jobs.len() + count;
        while self.jobs.len() < wanted {
            let number = self.jobs.len();
            let body = scenario(number).to_string();
            match ask(self.address(), "POST", "/v1/jobs", &body) {
                Ok(answer) if answer.status == 202 => {
                    let id = answer.body["id"].as_str().expect("an id");
                    self.jobs.push((format!("/v1/jobs/{id}"), number));
                }
                Ok(answer) if answer.status == 503 => std::thread::sleep(Duration::from_millis(50)),
                other => panic!("{other:?}"),
            }
            assert!(
                began.elapsed() < Duration::from_secs(60),
                "none is accepted"
            );
        }
    }

    /// The next disturbance, in turn.
    fn disturb(&mut self, turn: usize) {
        let kind = [
            "worker",
            "front",
            "postmaster",
            "worker",
            "suspended worker",
        ][turn % 5];
        *self.counts.entry(kind).or_default() += 1;
        let which = turn / 5 % WORKERS;
        match kind {
            "worker" => {
                self.workers.remove(which).kill();
                self.workers.push(Worker::start(&self.place, &[]));
            }
            "front" => {
                self.front.take().expect("a front").kill();
                self.front = Some(self.place.serve());
            }
            "postmaster" => self.server.crash(),
            _ => {
                self.workers[which].signal("-STOP");
                std::thread::sleep(SUSPENDED);
                self.workers[which].signal("-CONT");
            }
        }
    }
}

#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn whatever_dies_no_job_is_lost_or_run_twice_and_all_have_the_same_bits() {
    let _turn = crate::turn();
    let disturbances = at_length(10, 100);
    let expected = fingerprints();
    let mut cluster = Cluster::start();
    let began = Instant::now();
    for turn in 0..disturbances {
        cluster.submit(2);
        // From "just claimed" to "has saved a state", irregularly.
        std::thread::sleep(Duration::from_millis((turn as u64 * 137) % 900));
        cluster.disturb(turn);
    }
    let front = cluster.front.as_ref().expect("a front");
    let (mut lost, mut twice, mut failed, mut different, mut resumed) = (0, 0, 0, 0, 0);
    for (path, number) in &cluster.jobs {
        if ask(&front.address, "GET", path, "")
            .expect("an answer")
            .status
            == 404
        {
            lost += 1;
            continue;
        }
        let job = front.wait(path, has_ended);
        let attempts = job["attempts"].as_array().expect("attempts");
        let ends = attempts
            .iter()
            .filter(|attempt| attempt["ending"] == "successful")
            .count();
        twice += usize::from(ends > 1);
        failed += usize::from(ends == 0);
        resumed += usize::from(
            attempts
                .iter()
                .any(|attempt| !attempt["resumed_from_s"].is_null()),
        );
        different += usize::from(job["provenance"]["fingerprint"] != expected[&(number % 16)]);
    }
    tell(&format!(
        "{disturbances} disturbances ({:?}) of {WORKERS} workers and a service on PostgreSQL in \
         {:.0} s: {} jobs acknowledged, {lost} lost, {twice} run twice to an end, {failed} failed, \
         {different} with other bits; {resumed} went on from a saved state",
        cluster.counts,
        began.elapsed().as_secs_f64(),
        cluster.jobs.len()
    ));
    assert_eq!((lost, twice, failed, different), (0, 0, 0, 0));
    assert!(resumed > 0, "nothing was resumed");
}

/// SIGTERM: a worker saves its run, hands it back and leaves; another goes on from there.
#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn a_worker_that_is_asked_to_leave_hands_its_job_to_another() {
    let _turn = crate::turn();
    let server = Server::start();
    let place = server.place(&SETTINGS);
    let front = place.serve();
    let job = front.submit(&scene(4.0));
    let first = Worker::start(&place, &[]);
    let simulated = |job: &Value| job["progress"]["simulated_time_s"].as_f64();
    front.wait(&job, |job| simulated(job) > Some(0.2));
    first.signal("-TERM");
    let began = Instant::now();
    assert_eq!(first.end(), Some(0));
    assert!(
        began.elapsed() < Duration::from_secs(10),
        "{:?}",
        began.elapsed()
    );
    let waiting = get(&front.address, &job);
    assert_eq!(waiting["status"], "accepted");
    assert_eq!(waiting["attempts"][0]["ending"], "handed-back");
    let second = Worker::start(&place, &["--until-empty"]);
    let ended = front.wait_for_success(&job);
    assert!(
        ended["attempts"][1]["resumed_from_s"].as_f64() > Some(0.1),
        "{ended:#}"
    );
    assert_eq!(second.end(), Some(0), "it leaves the empty queue");
}

/// Two services side by side: what one accepts the other shows at once, and its followers are told.
#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn two_services_show_the_same_jobs() {
    let _turn = crate::turn();
    let server = Server::start();
    let place = server.place(&SETTINGS);
    let (one, other) = (place.serve(), place.serve());
    let _worker = Worker::start(&place, &[]);
    let study = serde_json::json!({
        "scenario": scene(0.2),
        "inputs": [{"pointer": "/channel/base_friction",
                    "distribution": {"uniform": {"from": 0.3, "to": 0.5}}}],
        "design": {"sobol": {"members": 8, "seed": 1}},
        "questions": [],
    });
    let answer = ask(&other.address, "POST", "/v1/studies", &study.to_string()).expect("an answer");
    assert_eq!(answer.status, 202, "{}", answer.body);
    let study = format!("/v1/studies/{}", answer.body["id"].as_str().expect("an id"));
    let job = one.submit(&scene(0.2));
    assert_eq!(
        get(&other.address, &job)["id"],
        get(&one.address, &job)["id"]
    );
    other.wait_for_success(&job);
    // The one that leads drives the studies that the other has accepted; if it dies, the other does.
    one.kill();
    other.wait(&study, |study| study["status"] == "successful");
}
