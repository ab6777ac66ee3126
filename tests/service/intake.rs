//! Submissions: limits, repetition, and search of jobs.

use crate::app::{Answer, TestApp, endless_scene, is_running, tiny_scene};
use reqwest::StatusCode;
use serde_json::{Value, json};

async fn post_with_key(app: &TestApp, path: &str, key: &str, body: &Value) -> Answer {
    let request = app.client.post(app.url(path));
    let request = request
        .header("content-type", "application/json")
        .header("idempotency-key", key)
        .body(body.to_string());
    Answer::read(request.send().await.unwrap()).await
}

#[tokio::test(flavor = "multi_thread")]
async fn the_same_request_with_the_same_key_gets_the_same_job() {
    let app = TestApp::start().await;
    let first = post_with_key(&app, "/v1/jobs", "night-1", &tiny_scene()).await;
    assert_eq!(first.status, StatusCode::ACCEPTED);
    app.wait_for_success(first.location.as_ref().unwrap()).await;
    let again = post_with_key(&app, "/v1/jobs", "night-1", &tiny_scene()).await;
    assert_eq!(again.status, StatusCode::ACCEPTED);
    assert_eq!(again.location, first.location);
    let other_body = post_with_key(&app, "/v1/jobs", "night-1", &endless_scene()).await;
    other_body.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "key-of-another-request");
    let other_query = post_with_key(&app, "/v1/jobs?label=a", "night-1", &tiny_scene()).await;
    other_query.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "key-of-another-request");
    let other_key = post_with_key(&app, "/v1/jobs", "night-2", &tiny_scene()).await;
    assert_ne!(other_key.location, first.location);
    for key in [" ", &"x".repeat(256)] {
        let refused = post_with_key(&app, "/v1/jobs", key, &tiny_scene()).await;
        refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-key");
    }
    let twice = app.client.post(app.url("/v1/jobs"));
    let twice = twice
        .header("content-type", "application/json")
        .header("idempotency-key", "night-3")
        .header("idempotency-key", "night-4")
        .body(tiny_scene().to_string());
    let refused = Answer::read(twice.send().await.unwrap()).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-key");
    let jobs = app.get("/v1/jobs").await.body["jobs"].take();
    assert_eq!(jobs.as_array().unwrap().len(), 2);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_brings_the_answer_of_the_first_request_word_by_word() {
    let app = TestApp::start().await;
    let first = post_with_key(&app, "/v1/jobs", "a", &tiny_scene()).await;
    let job = first.location.clone().unwrap();
    app.wait_for_success(&job).await;
    let reused = post_with_key(&app, "/v1/jobs?reuse=finished", "b", &tiny_scene()).await;
    assert_eq!(
        (reused.status, &reused.location),
        (StatusCode::OK, &first.location)
    );
    assert_eq!(reused.body["status"], "successful");
    let removed = app.delete(&format!("{job}?remove=ended")).await;
    assert_eq!(removed.status, StatusCode::NO_CONTENT);
    let cases = [
        ("/v1/jobs", "a", first),
        ("/v1/jobs?reuse=finished", "b", reused),
    ];
    for (path, key, before) in cases {
        let again = post_with_key(&app, path, key, &tiny_scene()).await;
        assert_eq!(
            (again.status, again.location),
            (before.status, before.location)
        );
        assert_eq!(again.body, before.body);
        let other = post_with_key(&app, path, key, &endless_scene()).await;
        other.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "key-of-another-request");
    }
    let jobs = app.get("/v1/jobs").await;
    assert_eq!(
        jobs.body["jobs"],
        json!([]),
        "no job was made by a repetition"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_key_answers_the_same_after_some_of_its_jobs_are_removed() {
    let app = TestApp::start().await;
    let scenes = ["A", "B", "C"].map(|title| {
        let mut scene = tiny_scene();
        scene["title"] = json!(title);
        json!({ "scenario": scene })
    });
    let batch = json!({ "jobs": scenes });
    let first = post_with_key(&app, "/v1/batches", "k", &batch).await;
    let ids = first.body["ids"].as_array().unwrap().clone();
    assert_eq!(ids.len(), 3);
    let path = |id: &Value| format!("/v1/jobs/{}", id.as_str().unwrap());
    app.wait_for_success(&path(&ids[0])).await;
    let removed = app.delete(&format!("{}?remove=ended", path(&ids[0]))).await;
    assert_eq!(removed.status, StatusCode::NO_CONTENT);
    let again = post_with_key(&app, "/v1/batches", "k", &batch).await;
    assert_eq!((again.status, &again.body), (first.status, &first.body));
    let second = app.get(&path(&ids[1])).await;
    assert_eq!(second.body["scenario"]["title"], "B");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn many_at_once_with_one_key_make_one_job() {
    let app = TestApp::start().await;
    let (path, scene) = ("/v1/jobs", tiny_scene());
    let ask = || post_with_key(&app, path, "at-once", &scene);
    let answers = tokio::join!(ask(), ask(), ask(), ask(), ask(), ask());
    let answers = [
        answers.0, answers.1, answers.2, answers.3, answers.4, answers.5,
    ];
    let mut locations = Vec::new();
    for answer in &answers {
        match answer.status {
            StatusCode::ACCEPTED => locations.push((&answer.location, &answer.body)),
            _ => answer.assert_problem(StatusCode::CONFLICT, "key-in-use"),
        }
    }
    locations.dedup();
    assert_eq!(locations.len(), 1);
    let jobs = app.get("/v1/jobs").await.body["jobs"].take();
    assert_eq!(jobs.as_array().unwrap().len(), 1);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_finished_scenario_is_used_again_when_asked_and_only_then() {
    let app = TestApp::start().await;
    let first = app.submit(&tiny_scene()).await;
    app.wait_for_success(&first).await;
    let mut spelt_out = tiny_scene();
    spelt_out["gravity_m_s2"] = json!(9.81);
    let ask = async |path: &str, scene: &Value| {
        let request = app.client.post(app.url(path));
        let request = request.header("content-type", "application/json");
        Answer::read(request.body(scene.to_string()).send().await.unwrap()).await
    };
    let reused = ask("/v1/jobs?reuse=finished", &spelt_out).await;
    assert_eq!(reused.status, StatusCode::OK);
    assert_eq!(reused.location.as_ref(), Some(&first));
    assert_eq!(reused.body["status"], "successful");
    let unasked = ask("/v1/jobs", &tiny_scene()).await;
    assert_ne!(unasked.location.as_ref(), Some(&first));
    spelt_out["gravity_m_s2"] = json!(9.80);
    let other = ask("/v1/jobs?reuse=finished", &spelt_out).await;
    assert_eq!(other.status, StatusCode::ACCEPTED);
    ask("/v1/jobs?reuse=yes", &tiny_scene())
        .await
        .assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_batch_is_accepted_whole_or_not_at_all() {
    let app = TestApp::start().await;
    let batch = json!({
        "labels": ["study:alps"],
        "jobs": [{"scenario": tiny_scene(), "labels": ["run:1", "run:1"]}, {"scenario": tiny_scene()}]
    });
    let answer = post_with_key(&app, "/v1/batches", "batch-1", &batch).await;
    assert_eq!(answer.status, StatusCode::ACCEPTED, "{:#}", answer.body);
    let again = post_with_key(&app, "/v1/batches", "batch-1", &batch).await;
    assert_eq!(again.body, answer.body);
    let ids = answer.body["ids"].as_array().unwrap();
    assert_eq!(ids.len(), 2);
    let first = app
        .get(&format!("/v1/jobs/{}", ids[0].as_str().unwrap()))
        .await;
    assert_eq!(first.body["labels"], json!(["run:1", "study:alps"]));

    let mut broken = tiny_scene();
    broken["duration_s"] = json!(-1);
    let batch = json!({
        "labels": ["no spaces"],
        "jobs": [{"scenario": tiny_scene()}, {"scenario": broken}, {"scenario": {}, "labels": [""]}]
    });
    let refused = post_with_key(&app, "/v1/batches", "batch-2", &batch).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    let wrong = refused.wrong_fields();
    for pointer in [
        "/labels/0",
        "/jobs/1/scenario/duration_s",
        "/jobs/2/labels/0",
    ] {
        assert!(wrong.contains(&pointer), "{pointer}: {wrong:?}");
    }
    assert!(
        wrong
            .iter()
            .any(|pointer| pointer.starts_with("/jobs/2/scenario"))
    );
    for (body, kind) in [
        (json!({"jobs": []}), "invalid-scenario"),
        (json!({"jobs": [{"scene": 1}]}), "invalid-batch"),
        (json!([]), "invalid-batch"),
    ] {
        let refused = post_with_key(&app, "/v1/batches", "batch-3", &body).await;
        refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, kind);
    }
    let jobs = app.get("/v1/jobs?label=study:alps").await.body["jobs"].take();
    assert_eq!(jobs.as_array().unwrap().len(), 2);
    assert_eq!(
        app.get("/v1/jobs?label=run:1").await.body["jobs"][0]["id"],
        ids[0]
    );
    let both = app.get("/v1/jobs?label=run:1&status=failed").await.body;
    assert_eq!(both["jobs"], json!([]));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_queue_says_when_to_come_back() {
    let app = TestApp::start_with(|config| config.limits.queued_jobs = 2).await;
    let running = app.submit(&endless_scene()).await;
    app.wait(&running, is_running).await;
    let waiting = app.submit(&tiny_scene()).await;
    let batch = json!({"jobs": [{"scenario": tiny_scene()}, {"scenario": tiny_scene()}]});
    let refused = post_with_key(&app, "/v1/batches", "b", &batch).await;
    refused.assert_problem(StatusCode::TOO_MANY_REQUESTS, "queue-full");
    app.submit(&tiny_scene()).await;
    let request = app.client.post(app.url("/v1/jobs"));
    let request = request.header("content-type", "application/json");
    let response = request.body(tiny_scene().to_string()).send().await.unwrap();
    assert_eq!(response.headers()["retry-after"], "10");
    Answer::read(response)
        .await
        .assert_problem(StatusCode::TOO_MANY_REQUESTS, "queue-full");
    app.delete(&waiting).await;
    app.submit(&tiny_scene()).await;
    app.delete(&running).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_is_removed_once_it_has_ended_with_all_that_it_recorded() {
    let app = TestApp::start().await;
    let done = app.submit(&tiny_scene()).await;
    app.wait_for_success(&done).await;
    let running = app.submit(&endless_scene()).await;
    let remove = |job: &str| format!("{job}?remove=ended");
    app.delete(&remove(&running))
        .await
        .assert_problem(StatusCode::CONFLICT, "job-active");
    assert_eq!(
        app.delete(&remove(&done)).await.status,
        StatusCode::NO_CONTENT
    );
    for path in [
        done.clone(),
        format!("{done}/trajectory"),
        format!("{done}/flow"),
    ] {
        let gone = app.get(&path).await;
        gone.assert_problem(StatusCode::NOT_FOUND, "unknown-job");
    }
    app.delete(&remove(&done))
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-job");
    app.delete(&running).await;
    assert_eq!(
        app.delete(&remove(&running)).await.status,
        StatusCode::NO_CONTENT
    );
    app.delete("/v1/jobs/x?remove=all")
        .await
        .assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn ended_jobs_are_removed_when_their_time_has_come_and_others_never() {
    let app = TestApp::start_with(|config| {
        // A hundredth of a second.
        config.retention.ended_jobs_d = Some(1.2e-7);
        config.queue.heartbeat_interval_s = 0.05;
    })
    .await;
    let running = app.submit(&endless_scene()).await;
    app.wait(&running, is_running).await;
    let ended = app.submit(&tiny_scene()).await;
    app.delete(&ended).await;
    let began = std::time::Instant::now();
    while app.get(&ended).await.status != StatusCode::NOT_FOUND {
        assert!(began.elapsed() < crate::app::DEADLINE, "it is kept");
        tokio::time::sleep(std::time::Duration::from_millis(10)).await;
    }
    assert_eq!(app.get(&running).await.body["status"], "running");
    app.delete(&running).await;
    app.stop().await;
}
