//! What a stop or a crash does to jobs.

use crate::app::{TestApp, config, database, endless_scene, is_running, tiny_scene};
use scree::jobs::store::{Hold, Store, TOLERATED_CUT_OFFS};
use scree::jobs::submit;
use scree::service::{self, StartError};
use serde_json::{Value, json};
use tempfile::TempDir;

#[tokio::test(flavor = "multi_thread")]
async fn results_and_waiting_jobs_survive_a_restart() {
    let app = TestApp::start().await;
    let done = app.submit(&tiny_scene()).await;
    app.wait_for_success(&done).await;
    let trajectory = app.get(&format!("{done}/trajectory")).await.body;
    let running = app.submit(&endless_scene()).await;
    let waiting = app.submit(&tiny_scene()).await;
    app.wait_for_samples(&running).await;
    let directory = app.stop().await;

    let app = TestApp::start_in(directory, |_| {}).await;
    assert_eq!(
        app.get(&format!("{done}/trajectory")).await.body,
        trajectory
    );
    // The interrupted job was put back, so it is the first to run again.
    let again = app.wait(&running, is_running).await;
    assert_eq!(again["attempt"], 2);
    app.delete(&running).await;
    app.wait_for_success(&waiting).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stop_puts_running_jobs_back_to_their_start() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    app.wait_for_samples(&job).await;
    let id = job.rsplit('/').next().unwrap().parse().unwrap();
    let directory = app.stop().await;

    let store = Store::open(&database(&directory)).await.unwrap();
    let job = store.job(id).await.unwrap().unwrap();
    assert_eq!(job.summary.status.word(), "accepted");
    assert_eq!(job.summary.started, None);
    assert_eq!(job.summary.progress.steps, 0);
    assert!(
        store
            .chunk(id, 0, 0, &Default::default())
            .await
            .unwrap()
            .is_none()
    );
    assert!(store.snapshot(id, None).await.unwrap().is_none());
    store.close().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_a_crash_cut_off_is_run_again_from_its_start() {
    let directory = TempDir::new().unwrap();
    let hold = cut_off(&directory, 1).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    let job = app
        .wait_for_success(&format!("/v1/jobs/{}", hold.job))
        .await;
    assert_eq!(job["attempt"], 2);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_keeps_taking_the_service_down_fails() {
    let directory = TempDir::new().unwrap();
    let hold = cut_off(&directory, TOLERATED_CUT_OFFS).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    let job = app.get(&format!("/v1/jobs/{}", hold.job)).await.body;
    assert_eq!(job["status"], "failed");
    assert_eq!(job["problem"]["type"], "urn:scree:failure:cut-off");
    assert_eq!(job["problem"]["cut_offs"], 3);
    assert_eq!(job["outcome"], Value::Null);
    app.stop().await;
}

/// Leaves a database as services leave it that died `times` times under a job.
async fn cut_off(directory: &TempDir, times: u32) -> Hold {
    let store = Store::open(&database(directory)).await.unwrap();
    let new = submit::admit(&tiny_scene().to_string(), 1).unwrap();
    store.submit(&new).await.unwrap();
    for _ in 1..times {
        store.claim("0").await.unwrap().unwrap();
        store.recover().await.unwrap();
    }
    let claim = store.claim("0").await.unwrap().unwrap();
    store.close().await;
    claim.hold
}

#[tokio::test(flavor = "multi_thread")]
async fn two_services_can_not_share_a_database() {
    let app = TestApp::start().await;
    let directory = app.stop().await;
    let first = service::start(config(&directory)).await.unwrap();
    let second = service::start(config(&directory)).await;
    assert!(matches!(second, Err(StartError::Store(_))), "{second:?}");
    first.stop().await;
    service::start(config(&directory))
        .await
        .unwrap()
        .stop()
        .await;
}

#[tokio::test(flavor = "multi_thread")]
async fn only_loopback_is_listened_on() {
    let directory = TempDir::new().unwrap();
    for address in ["0.0.0.0:0", "[::]:0", "192.168.1.7:0"] {
        let mut config = config(&directory);
        config.listen = address.parse().unwrap();
        let refused = service::start(config).await.unwrap_err();
        assert!(matches!(refused, StartError::Config(_)), "{refused:?}");
        assert!(refused.to_string().contains("loopback"), "{refused}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn more_threads_than_a_worker_has_are_refused() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["numerics"]["threads"] = json!(2);
    let answer = app.post("application/json", scene.to_string()).await;
    answer.assert_problem(
        reqwest::StatusCode::UNPROCESSABLE_ENTITY,
        "invalid-scenario",
    );
    assert_eq!(answer.wrong_fields(), ["/numerics/threads"]);
    assert_eq!(answer.body["errors"][0]["allowed"], "1 <= x <= 1");
    // Said together with whatever else is wrong.
    scene["gravity_m_s2"] = json!(-1);
    let answer = app.post("application/json", scene.to_string()).await;
    assert_eq!(
        answer.wrong_fields(),
        ["/gravity_m_s2", "/numerics/threads"]
    );
    app.stop().await;
}
