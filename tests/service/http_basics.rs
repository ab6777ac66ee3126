//! Behaviour common to all requests: routes, methods, limits.

use crate::app::{Answer, DEADLINE, TestApp};
use reqwest::{Method, StatusCode};
use serde_json::json;
use std::time::Instant;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::timeout;

#[tokio::test(flavor = "multi_thread")]
async fn the_service_says_that_it_is_well() {
    let app = TestApp::start().await;
    let answer = app.get("/healthz").await;
    assert_eq!(answer.status, StatusCode::OK);
    assert_eq!(answer.body["status"], "ok");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_not_there_is_a_problem_document() {
    let app = TestApp::start().await;
    let unknown = "/v1/jobs/01890a5d-ac96-774b-bcce-b302099a8057";
    for path in ["", "/trajectory", "/flow"] {
        for job in [
            unknown,
            "/v1/jobs/17",
            "/v1/jobs/no-such-job",
            "/v1/jobs/%ff",
        ] {
            let answer = app.get(&format!("{job}{path}")).await;
            answer.assert_problem(StatusCode::NOT_FOUND, "unknown-job");
        }
    }
    app.delete(unknown)
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-job");
    for path in ["/v1", "/v2/jobs", "/v1/jobs/1/2/3"] {
        app.get(path)
            .await
            .assert_problem(StatusCode::NOT_FOUND, "unknown-route");
    }
    for (method, path) in [
        (Method::PUT, "/v1/jobs"),
        (Method::POST, unknown),
        (Method::DELETE, "/healthz"),
        (Method::PATCH, "/openapi.json"),
    ] {
        let answer = app.ask(method, path).await;
        answer.assert_problem(StatusCode::METHOD_NOT_ALLOWED, "method-not-allowed");
    }
    let refused = app.client.put(app.url("/v1/jobs")).send().await.unwrap();
    let allowed = refused.headers()["allow"].to_str().unwrap();
    assert!(
        allowed.contains("GET") && allowed.contains("POST"),
        "{allowed}"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_bad_list_query_names_its_parameters() {
    let app = TestApp::start().await;
    for (query, wrong) in [
        ("status=done", &["status"][..]),
        ("limit=0", &["limit"]),
        ("limit=101", &["limit"]),
        ("cursor=here", &["cursor"]),
        ("page=2", &["page"]),
        ("limit=x&status=y", &["status", "limit"]),
        ("status=running,running", &["status"]),
        ("created_from=yesterday", &["created_from"]),
        ("created_to=2026-01-31T12:00:00+01:00", &["created_to"]),
        (
            "created_from=2026-01-31T12:00:00Z&created_to=2026-01-30T12:00:00Z",
            &["created_to"],
        ),
        ("include=scenario", &["include"]),
    ] {
        let answer = app.get(&format!("/v1/jobs?{query}")).await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
        assert_eq!(answer.wrong_fields(), wrong, "{query}");
    }
    let answer = app.get("/v1/jobs?status=runing,failed").await;
    let allowed = answer.body["errors"][0]["allowed"].clone();
    assert_eq!(
        allowed,
        json!(
            "each once, of accepted, running, successful, failed, dismissed; did you mean running?"
        )
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn half_a_request_does_not_hold_the_service() {
    let app = TestApp::start_with(|config| {
        config.limits.header_read_timeout_s = 0.2;
        config.limits.connections = 2;
    })
    .await;
    let mut held = Vec::new();
    for _ in 0..2 {
        let mut stream = TcpStream::connect(app.address()).await.unwrap();
        stream
            .write_all(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nX-Half")
            .await
            .unwrap();
        held.push(stream);
    }
    // Both connections are in use: the answer comes once the service closed one of them.
    assert_eq!(app.get("/healthz").await.status, StatusCode::OK);
    for mut stream in held {
        let mut answer = Vec::new();
        let read = timeout(DEADLINE, stream.read_to_end(&mut answer)).await;
        assert!(read.is_ok(), "the connection is still held");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_stop_does_not_wait_for_idle_or_half_open_clients() {
    let app = TestApp::start_with(|config| config.limits.drain_timeout_s = 0.2).await;
    let mut half = TcpStream::connect(app.address()).await.unwrap();
    half.write_all(b"GET /healthz HT").await.unwrap();
    assert_eq!(app.get("/healthz").await.status, StatusCode::OK);
    let began = Instant::now();
    app.stop().await;
    // Far below the ten seconds that a request's head may take.
    assert!(began.elapsed().as_secs_f64() < 5.0, "{:?}", began.elapsed());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_body_is_json_in_utf_8_uncompressed() {
    let app = TestApp::start().await;
    let json = "application/json";
    for (headers, status) in [
        (
            &[("content-type", "Application/JSON; charset=UTF-8")][..],
            400,
        ),
        (&[("content-type", "application/scenario+json")], 400),
        (
            &[("content-type", json), ("content-encoding", "identity")],
            400,
        ),
        (&[("content-type", json), ("content-encoding", "gzip")], 415),
        (&[("content-type", "application/json; charset=latin1")], 415),
        (&[("content-type", "text/plain")], 415),
        (&[], 415),
    ] {
        let mut request = app.client.post(app.url("/v1/jobs")).body("?");
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        let answer = Answer::read(request.send().await.unwrap()).await;
        assert_eq!(answer.status, status, "{headers:?}");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_body_announced_as_too_large_is_refused_before_it_is_sent() {
    let app = TestApp::start().await;
    let mut stream = TcpStream::connect(app.address()).await.unwrap();
    let head = format!(
        "POST /v1/jobs HTTP/1.1\r\nHost: {}\r\nContent-Type: application/json\r\n\
         Expect: 100-continue\r\nContent-Length: 1048577\r\n\r\n",
        app.address()
    );
    stream.write_all(head.as_bytes()).await.unwrap();
    let mut answer = Vec::new();
    let read = timeout(DEADLINE, stream.read_to_end(&mut answer)).await;
    read.expect("the connection ends").unwrap();
    let text = String::from_utf8(answer).unwrap();
    assert!(text.starts_with("HTTP/1.1 413 "), "{text}");
    assert!(text.contains("1048576 bytes"), "{text}");
    app.stop().await;
}
