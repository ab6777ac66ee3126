//! A service that is kept as busy as clients legally can: scenarios that take longest to read,
//! batches of thousands, plans that nobody waits for, and connections that hold streams, read
//! slowly or send nothing. Health and lists are answered meanwhile, and it stops in time.

use crate::client::{ask, count_bytes};
use crate::served::{Place, trifle};
use crate::{at_length, percentile};
use serde_json::{Value, json};
use std::io::Write;
use std::net::TcpStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Time that requests in progress have once the service stops [s].
const DRAIN_S: u64 = 5;

/// A kind of load on the service at this address, until the flag is raised.
type Load = fn(&str, &AtomicBool);

/// Raises a flag when it is dropped.
struct Raised<'a>(&'a AtomicBool);

impl Drop for Raised<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// Bodies of 32 points each, with other points in each.
fn polyhedra(count: u32, duration_s: f64) -> Value {
    let body = |body: u32| {
        let point = |point: u32| {
            // A spiral on the sphere, turned from body to body.
            let z = (f64::from(point) + 0.5) / 16.0 - 1.0;
            let angle = 2.4 * f64::from(point) + 0.1 * f64::from(body);
            let radius = (1.0 - z * z).sqrt();
            let round = |x: f64| (x * 1e4).round() / 1e4;
            [
                round(radius * angle.cos()),
                round(radius * angle.sin()),
                round(z),
            ]
        };
        json!({
            "shape": {"polyhedron": {"vertices_m": (0..32).map(point).collect::<Vec<_>>()}},
            "position": {"downstream_m": 1 + 3 * (body / 12), "lateral_m": 3 * (body % 12) as i32 - 18},
        })
    };
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 10, "runout_length_m": 200,
                    "width_m": 100},
        "flow": null,
        "bodies": (0..count).map(body).collect::<Vec<_>>(),
        "duration_s": duration_s,
    })
}

/// A flow of 800,000 points in a channel one cell wide.
fn narrow() -> Value {
    json!({
        "channel": {"inclination_deg": 30, "incline_length_m": 100, "runout_length_m": 100,
                    "width_m": 0.01},
        "flow": {"volume_m3": 0.1, "release": {"height_m": 10, "toe_distance_m": 0.05}},
        "bodies": [], "duration_s": 1,
        "numerics": {"cell_size_m": 0.01, "approach": "full", "symmetry": "full"},
    })
}

fn head(address: &str, method: &str, path: &str, length: usize) -> String {
    format!(
        "{method} {path} HTTP/1.1\r\nHost: {address}\r\nContent-Type: application/json\r\n\
         Content-Length: {length}\r\n\r\n"
    )
}

/// Submits the scenarios that take longest to read.
fn submit_polyhedra(address: &str, stop: &AtomicBool) {
    let text = polyhedra(140, 0.0).to_string();
    while !stop.load(Ordering::Relaxed) {
        // Whatever the answer is, and also if there is none.
        let _ = ask(address, "POST", "/v1/jobs", &text);
    }
}

/// Submits batches of as many scenarios as fit a request.
fn submit_batches(address: &str, stop: &AtomicBool) {
    let jobs = vec![json!({"scenario": trifle()}); 2_000];
    let text = json!({"jobs": jobs}).to_string();
    while !stop.load(Ordering::Relaxed) {
        let _ = ask(address, "POST", "/v1/batches", &text);
    }
}

/// Asks for plans and leaves.
fn leave_plans(address: &str, stop: &AtomicBool) {
    let text = narrow().to_string();
    while !stop.load(Ordering::Relaxed) {
        if let Ok(mut stream) = TcpStream::connect(address) {
            let head = head(address, "POST", "/v1/plans", text.len());
            let _ = stream.write_all(format!("{head}{text}").as_bytes());
            std::thread::sleep(Duration::from_millis(300));
        }
    }
}

