//! kill -9, during submissions and during a run.

use crate::client::{ask, get};
use crate::served::{Place, finest_scene, has_ended, scene, trifle};
use crate::{at_length, percentile};
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Killed repeatedly while clients submit: every acknowledged job
/// exists afterwards and was completed once; none fails because of the kills.
#[test]
fn no_acknowledged_job_is_lost_and_none_is_run_twice() {
    let _turn = crate::turn();
    let cycles = at_length(4, 200);
    let place = Place::new(&[]);
    let mut acknowledged = BTreeSet::new();
    for cycle in 0..cycles {
        let served = place.serve();
        let address = served.address.clone();
        let stop = AtomicBool::new(false);
        let answered = AtomicUsize::new(0);
        let taken = std::thread::scope(|scope| {
            let submitter = scope.spawn(|| submit_until(&address, &stop, &answered));
            while answered.load(Ordering::Relaxed) <= cycle % 4 {
                std::thread::sleep(Duration::from_millis(1));
            }
            // From "just answered" to "some jobs done", irregularly.
            std::thread::sleep(Duration::from_millis((cycle as u64 * 37) % 100));
            served.kill();
            stop.store(true, Ordering::Relaxed);
            submitter.join().expect("a client")
        });
        acknowledged.extend(taken);
    }
    let served = place.serve();
    let (mut lost, mut twice, mut failed) = (0, 0, 0);
    for id in &acknowledged {
        let path = format!("/v1/jobs/{id}");
        let answer = ask(&served.address, "GET", &path, "").expect("an answer");
        if answer.status == 404 {
            lost += 1;
            continue;
        }
        let job = served.wait(&path, has_ended);
        let attempts = job["attempts"].as_array().expect("attempts");
        let successful = |attempt: &&serde_json::Value| attempt["ending"] == "successful";
        let ends = attempts.iter().filter(successful).count();
        twice += usize::from(ends > 1);
        failed += usize::from(ends == 0);
    }
    assert!(acknowledged.len() >= cycles, "{} jobs", acknowledged.len());
    crate::tell(&format!(
        "kill -9 under submissions: {cycles} cycles, {} jobs acknowledged, {lost} lost, \
         {twice} run twice to an end, {failed} failed",
        acknowledged.len()
    ));
    assert_eq!((lost, twice, failed), (0, 0, 0));
}

/// Ids of the jobs that were answered with 202.
fn submit_until(address: &str, stop: &AtomicBool, answered: &AtomicUsize) -> Vec<String> {
    let mut taken = Vec::new();
    let body = trifle().to_string();
    while !stop.load(Ordering::Relaxed) {
        match ask(address, "POST", "/v1/jobs", &body) {
            Ok(answer) if answer.status == 202 => {
                taken.push(answer.body["id"].as_str().expect("an id").to_owned());
                answered.fetch_add(1, Ordering::Relaxed);
            }
            Ok(answer) => panic!("{answer:?}"),
            // The service was killed: a job without an answer is not acknowledged.
            Err(_) => return taken,
        }
    }
    taken
}

/// After a kill in the middle of a run, the job resumes from its last saved state and
/// ends with the bits of an uninterrupted run.
#[test]
fn a_run_killed_many_times_ends_with_the_same_bits() {
    let _turn = crate::turn();
    // Long enough apart for a saved state in between, all within the run: the progress lost by a
    // kill is included in the reported progress, so the pause counts as well.
    let kills = at_length(2, 22);
    let settings = [
        ("SCREE_RECORDING__STATE_INTERVAL_S", "0.05"),
        ("SCREE_RECORDING__FLUSH_INTERVAL_S", "0.05"),
    ];
    let place = Place::new(&settings);
    let (long, apart_s, pause) = match kills {
        2 => (scene(20.0), 5.0, Duration::ZERO),
        _ => (finest_scene(3.0), 0.01, Duration::from_millis(700)),
    };
    let served = place.serve();
    let whole = served.submit(&long);
    let whole = served.wait_for_success(&whole);
    let job = served.submit(&long);
    let mut served = served;
    let mut resumed_from_s = 0.0;
    let mut resumed_after_s = Vec::new();
    for kill in 1..=kills {
        let started = |job: &serde_json::Value| job["progress"]["simulated_time_s"].as_f64();
        served.wait(&job, |job| {
            has_ended(job) || started(job) > Some(resumed_from_s + apart_s)
        });
        std::thread::sleep(pause);
        served.kill();
        let began = Instant::now();
        served = place.serve();
        let attempt = kill;
        let resumed = served.wait(&job, |job| {
            has_ended(job) || !job["attempts"][attempt]["resumed_from_s"].is_null()
        });
        resumed_after_s.push(began.elapsed().as_secs_f64());
        let from_s = resumed["attempts"][attempt]["resumed_from_s"].as_f64();
        let from_s = from_s.unwrap_or_else(|| panic!("too late to kill: {resumed:#}"));
        assert!(from_s >= resumed_from_s, "{from_s} after {resumed_from_s}");
        resumed_from_s = from_s;
    }
    let killed = served.wait_for_success(&job);
    let fingerprint = |job: &serde_json::Value| job["provenance"]["fingerprint"].clone();
    assert_eq!(fingerprint(&killed), fingerprint(&whole));
    assert_eq!(killed["outcome"]["bodies"], whole["outcome"]["bodies"]);
    let median = percentile(&mut resumed_after_s, 0.5);
    let longest = percentile(&mut resumed_after_s, 1.0);
    crate::tell(&format!(
        "mid-run kills: {kills}, last resumed from t = {resumed_from_s:.3} s, fingerprint equal; \
         process start to resumed: median {median:.3} s, longest {longest:.3} s"
    ));
}

/// A job that crashes the service each time does so three times.
#[test]
fn a_job_that_never_gets_on_fails_after_three_kills() {
    let _turn = crate::turn();
    let place = Place::new(&[("SCREE_RECORDING__STATE_INTERVAL_S", "3600")]);
    let served = place.serve();
    let job = served.submit(&scene(600.0));
    let mut served = served;
    for attempt in 1..=3 {
        served.wait(&job, |job| job["attempt"] == attempt);
        served.kill();
        served = place.serve();
    }
    let failed = get(&served.address, &job);
    assert_eq!(failed["status"], "failed");
    assert_eq!(failed["problem"]["type"], "urn:scree:failure:cut-off");
}
