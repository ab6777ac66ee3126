//! kill -9 while clients do everything at once: single jobs and batches with keys and without,
//! repetitions, dismissals, removals, event streams. Nothing acknowledged is lost, nothing is
//! shifted: a key brings its first answer, a job ends with the bits of its undisturbed twin, and
//! events come in order.

use crate::at_length;
use crate::client::ask_with;
use crate::served::{Place, Served, has_ended, scene, trifle};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead, BufReader, Write};
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

/// Time between two requests: the jobs of all kills must come to an end in the end.
const PAUSE: Duration = Duration::from_millis(10);

/// Answers that clients got.
#[derive(Default)]
struct Told {
    /// Titles of acknowledged jobs, by identifier.
    jobs: BTreeMap<String, String>,
    /// Path, body and first answer of every request with a key.
    keys: BTreeMap<String, (&'static str, String, Value)>,
    dismissed: BTreeSet<String>,
    /// Jobs whose removal was asked for.
    removed: BTreeSet<String>,
    shifted: Vec<String>,
}

/// A source of choices that are the same each time.
struct Choices(u64);

impl Choices {
    fn below(&mut self, end: u64) -> u64 {
        // Constants of Knuth's MMIX; the high bits are the better ones.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % end
    }
}

/// Scenes of a few milliseconds, and one that is cut off by most kills.
fn scenes() -> Vec<Value> {
    let mut scenes: Vec<Value> = (1..=3)
        .map(|n| {
            let mut scene = trifle();
            scene["duration_s"] = json!(0.01 * f64::from(n));
            scene
        })
        .collect();
    scenes.push(scene(2.0));
    for (place, scene) in scenes.iter_mut().enumerate() {
        scene["title"] = json!(format!("scene {place}"));
    }
    scenes
}

/// Submits, repeats, dismisses and removes until the flag is raised or the service is gone.
fn meddle(address: &str, stop: &AtomicBool, told: &mut Told, choices: &mut Choices) {
    let scenes = scenes();
    while !stop.load(Ordering::Relaxed) {
        let done = match choices.below(10) {
            0..=3 => submit(address, &scenes, told, choices),
            4..=6 => repeat(address, told, choices),
            7..=8 => change(address, told, choices, false),
            _ => change(address, told, choices, true),
        };
        if done.is_none() {
            return;
        }
        std::thread::sleep(PAUSE);
    }
}

fn submit(address: &str, scenes: &[Value], told: &mut Told, choices: &mut Choices) -> Option<()> {
    let count = 1 + choices.below(3) as usize;
    let pick = |choices: &mut Choices| {
        // The long one is rare.
        let place = if choices.below(12) == 0 {
            3
        } else {
            choices.below(3)
        };
        scenes[place as usize].clone()
    };
    let chosen: Vec<Value> = (0..count).map(|_| pick(choices)).collect();
    let (path, body) = if count > 1 {
        let jobs: Vec<Value> = chosen
            .iter()
            .map(|scene| json!({"scenario": scene}))
            .collect();
        ("/v1/batches", json!({"jobs": jobs}).to_string())
    } else {
        ("/v1/jobs?label=chaos", chosen[0].to_string())
    };
    let key = format!("key-{}-{}", told.keys.len(), choices.below(u64::MAX >> 33));
    let answer = ask_with(address, "POST", path, &[("Idempotency-Key", &key)], &body).ok()?;
    assert_eq!(answer.status, 202, "{}", answer.body);
    for (id, scene) in ids(&answer.body).into_iter().zip(&chosen) {
        let title = scene["title"].as_str().expect("a title");
        told.jobs.insert(id, title.to_owned());
    }
    told.keys.insert(key, (path, body, answer.body));
    Some(())
}

fn ids(answer: &Value) -> Vec<String> {
    let text = |id: &Value| id.as_str().expect("an id").to_owned();
    match answer["ids"].as_array() {
        Some(ids) => ids.iter().map(text).collect(),
        None => vec![text(&answer["id"])],
    }
}

fn repeat(address: &str, told: &mut Told, choices: &mut Choices) -> Option<()> {
    let Some(place) = (told.keys.len() as u64).checked_sub(1) else {
        return Some(());
    };
    let place = choices.below(place + 1) as usize;
    let (key, (path, body, first)) = told.keys.iter().nth(place).expect("within the keys");
    let again = ask_with(address, "POST", path, &[("Idempotency-Key", key)], body).ok()?;
    if again.status != 202 || again.body != *first {
        told.shifted.push(format!(
            "{key}: {first} then {} {}",
            again.status, again.body
        ));
    }
    Some(())
}

fn change(address: &str, told: &mut Told, choices: &mut Choices, remove: bool) -> Option<()> {
    let Some(last) = (told.jobs.len() as u64).checked_sub(1) else {
        return Some(());
    };
    let place = choices.below(last + 1) as usize;
    let id = told
        .jobs
        .keys()
        .nth(place)
        .expect("within the jobs")
        .clone();
    let query = if remove { "?remove=ended" } else { "" };
    if remove {
        // Before the answer, which may be lost.
        told.removed.insert(id.clone());
    }
    let answer = ask_with(address, "DELETE", &format!("/v1/jobs/{id}{query}"), &[], "").ok()?;
    match answer.status {
        200 => drop(told.dismissed.insert(id)),
        409 if remove => drop(told.removed.remove(&id)),
        204 | 404 | 409 => {}
        status => panic!("{status}: {}", answer.body),
    }
    Some(())
}

/// Follows all events after the last one seen; `false` if one came out of order.
fn follow(address: &str, last: &AtomicU64) -> bool {
    let Ok(mut stream) = TcpStream::connect(address) else {
        return true;
    };
    let seen = last.load(Ordering::Relaxed);
    let head =
        format!("GET /v1/events HTTP/1.1\r\nHost: {address}\r\nLast-Event-ID: {seen}\r\n\r\n");
    if stream.write_all(head.as_bytes()).is_err() {
        return true;
    }
    let mut in_order = true;
    // Until the service is killed.
    for line in BufReader::new(stream).lines().map_while(Result::ok) {
        if let Some(number) = line.strip_prefix("id: ") {
            let number: u64 = number.parse().expect("a number");
            in_order &= number > last.swap(number, Ordering::Relaxed);
        }
    }
    in_order
}

/// Fingerprint of each scene, computed undisturbed.
fn fingerprints(served: &Served) -> BTreeMap<String, Value> {
    let fingerprint = |scene: &Value| {
        let job = served.wait_for_success(&served.submit(scene));
        let title = scene["title"].as_str().expect("a title").to_owned();
        (title, job["provenance"]["fingerprint"].clone())
    };
    scenes().iter().map(fingerprint).collect()
}

#[test]
fn nothing_is_lost_or_shifted_whatever_clients_do_under_kills() {
    let _turn = crate::turn();
    let cycles = at_length(5, 60);
    let undisturbed = fingerprints(&Place::new(&[]).serve());
    let place = Place::new(&[
        ("SCREE_RECORDING__STATE_INTERVAL_S", "0.1"),
        ("SCREE_RECORDING__FLUSH_INTERVAL_S", "0.05"),
    ]);
    let mut told = Told::default();
    let mut choices = Choices(7);
    let last_event = AtomicU64::new(0);
    let mut in_order = true;
    for _ in 0..cycles {
        let served = place.serve();
        let address = served.address.clone();
        let stop = AtomicBool::new(false);
        let pause = Duration::from_millis(20 + choices.below(1_500));
        in_order &= std::thread::scope(|scope| {
            let meddler = scope.spawn(|| meddle(&address, &stop, &mut told, &mut choices));
            let follower = scope.spawn(|| follow(&address, &last_event));
            std::thread::sleep(pause);
            served.kill();
            stop.store(true, Ordering::Relaxed);
            meddler.join().expect("a client");
            follower.join().expect("a follower")
        });
    }
    let served = place.serve();
    let (mut lost, mut twice, mut wrong) = (0, 0, Vec::new());
    for (id, title) in &told.jobs {
        let path = format!("/v1/jobs/{id}");
        let answer = ask_with(&served.address, "GET", &path, &[], "").expect("an answer");
        if answer.status == 404 {
            lost += usize::from(!told.removed.contains(id));
            continue;
        }
        let job = served.wait(&path, has_ended);
        let attempts = job["attempts"].as_array().expect("attempts");
        let ends = attempts
            .iter()
            .filter(|attempt| attempt["ending"] == "successful");
        twice += usize::from(ends.count() > 1);
        let right = match job["status"].as_str() {
            Some("successful") => {
                !told.dismissed.contains(id)
                    && job["provenance"]["fingerprint"] == undisturbed[title]
            }
            Some(status) => status == "dismissed",
            None => false,
        };
        if !right {
            wrong.push(format!("{title}: {job:#}"));
        }
    }
    crate::tell(&format!(
        "chaos: {cycles} kills, {} jobs acknowledged under {} keys, {lost} lost, {twice} run twice \
         to an end, {} with other bits or ends, {} answers shifted, events in order: {in_order}",
        told.jobs.len(),
        told.keys.len(),
        wrong.len(),
        told.shifted.len(),
    ));
    assert!(told.jobs.len() >= cycles);
    assert_eq!((lost, twice), (0, 0));
    assert!(in_order, "events came out of order");
    assert_eq!(told.shifted, Vec::<String>::new());
    assert_eq!(wrong, Vec::<String>::new());
}
