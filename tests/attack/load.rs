//! High load: thousands of jobs, requests to stop, ten clients with a large
//! trajectory; and the overhead of the service over the computation.

use crate::client::{ask, count_bytes, get};
use crate::served::{Place, binary, fine_scene, finest_scene, has_ended, scene, trifle};
use crate::{at_length, percentile};
use serde_json::Value;
use std::process::Command;
use std::time::Instant;

fn seconds<T>(what: impl FnOnce() -> T) -> (f64, T) {
    let began = Instant::now();
    let result = what();
    (began.elapsed().as_secs_f64(), result)
}

/// Thousands of jobs are submitted while one runs, and reading a job stays fast.
#[test]
fn thousands_of_waiting_jobs_are_no_burden() {
    let _turn = crate::turn();
    let (clients, jobs) = (4, at_length(200, 10_000));
    let place = Place::new(&[("SCREE_LIMITS__QUEUED_JOBS", "20000")]);
    let served = place.serve();
    let address = served.address.as_str();
    let running = served.submit(&fine_scene(600.0));
    served.wait(&running, |job| job["status"] == "running");
    let body = trifle().to_string();
    let submit = || {
        let answer = ask(address, "POST", "/v1/jobs", &body).expect("an answer");
        assert_eq!(answer.status, 202, "{}", answer.body);
        answer.body["id"].as_str().expect("an id").to_owned()
    };
    let (all_s, ids) = seconds(|| {
        std::thread::scope(|scope| {
            let clients: Vec<_> = (0..clients)
                .map(|_| scope.spawn(|| (0..jobs / clients).map(|_| submit()).collect::<Vec<_>>()))
                .collect();
            let ids = clients
                .into_iter()
                .flat_map(|client| client.join().expect("a client"));
            ids.collect::<Vec<_>>()
        })
    });
    let looks = at_length(100, 1_000);
    let look = |look: usize| {
        let id = &ids[(look * 7919) % ids.len()];
        seconds(|| get(address, &format!("/v1/jobs/{id}"))).0
    };
    let mut looks_s: Vec<f64> = (0..looks).map(look).collect();
    let mut lists_s: Vec<f64> = (0..looks / 10)
        .map(|_| seconds(|| get(address, "/v1/jobs?status=accepted&limit=100")).0)
        .collect();
    crate::tell(&format!(
        "{} jobs waiting: submitted at {:.0} a second by {clients} clients, one connection a \
         request; a look at a job p50 {:.1}, p99 {:.1} ms; a list of 100 p99 {:.1} ms",
        ids.len(),
        ids.len() as f64 / all_s,
        percentile(&mut looks_s, 0.5) * 1e3,
        percentile(&mut looks_s, 0.99) * 1e3,
        percentile(&mut lists_s, 0.99) * 1e3,
    ));
    assert_eq!(get(address, &running)["status"], "running");
}

/// Time from the request to the answer that shows the job in its final state.
#[test]
fn running_jobs_are_dismissed_at_once() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    let served = place.serve();
    let mut times_s = Vec::new();
    for _ in 0..at_length(5, 100) {
        let job = served.submit(&scene(600.0));
        served.wait(&job, |job| job["progress"]["steps"].as_u64() > Some(0));
        let (time_s, answer) = seconds(|| ask(&served.address, "DELETE", &job, ""));
        let answer = answer.expect("an answer").body;
        assert_eq!(answer["status"], "dismissed", "{answer}");
        times_s.push(time_s);
    }
    let p99 = percentile(&mut times_s, 0.99);
    crate::tell(&format!(
        "{} running jobs dismissed: p50 {:.0} ms, p99 {:.0} ms",
        times_s.len(),
        percentile(&mut times_s, 0.5) * 1e3,
        p99 * 1e3
    ));
    assert!(p99 < 0.5, "{p99} s");
}

