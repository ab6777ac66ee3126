//! A database that is full, corrupt, truncated, or that can't be written.

use crate::client::{ask, get};
use crate::served::{Place, Served, has_ended, scene, trifle};
use std::fs::{self, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::time::Duration;

/// Time for which an answer about readiness is given again, and a little more.
const SHARED: Duration = Duration::from_millis(250);

/// Full disk: a clear 507, `/readyz` fails, `/healthz` and reading work; once there
/// is space again the service accepts jobs again by itself.
#[test]
fn a_full_database_says_so_and_recovers_by_itself() {
    let _turn = crate::turn();
    let place = Place::new(&[("SCREE_LIMITS__DATABASE_BYTES", "600000")]);
    let served = place.serve();
    let address = served.address.as_str();
    let done: Vec<String> = (0..6).map(|_| served.submit(&trifle())).collect();
    for job in &done {
        served.wait_for_success(job);
    }
    assert_eq!(get(address, "/readyz")["status"], "ok");

    let body = trifle().to_string();
    let mut jobs = Vec::new();
    let refused = loop {
        let answer = ask(address, "POST", "/v1/jobs", &body).expect("an answer");
        if answer.status != 202 {
            break answer;
        }
        let id = answer.body["id"].as_str().expect("an id");
        jobs.push(format!("/v1/jobs/{id}"));
        assert!(jobs.len() < 2_000, "it never fills");
    };
    assert_eq!(refused.status, 507, "{}", refused.body);
    assert_eq!(refused.body["type"], "urn:scree:problem:storage-full");
    std::thread::sleep(SHARED);
    let ready = ask(address, "GET", "/readyz", "").expect("an answer");
    assert_eq!(ready.status, 503, "{}", ready.body);
    assert_eq!(get(address, "/healthz")["status"], "ok");
    assert_eq!(get(address, &done[0])["status"], "successful");

    for job in &done {
        remove(address, job);
    }
    // The acknowledged jobs end now that there is space for their records.
    for job in &jobs {
        served.wait_for_success(job);
        remove(address, job);
    }
    crate::tell(&format!(
        "full database: after {} jobs 507 and /readyz 503; room made, all of them done",
        jobs.len()
    ));
    assert_eq!(get(address, "/readyz")["status"], "ok");
    let again = served.submit(&trifle());
    served.wait_for_success(&again);
}

fn remove(address: &str, job: &str) {
    let path = format!("{job}?remove=ended");
    let removed = ask(address, "DELETE", &path, "").expect("an answer");
    assert_eq!(removed.status, 204, "{}", removed.body);
}

/// A file that is no database, or was overwritten in the middle, is reported at the
/// start or in the answer, never read as valid data.
#[test]
fn a_broken_database_is_noticed() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    fs::write(
        place.database(),
        "this is no database, however long it may be",
    )
    .expect("writable");
    let (code, words) = place.refuse();
    assert_eq!(code, Some(1), "{words}");
    assert!(words.contains("not a database"), "{words}");

    let place = Place::new(&[]);
    let served = place.serve();
    let job = served.submit(&trifle());
    served.wait_for_success(&job);
    drop(served);
    let (_, words) = {
        let log = place.database().with_extension("db-wal");
        let _ = fs::remove_file(log);
        let mut file = OpenOptions::new()
            .write(true)
            .open(place.database())
            .expect("the file");
        file.seek(SeekFrom::Start(100)).expect("it is long");
        file.write_all(&[0xff; 8000]).expect("writable");
        place.refuse()
    };
    assert!(
        words.contains("malformed") || words.contains("corrupt"),
        "{words}"
    );
}

/// A write-ahead log as a crash may leave it, truncated anywhere: the service starts
/// with a consistent state, if not always the latest.
#[test]
fn a_log_cut_off_anywhere_leaves_a_whole_past() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    let served = place.serve();
    for _ in 0..5 {
        let job = served.submit(&trifle());
        served.wait_for_success(&job);
    }
    served.kill();
    let log = place.path().join("scree.db-wal");
    let whole = fs::read(&log).expect("a log");
    let database = fs::read(place.database()).expect("a database");
    for cut in [
        0,
        1,
        31,
        32,
        4000,
        whole.len() / 3,
        whole.len() / 2,
        whole.len() - 1,
    ] {
        fs::write(&log, &whole[..cut]).expect("writable");
        fs::write(place.database(), &database).expect("writable");
        let _ = fs::remove_file(place.path().join("scree.db-shm"));
        let served = place.serve();
        let page = get(&served.address, "/v1/jobs");
        for job in page["jobs"].as_array().expect("jobs") {
            let path = format!("/v1/jobs/{}", job["id"].as_str().expect("an id"));
            served.wait_for_success(&path);
        }
        let new = served.submit(&trifle());
        served.wait_for_success(&new);
        served.kill();
    }
}

/// A service with a job that has ended and one that runs; their paths.
fn with_two_jobs(place: &Place) -> (Served, [String; 2]) {
    let served = place.serve();
    let done = served.submit(&trifle());
    served.wait_for_success(&done);
    let running = served.submit(&scene(3_600.0));
    served.wait(&running, |job| job["status"] == "running");
    (served, [done, running])
}

/// Checks that a service reads its jobs, of which the first has ended, says that it can't write,
/// and refuses another job with this status.
fn can_only_read(served: &Served, [done, other]: [&String; 2], refusal: u16) {
    let address = served.address.as_str();
    assert_eq!(get(address, done)["status"], "successful");
    assert!(!has_ended(&get(address, other)));
    let ready = ask(address, "GET", "/readyz", "").expect("an answer");
    assert_eq!(ready.status, 503, "{}", ready.body);
    let refused = ask(address, "POST", "/v1/jobs", &trifle().to_string()).expect("an answer");
    assert_eq!(refused.status, refusal, "{}", refused.body);
}

/// A limit or a disk that is full before the start: what is there is served, and jobs are
/// accepted once there is room.
#[test]
fn a_database_that_is_full_at_the_start_is_served() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    let (served, [done, waiting]) = with_two_jobs(&place);
    served.kill();

    let limited = place.with(("SCREE_LIMITS__DATABASE_BYTES", "4096"));
    let served = limited.serve();
    can_only_read(&served, [&done, &waiting], 507);
    served.kill();

    let roomy = limited.with(("SCREE_LIMITS__DATABASE_BYTES", "100000000"));
    let served = roomy.serve();
    served.wait(&waiting, |job| job["status"] == "running");
}

/// A file and a folder that the service may not write: what is there is served, no job is
/// run, and all goes on once they can be written.
#[cfg(unix)]
#[test]
fn a_database_that_can_not_be_written_is_read_and_goes_on_later() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    let (served, [done, waiting]) = with_two_jobs(&place);
    served.stop();

    let user = place.hand_over_read_only();
    let served = place.serve_as(user);
    can_only_read(&served, [&done, &waiting], 503);
    assert_eq!(get(&served.address, &waiting)["status"], "accepted");

    place.make_writable();
    served.wait(&waiting, |job| job["status"] == "running");
    std::thread::sleep(SHARED);
    assert_eq!(get(&served.address, "/readyz")["status"], "ok");
    served.submit(&trifle());
}
