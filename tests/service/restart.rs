//! Effect of a stop or a crash on jobs.

use crate::app::{
    TestApp, config, database, endless_scene, has_ended, is_running, long_scene, tiny_scene,
};
use scree::jobs::store::sqlite::SqliteStore;
use scree::jobs::store::{
    Claimant, JobStore, Lease, Pack, Room, Solver, Submission, TOLERATED_SETBACKS, TerrainStore,
};
use scree::jobs::submit;
use scree::service::{self, StartError};
use scree::terrains::ScenarioReader;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;
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
    // The interrupted job is in the queue again, so it is the first to run.
    let again = app.wait(&running, is_running).await;
    assert_eq!(again["attempt"], 2);
    app.delete(&running).await;
    app.wait_for_success(&waiting).await;
    app.stop().await;
}

/// A stop in the middle of a run saves it, and after the next start it continues
/// to the bits of an uninterrupted run.
#[tokio::test(flavor = "multi_thread")]
async fn a_stopped_job_goes_on_where_it_was_with_the_same_bits() {
    let app = TestApp::start().await;
    let whole = app.submit(&long_scene()).await;
    let whole_job = app.wait_for_success(&whole).await;
    let trajectory = app.get(&format!("{whole}/trajectory")).await.body["columns"].take();
    let cut = app.submit(&long_scene()).await;
    let mut directory = Some(app.stop_under(&cut).await);
    let mut resumed_from_s = 0.0;
    for attempt in 2..=4 {
        let app = TestApp::start_in(directory.take().unwrap(), |_| {}).await;
        let job = app
            .wait(&cut, |job| is_running(job) || has_ended(job))
            .await;
        assert_eq!(job["attempt"], attempt, "{job:#}");
        app.wait(&cut, |job| {
            !job["attempts"][attempt - 1]["resumed_from_s"].is_null()
        })
        .await;
        let attempts = app.get(&cut).await.body["attempts"].take();
        assert_eq!(attempts[attempt - 2]["ending"], "handed-back");
        let from_s = attempts[attempt - 1]["resumed_from_s"].as_f64().unwrap();
        assert!(from_s > resumed_from_s, "{from_s} after {resumed_from_s}");
        resumed_from_s = from_s;
        directory = Some(app.stop_under(&cut).await);
    }
    let app = TestApp::start_in(directory.take().unwrap(), |_| {}).await;
    let job = app.wait_for_success(&cut).await;
    let fingerprint = |job: &Value| job["provenance"]["fingerprint"].clone();
    assert_eq!(fingerprint(&job), fingerprint(&whole_job));
    assert_eq!(job["outcome"]["bodies"], whole_job["outcome"]["bodies"]);
    assert_eq!(
        job["outcome"]["conservation"],
        whole_job["outcome"]["conservation"]
    );
    let again = app.get(&format!("{cut}/trajectory")).await.body["columns"].take();
    assert_eq!(again, trajectory);
    app.stop().await;
}

/// The same for runs behind uncertainty intervals, and for those of a target.
#[tokio::test(flavor = "multi_thread")]
async fn several_runs_go_on_where_they_were_with_the_same_bits() {
    for accuracy in [
        json!({"error_bars": true}),
        json!({"target": 0.5, "quantity": "displacement_m", "budget_point_steps": 4e5}),
    ] {
        let mut scene = tiny_scene();
        scene["duration_s"] = json!(0.5);
        if accuracy["error_bars"].is_null() {
            scene["numerics"]["cell_size_m"] = Value::Null;
        }
        scene["accuracy"] = accuracy;
        let app = TestApp::start().await;
        let whole = app.submit(&scene).await;
        let whole = app.wait_for_success(&whole).await;
        let cut = app.submit(&scene).await;
        let mut directory = Some(app.stop_under(&cut).await);
        for _ in 0..3 {
            let app = TestApp::start_in(directory.take().unwrap(), |_| {}).await;
            app.wait(&cut, |job| is_running(job) || has_ended(job))
                .await;
            directory = Some(app.stop_under(&cut).await);
        }
        let app = TestApp::start_in(directory.take().unwrap(), |_| {}).await;
        let job = app.wait_for_success(&cut).await;
        let attempts = job["attempts"].as_array().unwrap();
        let resumed = |attempt: &&Value| attempt["resumed_from_s"].as_f64() > Some(0.0);
        assert!(
            attempts.iter().any(|attempt| resumed(&attempt)),
            "{attempts:?}"
        );
        let fingerprint = |job: &Value| job["provenance"]["fingerprint"].clone();
        assert_eq!(fingerprint(&job), fingerprint(&whole));
        for part in ["bodies", "flow", "conservation"] {
            assert_eq!(job["outcome"][part], whole["outcome"][part]);
        }
        app.stop().await;
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_a_crash_cut_off_is_run_again_from_its_start() {
    let directory = TempDir::new().unwrap();
    let lease = cut_off(&directory, 1).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    let job = app
        .wait_for_success(&format!("/v1/jobs/{}", lease.job))
        .await;
    assert_eq!(job["attempt"], 2);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_keeps_taking_the_service_down_fails() {
    let directory = TempDir::new().unwrap();
    let lease = cut_off(&directory, TOLERATED_SETBACKS).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    let job = app.get(&format!("/v1/jobs/{}", lease.job)).await.body;
    assert_eq!(job["status"], "failed");
    assert_eq!(job["problem"]["type"], "urn:scree:failure:cut-off");
    assert_eq!(job["problem"]["cut_offs"], 3);
    assert_eq!(job["outcome"], Value::Null);
    app.stop().await;
}

/// Leaves a database like that of services that died `times` times during a job.
async fn cut_off(directory: &TempDir, times: u32) -> Lease {
    let store = Arc::new(SqliteStore::open(&database(directory)).await.unwrap());
    let reader = ScenarioReader::new(Arc::clone(&store) as Arc<dyn TerrainStore>);
    let means = submit::Means {
        memory_bytes: u64::MAX,
        threads_per_worker: 1,
        point_steps: None,
    };
    let new = submit::validate(&tiny_scene().to_string(), (&means, &reader), Vec::new()).unwrap();
    let submission = Submission {
        jobs: &[new],
        submitter: None,
        key: None,
        room: Room {
            queue: 1,
            submitter: None,
        },
    };
    store.submit(&submission).await.unwrap();
    let claimant = Claimant {
        owner: config(directory).queue.name,
        lease_duration: Duration::from_secs(30),
        solver: Solver {
            version: "0",
            commit: "",
            instructions: "",
        },
        up_for: Duration::from_secs(3_600),
        pack: Pack::SINGLE,
        memory_bytes: u64::MAX >> 1,
    };
    for _ in 1..times {
        assert_eq!(store.claim(&claimant).await.unwrap().len(), 1);
        store.reclaim_own(&claimant.owner).await.unwrap();
    }
    let claim = store.claim(&claimant).await.unwrap().remove(0);
    store.close().await;
    claim.lease
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
    // Reported together with all other faults.
    scene["gravity_m_s2"] = json!(-1);
    let answer = app.post("application/json", scene.to_string()).await;
    assert_eq!(
        answer.wrong_fields(),
        ["/gravity_m_s2", "/numerics/threads"]
    );
    app.stop().await;
}
