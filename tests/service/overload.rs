//! Overload by one client, which does not take the service away from the others.

use crate::app::{DEADLINE, TestApp, endless_scene, is_running, tiny_scene};
use reqwest::StatusCode;
use serde_json::{Value, json};
use std::time::{Duration, Instant};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::{sleep, timeout};

/// A heap of stiff cubes without a flow: each millisecond takes many seconds.
fn heap(duration_s: f64) -> Value {
    let cube = |n: u32| {
        let [x, y, z] = [n % 6, n / 6 % 4, n / 24].map(|k| f64::from(k) * 0.0405);
        json!({
            "shape": {"cube": {"side_m": 0.04}},
            "position": {"downstream_m": 0.2 + x, "lateral_m": y - 0.06, "elevation_m": 0.0201 + z},
            "contact_modulus_pa": 1e12, "restitution": 0.9, "friction": 0.1,
        })
    };
    json!({
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 2},
        "flow": null, "bodies": (0..96).map(cube).collect::<Vec<_>>(),
        "duration_s": duration_s, "sample_interval_s": duration_s,
        "numerics": {"ending": "full"},
    })
}

/// A request on a connection of its own, whose answer is not read.
async fn send(app: &TestApp, method: &str, path: &str, body: &str) -> TcpStream {
    let mut stream = TcpStream::connect(app.address()).await.unwrap();
    let head = format!(
        "{method} {path} HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        app.address(),
        body.len()
    );
    stream.write_all(head.as_bytes()).await.unwrap();
    stream
}