/// Ten clients with a trajectory much larger than the bound need no more memory
/// than the bound.
#[cfg(target_os = "linux")]
#[test]
fn a_large_trajectory_goes_out_in_little_memory() {
    let _turn = crate::turn();
    let samples = at_length(5_000, 300_000);
    let place = Place::new(&[]);
    let served = place.serve();
    let mut large = trifle();
    large["sample_interval_s"] = 1e-3.into();
    large["duration_s"] = (samples as f64 * 1e-3).into();
    // The body comes to rest at once.
    large["numerics"]["ending"] = "full".into();
    let job = served.submit(&large);
    served.wait_for_success(&job);
    for format in ["json", "ndjson", "npz"] {
        let before = served.resident_bytes();
        let path = format!("{job}/trajectory?format={format}");
        let (most, bytes) = std::thread::scope(|scope| {
            let (address, path) = (&served.address, &path);
            let clients: Vec<_> = (0..10)
                .map(|_| scope.spawn(|| count_bytes(address, path, "identity").expect("an answer")))
                .collect();
            let mut most = before;
            while !clients.iter().all(|client| client.is_finished()) {
                most = most.max(served.resident_bytes());
                std::thread::sleep(crate::served::PAUSE);
            }
            let bytes: usize = clients
                .into_iter()
                .map(|client| client.join().expect("a client"))
                .sum();
            (most, bytes)
        });
        let grown_mib = most.saturating_sub(before) as f64 / f64::from(1 << 20);
        crate::tell(&format!(
            "ten clients pull {samples} samples as {format}, {:.0} MB in all: memory grows by {grown_mib:.1} MiB",
            bytes as f64 * 1e-6
        ));
        // All answers were complete: a resting cube takes 199 bytes per sample as JSON.
        assert!(bytes > 10 * samples * 150, "{bytes} bytes");
        assert!(grown_mib < 64.0, "{grown_mib} MiB");
    }
}

/// The same scene with and without the service, in turn. On a machine of varying speed
/// a few rounds show little: the figure is the mean ratio of
/// neighbouring runs over many rounds, with its standard error.
#[test]
fn the_service_costs_little_beside_the_computation() {
    let _turn = crate::turn();
    let rounds = at_length(2, 24);
    let long = match rounds {
        2 => scene(0.5),
        _ => finest_scene(1.0),
    };
    let place = Place::new(&[]);
    let file = place.path().join("scene.json");
    std::fs::write(&file, long.to_string()).expect("writable");
    let served = place.serve();
    let wall_s = |outcome: &Value| outcome["cost"]["wall_s"].as_f64().expect("seconds");
    let alone = || {
        let run = Command::new(binary())
            .args(["run", "--json", "--threads", "1"])
            .arg(&file)
            .output();
        serde_json::from_slice::<Value>(&run.expect("it runs").stdout).expect("an outcome")
    };
    let as_job = || served.wait(&served.submit(&long), has_ended)["outcome"].clone();
    let (mut alone_s, mut with_s) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        // The order alternates, so that neither has an advantage.
        let (run, job) = if round % 2 == 0 {
            let run = alone();
            (run, as_job())
        } else {
            let job = as_job();
            (alone(), job)
        };
        assert_eq!(job["bodies"], run["bodies"]);
        alone_s.push(wall_s(&run));
        with_s.push(wall_s(&job));
    }
    let neighbours = with_s.iter().zip(&alone_s);
    let ratios: Vec<f64> = neighbours
        .map(|(with, alone)| (with / alone).ln())
        .collect();
    let count = rounds as f64;
    let mean = ratios.iter().sum::<f64>() / count;
    let variance = ratios
        .iter()
        .map(|ratio| (ratio - mean).powi(2))
        .sum::<f64>()
        / (count - 1.0);
    let (alone, with) = (percentile(&mut alone_s, 0.0), percentile(&mut with_s, 0.0));
    crate::tell(&format!(
        "as a job {:+.1} % ± {:.1} % of scree run, mean of {rounds} in turn; \
         best {with:.3} s against {alone:.3} s: {:+.1} %",
        mean.exp_m1() * 100.0,
        (variance / count).sqrt() * 100.0,
        (with / alone - 1.0) * 100.0
    ));
}
