//! Dismissing jobs.

use crate::app::{TestApp, endless_scene, is_running, tiny_scene};
use jiff::Timestamp;
use reqwest::StatusCode;
use serde_json::Value;

#[tokio::test(flavor = "multi_thread")]
async fn a_waiting_job_is_dismissed_and_never_starts() {
    let app = TestApp::start().await;
    let running = app.submit(&endless_scene()).await;
    app.wait(&running, is_running).await;
    let waiting = app.submit(&tiny_scene()).await;
    let next = app.submit(&tiny_scene()).await;

    let answer = app.delete(&waiting).await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.body["status"], "dismissed");
    assert_eq!(answer.body["started"], Value::Null);
    app.delete(&running).await;
    // The job after it ran, so its own turn has passed.
    app.wait_for_success(&next).await;
    let job = app.get(&waiting).await.body;
    assert_eq!(
        (&job["status"], &job["attempt"]),
        (&"dismissed".into(), &0.into())
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_running_job_stops_within_half_a_second_and_keeps_what_it_has() {
    let app = TestApp::start().await;
    let running = app.submit(&endless_scene()).await;
    app.wait_for_samples(&running).await;
    let next = app.submit(&tiny_scene()).await;

    let answer = app.delete(&running).await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.body["status"], "dismissed");
    assert_eq!(answer.body["outcome"], Value::Null);
    assert!(answer.body["progress"]["fraction"].as_f64().unwrap() > 0.0);
    let kept = app.get(&format!("{running}/trajectory")).await.body;
    assert!(!kept["columns"]["time_s"].as_array().unwrap().is_empty());

    // The only worker is free again once the next job has started.
    let next = app.wait_for_success(&next).await;
    let stopped = milliseconds(&next["started"]) - milliseconds(&answer.body["finished"]);
    assert!(
        (0..500).contains(&stopped),
        "the run took {stopped} ms to stop"
    );
    assert_eq!(app.get(&format!("{running}/trajectory")).await.body, kept);
    assert_eq!(app.get(&running).await.body, answer.body);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn dismissing_again_changes_nothing() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    let first = app.delete(&job).await;
    let second = app.delete(&job).await;
    assert_eq!(
        (first.status, second.status),
        (StatusCode::OK, StatusCode::OK)
    );
    assert_eq!(first.body["finished"], second.body["finished"]);
    assert_eq!(second.body["status"], "dismissed");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_has_ended_can_not_be_dismissed() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    let before = app.wait_for_success(&job).await;
    app.delete(&job)
        .await
        .assert_problem(StatusCode::CONFLICT, "job-ended");
    assert_eq!(app.get(&job).await.body, before);
    app.stop().await;
}

fn milliseconds(time: &Value) -> i64 {
    time.as_str()
        .unwrap()
        .parse::<Timestamp>()
        .unwrap()
        .as_millisecond()
}