/// The first line of the answer.
pub(crate) async fn status_line(stream: &mut TcpStream) -> String {
    let mut line = Vec::new();
    while !line.ends_with(b"\r\n") {
        let byte = timeout(DEADLINE, stream.read_u8()).await.unwrap();
        line.push(byte.expect("an answer"));
    }
    String::from_utf8(line).unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_plan_whose_client_left_makes_room_for_the_next() {
    let app = TestApp::start_with(|config| config.admission.time_limit_s = 600.0).await;
    for _ in 0..3 {
        let client = send(&app, "POST", "/v1/plans", &heap(3600.0).to_string()).await;
        sleep(Duration::from_millis(300)).await;
        drop(client);
    }
    let scene = tiny_scene().to_string();
    let planned = app.post_to("/v1/plans", "application/json", scene);
    let planned = timeout(DEADLINE, planned)
        .await
        .expect("the timings are over");
    assert_eq!(planned.status, StatusCode::OK, "{:#}", planned.body);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_plan_that_takes_too_long_says_so() {
    let app = TestApp::start_with(|config| config.admission.time_limit_s = 0.2).await;
    let refused = app
        .post_to("/v1/plans", "application/json", heap(3600.0).to_string())
        .await;
    refused.assert_problem(StatusCode::SERVICE_UNAVAILABLE, "timed-out");
    assert!(
        refused.body["detail"]
            .as_str()
            .unwrap()
            .contains("admission.time_limit_s")
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_service_stops_in_time_whatever_its_jobs_do() {
    let app = TestApp::start_with(|config| config.limits.drain_timeout_s = 2.0).await;
    let job = app.submit(&heap(3600.0)).await;
    app.wait(&job, is_running).await;
    sleep(Duration::from_millis(200)).await;
    let began = Instant::now();
    let directory = app.stop().await;
    let took = began.elapsed();
    assert!(took < Duration::from_secs(3), "{took:?}");
    let app = TestApp::start_in(directory, |_| {}).await;
    app.wait(&job, is_running).await;
    let dismissed = app.delete(&job).await;
    assert_eq!(dismissed.body["status"], "dismissed");
    assert_eq!(dismissed.body["attempts"][0]["ending"], "handed-back");
    app.stop().await;
}

/// A flow whose points take seconds to be set up.
fn large() -> Value {
    json!({
        "channel": {"inclination_deg": 30, "incline_length_m": 4, "runout_length_m": 2,
                    "width_m": 2},
        "flow": {"volume_m3": 0.4, "release": {"height_m": 0.2, "toe_distance_m": 0.05}},
        "bodies": [], "duration_s": 1,
        "numerics": {"cell_size_m": 0.014, "approach": "full", "symmetry": "full"},
    })
}

#[tokio::test(flavor = "multi_thread")]
async fn a_service_stops_in_time_while_a_large_run_is_set_up() {
    let app = TestApp::start_with(|config| config.limits.drain_timeout_s = 0.3).await;
    let job = app.submit(&large()).await;
    app.wait(&job, is_running).await;
    let began = Instant::now();
    let directory = app.stop().await;
    let took = began.elapsed();
    assert!(took < Duration::from_millis(1_300), "{took:?}");
    let app = TestApp::start_in(directory, |config| config.workers.count = Some(1)).await;
    let waiting = app.get(&job).await.body;
    assert_eq!(
        waiting["attempts"][0]["ending"], "handed-back",
        "{waiting:#}"
    );
    app.delete(&job).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_takes_too_much_is_refused_before_or_fails_alone() {
    let limit = Some(1_000_000_000);
    let app = TestApp::start_with(|config| config.limits.job_point_steps = limit).await;
    let refused = app.post("application/json", heap(3600.0).to_string()).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    assert_eq!(refused.body["errors"][0]["unit"], "point-steps");
    app.stop().await;
    let app = TestApp::start_with(|config| config.limits.job_wall_time_s = 0.5).await;
    let slow = app.submit(&endless_scene()).await;
    let small = app.submit(&tiny_scene()).await;
    let failed = app.wait(&slow, |job| job["status"] == "failed").await;
    assert_eq!(failed["problem"]["type"], "urn:scree:failure:wall-time");
    assert!(
        failed["problem"]["spent_s"].as_f64() > Some(0.5),
        "{failed:#}"
    );
    app.wait_for_success(&small).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn memory_and_results_have_limits() {
    let app = TestApp::start_with(|config| config.limits.job_memory_bytes = Some(4_100_000)).await;
    let refused = app.post("application/json", tiny_scene().to_string()).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    let error = &refused.body["errors"][0];
    assert_eq!(error["unit"], "bytes");
    assert!(error["allowed"].as_str().unwrap().contains("4100000"));
    app.stop().await;
    let app = TestApp::start_with(|config| config.limits.job_results_bytes = Some(20_000)).await;
    let mut chatty = tiny_scene();
    chatty["sample_interval_s"] = json!(1e-5);
    let job = app.submit(&chatty).await;
    let failed = app.wait(&job, |job| job["status"] == "failed").await;
    let problem = &failed["problem"];
    assert_eq!(problem["type"], "urn:scree:failure:results-size");
    assert!(
        problem["needed_bytes"].as_u64().unwrap() > 20_000,
        "{problem}"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn whoever_holds_connections_and_streams_leaves_room_for_the_operator() {
    let app = TestApp::start_with(|config| {
        config.limits.connections = 8;
        config.limits.connections_per_address = 8;
        config.limits.operator_connections = 2;
        config.limits.streams = 6;
        config.limits.streams_per_caller = 6;
    })
    .await;
    let job = app.submit(&endless_scene()).await;
    let mut held = Vec::new();
    for _ in 0..6 {
        let mut stream = send(&app, "GET", "/v1/events", "").await;
        assert!(status_line(&mut stream).await.contains(" 200 "));
        held.push(stream);
    }
    let mut refused = send(&app, "GET", &format!("{job}?wait=60s"), "").await;
    assert!(status_line(&mut refused).await.contains(" 429 "));
    // Silent connections beyond all places: they make room.
    for _ in 0..20 {
        held.push(TcpStream::connect(app.address()).await.unwrap());
    }
    for path in ["/healthz", "/readyz", "/metrics"] {
        let mut stream = send(&app, "GET", path, "").await;
        assert!(status_line(&mut stream).await.contains(" 200 "), "{path}");
    }
    let mut dismissal = send(&app, "DELETE", &job, "").await;
    assert!(status_line(&mut dismissal).await.contains(" 200 "));
    app.stop().await;
}

/// Requests in a row on one connection that reads none of their answers.
async fn send_many(app: &TestApp, path: &str) -> TcpStream {
    let mut stream = TcpStream::connect(app.address()).await.unwrap();
    let head = format!("GET {path} HTTP/1.1\r\nHost: {}\r\n\r\n", app.address());
    // Some megabytes of answers: more than the system's buffers take.
    let requests = head.repeat(4_000);
    let written = stream.write_all(requests.as_bytes());
    let _is_blocked = timeout(Duration::from_millis(100), written).await;
    stream
}

#[tokio::test(flavor = "multi_thread")]
async fn whoever_takes_no_answer_or_sends_half_a_body_makes_room_for_others() {
    let app = TestApp::start_with(|config| {
        config.limits.connections = 6;
        config.limits.connections_per_address = 6;
        config.limits.operator_connections = 2;
        config.limits.write_timeout_s = 600.0;
        config.limits.body_read_timeout_s = 600.0;
    })
    .await;
    let mut held = Vec::new();
    for _ in 0..3 {
        held.push(send_many(&app, "/openapi.json").await);
        let mut half = send(&app, "POST", "/v1/jobs", "").await;
        let head = format!(
            "POST /v1/jobs HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\n\
             Content-Length: 100\r\n\r\n{{",
            app.address()
        );
        assert!(status_line(&mut half).await.contains(" 400 "));
        half.write_all(head.as_bytes()).await.unwrap();
        held.push(half);
    }
    // Those that come now have the operator's places, and don't hold them.
    for _ in 0..6 {
        held.push(send_many(&app, "/metrics").await);
    }
    // An answer in progress holds its place, for far less than a client that waits is left its own.
    sleep(Duration::from_millis(500)).await;
    for path in ["/healthz", "/readyz", "/metrics"] {
        let mut stream = send(&app, "GET", path, "").await;
        assert!(status_line(&mut stream).await.contains(" 200 "), "{path}");
    }
    sleep(Duration::from_millis(1_200)).await;
    for _ in 0..6 {
        let mut stream = send(&app, "GET", "/v1/jobs", "").await;
        assert!(status_line(&mut stream).await.contains(" 200 "));
    }
    app.stop().await;
}