/// Holds hundreds of connections: a third follows events, a third reads nothing of its answer, a
/// third sends nothing.
fn hold_connections(address: &str, stop: &AtomicBool) {
    let mut held = Vec::new();
    let most = at_length(100, 300);
    while !stop.load(Ordering::Relaxed) {
        if held.len() >= most {
            held.drain(..most / 10);
        }
        if let Ok(mut stream) = TcpStream::connect(address) {
            let request = match held.len() % 3 {
                0 => head(address, "GET", "/v1/events", 0),
                1 => head(address, "GET", "/openapi.json", 0).repeat(20),
                _ => String::new(),
            };
            let _ = stream.write_all(request.as_bytes());
            held.push(stream);
        }
        std::thread::sleep(Duration::from_millis(at_length(10, 2) as u64));
    }
}

/// Times [s] of requests for a path that must be answered, while the load lasts.
fn probe(address: &str, path: &str, times: usize) -> Vec<f64> {
    let one = |_| {
        std::thread::sleep(Duration::from_millis(20));
        let began = Instant::now();
        let answer = ask(address, "GET", path, "");
        let status = answer.map(|answer| answer.status);
        // A list may be refused where all connections of the address are busy, health never.
        let allowed: &[u16] = if path == "/healthz" {
            &[200]
        } else {
            &[200, 429, 503]
        };
        match status {
            Ok(status) => assert!(allowed.contains(&status), "{path}: {status}"),
            Err(error) => assert_ne!(path, "/healthz", "{error}"),
        }
        began.elapsed().as_secs_f64()
    };
    (0..times).map(one).collect()
}

#[test]
fn health_and_lists_are_answered_while_clients_ask_for_all_they_can() {
    let _turn = crate::turn();
    let drain = DRAIN_S.to_string();
    // Fewer than are held.
    let of_one_address = at_length(48, 128).to_string();
    let loads: [(&str, Load, usize); 4] = [
        ("140 polyhedra of 32 points", submit_polyhedra, 8),
        ("batches of 2,000", submit_batches, 4),
        ("plans that are left", leave_plans, 8),
        ("connections beyond all places", hold_connections, 1),
    ];
    for (name, load, clients) in loads {
        let place = Place::new(&[
            ("SCREE_LIMITS__DRAIN_TIMEOUT_S", &drain),
            ("SCREE_LIMITS__CONNECTIONS_PER_ADDRESS", &of_one_address),
        ]);
        let served = place.serve();
        let address = served.address.clone();
        let stop = AtomicBool::new(false);
        let probes = at_length(20, 500);
        let (stopped_s, mut health_s, mut lists_s, most_bytes) = std::thread::scope(|scope| {
            // Also if a probe fails: the clients would go on.
            let _raised = Raised(&stop);
            for _ in 0..clients {
                scope.spawn(|| load(&address, &stop));
            }
            std::thread::sleep(Duration::from_millis(300));
            let health = scope.spawn(|| probe(&address, "/healthz", probes));
            let lists = scope.spawn(|| probe(&address, "/v1/jobs?limit=100", probes));
            let health_s = health.join().expect("health is answered");
            let lists_s = lists.join().expect("lists are answered");
            let bytes = served.resident_bytes();
            let began = Instant::now();
            served.stop();
            let stopped_s = began.elapsed().as_secs_f64();
            (stopped_s, health_s, lists_s, bytes)
        });
        let p99 = percentile(&mut health_s, 0.99);
        crate::tell(&format!(
            "{name}, {clients} clients: /healthz p99 {:.1}, worst {:.1} ms; a list of 100 p99 \
             {:.1} ms; memory {:.0} MB; stopped after {stopped_s:.2} s",
            p99 * 1e3,
            percentile(&mut health_s, 1.0) * 1e3,
            percentile(&mut lists_s, 0.99) * 1e3,
            most_bytes as f64 * 1e-6,
        ));
        assert!(stopped_s < DRAIN_S as f64 + 1.0, "{name}: {stopped_s} s");
        // The short form shares its cores with whatever tests run beside it.
        assert!(
            p99 < if at_length(0, 1) == 1 { 0.05 } else { 0.5 },
            "{name}: {p99} s"
        );
    }
}

/// Plans that a client could ask for and leave in an hour, one after another: each takes 0.3 s or
/// more before it is left.
const PLANS_OF_AN_HOUR: usize = 12_000;

/// Most memory meanwhile [bytes]: that of the largest flow that is timed, of 200,000 points, and of
/// as many requests as may wait.
const MOST_BYTES: usize = 320_000_000;

