//! Access control.

use crate::app::{Answer, TestApp, endless_scene, is_running, tiny_scene};
use reqwest::{Method, StatusCode};
use scree::config::{Scope, ServiceConfig, Token};

fn token(name: &str, scopes: &[Scope]) -> Token {
    Token {
        name: name.to_owned(),
        blake3: blake3::hash(format!("{name}'s secret").as_bytes())
            .to_hex()
            .to_string(),
        scopes: scopes.to_vec(),
        active_jobs: (name == "ann").then_some(2),
    }
}

pub(crate) fn with_tokens(config: &mut ServiceConfig) {
    config.tokens = vec![
        token("ann", &[Scope::Submit, Scope::Read]),
        token("ben", &[Scope::Submit, Scope::Read]),
        token("eve", &[Scope::Read]),
        token("sue", &[Scope::Submit]),
        token("root", &[Scope::Submit, Scope::Read, Scope::Admin]),
    ];
}

async fn ask(app: &TestApp, who: &str, method: Method, path: &str) -> Answer {
    let request = app.client.request(method, app.url(path));
    let request = request.header("authorization", format!("Bearer {who}'s secret"));
    let request = request.header("content-type", "application/json");
    let scene = endless_scene().to_string();
    Answer::read(request.body(scene).send().await.unwrap()).await
}

#[tokio::test(flavor = "multi_thread")]
async fn without_a_good_token_nothing_is_told() {
    let app = TestApp::start_with(with_tokens).await;
    for path in [
        "/v1/jobs",
        "/v1/jobs/1",
        "/v1/events",
        "/ogc/jobs",
        "/ogc/jobs/1/results",
        "/metrics",
        "/nowhere",
    ] {
        let response = app.client.get(app.url(path)).send().await.unwrap();
        assert_eq!(response.headers()["www-authenticate"], "Bearer", "{path}");
        Answer::read(response)
            .await
            .assert_problem(StatusCode::UNAUTHORIZED, "no-token");
        let wrong = ask(&app, "mallory", Method::GET, path).await;
        wrong.assert_problem(StatusCode::UNAUTHORIZED, "no-token");
    }
    let answer = app.post("application/json", tiny_scene().to_string()).await;
    answer.assert_problem(StatusCode::UNAUTHORIZED, "no-token");
    for path in [
        "/healthz",
        "/readyz",
        "/openapi.json",
        "/",
        "/ogc/processes/simulation",
    ] {
        assert_eq!(app.get(path).await.status, StatusCode::OK, "{path}");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_is_good_for_its_scopes_and_its_own_jobs() {
    let app = TestApp::start_with(with_tokens).await;
    let refused = ask(&app, "eve", Method::POST, "/v1/jobs").await;
    refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    let first = ask(&app, "ann", Method::POST, "/v1/jobs").await;
    assert_eq!(first.status, StatusCode::ACCEPTED, "{:#}", first.body);
    assert_eq!(first.body["submitter"], "ann");
    let first = first.location.unwrap();
    assert_eq!(
        ask(&app, "eve", Method::GET, &first).await.status,
        StatusCode::OK
    );
    for who in ["ben", "eve"] {
        let refused = ask(&app, who, Method::DELETE, &first).await;
        refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    }
    assert_eq!(
        ask(&app, "ann", Method::DELETE, &first).await.status,
        StatusCode::OK
    );
    let second = ask(&app, "ben", Method::POST, "/v1/jobs")
        .await
        .location
        .unwrap();
    assert_eq!(
        ask(&app, "root", Method::DELETE, &second).await.status,
        StatusCode::OK
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_has_so_many_jobs_and_no_more() {
    let app = TestApp::start_with(with_tokens).await;
    let first = ask(&app, "ann", Method::POST, "/v1/jobs")
        .await
        .location
        .unwrap();
    ask(&app, "ann", Method::POST, "/v1/jobs").await;
    let third = ask(&app, "ann", Method::POST, "/v1/jobs").await;
    third.assert_problem(StatusCode::TOO_MANY_REQUESTS, "quota-spent");
    let other = ask(&app, "ben", Method::POST, "/v1/jobs").await;
    assert_eq!(other.status, StatusCode::ACCEPTED);
    ask(&app, "ann", Method::DELETE, &first).await;
    let third = ask(&app, "ann", Method::POST, "/v1/jobs").await;
    assert_eq!(third.status, StatusCode::ACCEPTED);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn with_tokens_the_service_listens_beyond_loopback() {
    let app = TestApp::start_with(|config| {
        with_tokens(config);
        config.listen = "0.0.0.0:0".parse().unwrap();
    })
    .await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_key_of_one_is_not_the_key_of_another() {
    let app = TestApp::start_with(with_tokens).await;
    let mut jobs = Vec::new();
    for who in ["ann", "ben", "ann"] {
        let request = app.client.post(app.url("/v1/jobs"));
        let request = request
            .header("authorization", format!("Bearer {who}'s secret"))
            .header("idempotency-key", "1")
            .header("content-type", "application/json")
            .body(endless_scene().to_string());
        jobs.push(
            Answer::read(request.send().await.unwrap())
                .await
                .location
                .unwrap(),
        );
    }
    assert_eq!(jobs[0], jobs[2]);
    assert_ne!(jobs[0], jobs[1]);
    let running = ask(&app, "eve", Method::GET, &jobs[0]).await.body;
    assert!(is_running(&running) || running["status"] == "accepted");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_that_may_submit_reads_what_it_submitted() {
    let app = TestApp::start_with(with_tokens).await;
    let own = ask(&app, "sue", Method::POST, "/v1/jobs").await;
    assert_eq!(own.status, StatusCode::ACCEPTED, "{:#}", own.body);
    let own = own.location.unwrap();
    let others = ask(&app, "ann", Method::POST, "/v1/jobs").await;
    let others = others.location.unwrap();
    let in_ogc = [&own, &others].map(|job| job.replace("/v1", "/ogc"));
    let state = ask(&app, "sue", Method::GET, &in_ogc[0]).await;
    assert_eq!(state.status, StatusCode::OK, "{:#}", state.body);
    for method in [Method::GET, Method::DELETE] {
        let refused = ask(&app, "sue", method, &in_ogc[1]).await;
        refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    }
    for part in ["", "/trajectory", "/flow.zip"] {
        let path = format!("{own}{part}");
        let read = app.client.get(app.url(&path));
        let read = read.header("authorization", "Bearer sue's secret");
        let status = read.send().await.unwrap().status();
        assert_eq!(status, StatusCode::OK, "{path}");
        let refused = ask(&app, "sue", Method::GET, &format!("{others}{part}")).await;
        refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    }
    for path in ["/v1/jobs", "/v1/events", "/metrics", "/ogc/jobs"] {
        let refused = ask(&app, "sue", Method::GET, path).await;
        refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    }
    app.stop().await;
}