#[test]
fn memory_is_bounded_while_plans_are_left() {
    let _turn = crate::turn();
    let place = Place::new(&[]);
    let served = place.serve();
    let address = served.address.as_str();
    let text = narrow().to_string();
    let clients = 8;
    let each = at_length(160, PLANS_OF_AN_HOUR) / clients;
    let leave = |_| {
        if let Ok(mut stream) = TcpStream::connect(address) {
            let head = head(address, "POST", "/v1/plans", text.len());
            let _ = stream.write_all(format!("{head}{text}").as_bytes());
            std::thread::sleep(Duration::from_millis(40));
        }
    };
    let round = |plans: usize| {
        std::thread::scope(|scope| {
            for _ in 0..clients {
                scope.spawn(|| (0..plans).for_each(leave));
            }
        });
        served.peak_resident_bytes()
    };
    let first = round(each / 4);
    let last = round(each - each / 4);
    crate::tell(&format!(
        "{} plans left by {clients} clients: memory at most {:.0} MB after a quarter, {:.0} MB \
         after all",
        each * clients,
        first as f64 * 1e-6,
        last as f64 * 1e-6,
    ));
    assert!(last < MOST_BYTES, "{last} bytes");
    served.stop();
}

/// A cube that turns in the air for so many samples: hardly a digit is as in the sample before.
fn tumbling(samples: usize) -> Value {
    let mut scene = trifle();
    scene["gravity_m_s2"] = 0.01.into();
    scene["sample_interval_s"] = 1e-4.into();
    scene["duration_s"] = (samples as f64 * 1e-4).into();
    let body = &mut scene["bodies"][0];
    body["position"] = json!({"downstream_m": 0.1, "elevation_m": 1});
    body["velocity_m_s"] = json!([0.02, 0.0, 0.05]);
    body["angular_velocity_rad_s"] = json!([3, 2, 1]);
    scene
}

/// Ten clients that pull a large trajectory in each coding, over and over.
#[test]
fn health_is_answered_while_trajectories_are_compressed() {
    let _turn = crate::turn();
    let samples = at_length(2_000, 100_000);
    let place = Place::new(&[]);
    let served = place.serve();
    let job = served.submit(&tumbling(samples));
    served.wait_for_success(&job);
    let address = served.address.as_str();
    for format in ["json", "ndjson", "csv"] {
        for coding in ["identity", "gzip", "zstd"] {
            let path = format!("{job}/trajectory?format={format}");
            let bytes = count_bytes(address, &path, coding).expect("an answer");
            let stop = AtomicBool::new(false);
            let before = served.resident_bytes();
            let began = Instant::now();
            let (mut health_s, pulls, most) = std::thread::scope(|scope| {
                let _raised = Raised(&stop);
                let pull = || {
                    let pulled = || count_bytes(address, &path, coding).expect("an answer");
                    let pulls = std::iter::repeat_with(pulled);
                    pulls.take_while(|_| !stop.load(Ordering::Relaxed)).count()
                };
                let clients: Vec<_> = (0..10).map(|_| scope.spawn(pull)).collect();
                std::thread::sleep(Duration::from_millis(300));
                let health_s = probe(address, "/healthz", at_length(20, 500));
                let most = served.resident_bytes();
                stop.store(true, Ordering::Relaxed);
                let pulls = clients.into_iter().map(|client| client.join());
                let pulls: usize = pulls.map(|pulls| pulls.expect("a client")).sum();
                (health_s, pulls, most)
            });
            let p99 = percentile(&mut health_s, 0.99);
            crate::tell(&format!(
                "ten clients pull {samples} samples as {format}, {coding}, {:.2} MB: {:.1} a \
                 second in all; /healthz p99 {:.1}, worst {:.1} ms; memory {:+.1} MB",
                bytes as f64 * 1e-6,
                pulls as f64 / began.elapsed().as_secs_f64(),
                p99 * 1e3,
                percentile(&mut health_s, 1.0) * 1e3,
                (most as f64 - before as f64) * 1e-6,
            ));
            // The short form shares its cores with whatever tests run beside it.
            assert!(
                p99 < if at_length(0, 1) == 1 { 0.05 } else { 0.5 },
                "{format} {coding}: {p99} s"
            );
        }
    }
    served.stop();
}
