//! Requests by way of a browser: names that are not the service's, foreign pages, and the headers
//! of answers.

use crate::app::{Answer, TestApp, tiny_scene};
use reqwest::{Method, Response, StatusCode};

async fn send(app: &TestApp, method: Method, path: &str, headers: &[(&str, &str)]) -> Response {
    let mut request = app.client.request(method, app.url(path));
    for (name, value) in headers {
        request = request.header(*name, *value);
    }
    let request = request.header("content-type", "application/json");
    let request = request.body(tiny_scene().to_string());
    request.send().await.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_foreign_name_reaches_nothing() {
    let app = TestApp::start().await;
    for path in ["/v1/jobs", "/v1/plans"] {
        let headers = [("host", "attacker.example")];
        let answer = Answer::read(send(&app, Method::POST, path, &headers).await).await;
        answer.assert_problem(StatusCode::FORBIDDEN, "foreign-host");
    }
    for path in ["/v1/jobs", "/healthz", "/", "/openapi.json"] {
        let headers = [("host", "attacker.example:8080")];
        let answer = Answer::read(send(&app, Method::GET, path, &headers).await).await;
        answer.assert_problem(StatusCode::FORBIDDEN, "foreign-host");
    }
    for host in ["localhost", "127.0.0.1:1", "[::1]:8080"] {
        let response = send(&app, Method::GET, "/healthz", &[("host", host)]).await;
        assert_eq!(response.status(), StatusCode::OK, "{host}");
    }
    assert_eq!(
        app.get("/v1/jobs").await.body["jobs"],
        serde_json::json!([])
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_foreign_page_submits_nothing() {
    let app = TestApp::start().await;
    for origin in ["http://attacker.example", "null", "http://localhost:1"] {
        for method in [Method::POST, Method::GET] {
            let headers = [("origin", origin)];
            let answer = Answer::read(send(&app, method, "/v1/jobs", &headers).await).await;
            answer.assert_problem(StatusCode::FORBIDDEN, "foreign-origin");
        }
    }
    let own = app.url("");
    let own = own.trim_end_matches('/');
    let response = send(&app, Method::GET, "/v1/jobs", &[("origin", own)]).await;
    assert_eq!(response.status(), StatusCode::OK);
    assert!(
        response
            .headers()
            .get("access-control-allow-origin")
            .is_none()
    );
    let preflight = send(&app, Method::OPTIONS, "/v1/jobs", &[]).await;
    assert_eq!(preflight.status(), StatusCode::METHOD_NOT_ALLOWED);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn listed_names_and_pages_are_welcome() {
    let app = TestApp::start_with(|config| {
        config.browser.hosts = vec!["scree.lab.example".to_owned()];
        config.browser.origins = vec!["https://lab.example".to_owned()];
    })
    .await;
    let headers = [
        ("host", "Scree.Lab.example:80"),
        ("origin", "https://lab.example"),
    ];
    let response = send(&app, Method::POST, "/v1/jobs", &headers).await;
    assert_eq!(response.status(), StatusCode::ACCEPTED);
    let allowed = &response.headers()["access-control-allow-origin"];
    assert_eq!(allowed, "https://lab.example");
    let preflight = [
        ("origin", "https://lab.example"),
        ("access-control-request-method", "POST"),
        (
            "access-control-request-headers",
            "content-type,idempotency-key",
        ),
    ];
    let response = send(&app, Method::OPTIONS, "/v1/jobs", &preflight).await;
    let allowed = response.headers()["access-control-allow-headers"]
        .to_str()
        .unwrap();
    assert!(allowed.contains("idempotency-key"), "{allowed}");
    let headers = [("origin", "https://other.example")];
    let response = send(&app, Method::GET, "/v1/jobs", &headers).await;
    assert_eq!(response.status(), StatusCode::FORBIDDEN);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn every_answer_is_what_its_type_says() {
    let app = TestApp::start().await;
    for path in [
        "/",
        "/docs",
        "/assets/app.js",
        "/assets/app.css",
        "/healthz",
        "/v1/jobs",
        "/v1/jobs/1",
        "/nowhere",
    ] {
        let response = send(&app, Method::GET, path, &[]).await;
        let headers = response.headers();
        assert_eq!(headers["x-content-type-options"], "nosniff", "{path}");
        let policy = headers["content-security-policy"].to_str().unwrap();
        assert!(policy.starts_with("default-src 'none'"), "{path}: {policy}");
        assert!(!policy.contains("unsafe"), "{path}: {policy}");
    }
    // A script whose name changes with its content is kept, what it is named by is asked for again.
    let scripts = std::fs::read_dir("web/dist/assets").unwrap();
    let names = scripts.map(|script| script.unwrap().file_name().into_string().unwrap());
    let view = names
        .filter(|name| name.ends_with(".js"))
        .find(|name| name.starts_with("form-view-"));
    for (name, kept) in [(view.unwrap(), true), ("app.js".to_owned(), false)] {
        let script = send(&app, Method::GET, &format!("/assets/{name}"), &[]).await;
        let control = script.headers()["cache-control"].to_str().unwrap();
        assert_eq!(control.contains("immutable"), kept, "{name}: {control}");
    }
    let missing = send(&app, Method::GET, "/assets/none.js", &[]).await;
    assert_eq!(missing.status(), StatusCode::NOT_FOUND);
    // The pages have nothing inline, so that their policy lets all of it run.
    for path in ["/", "/docs"] {
        let page = send(&app, Method::GET, path, &[]).await;
        let page = page.text().await.unwrap();
        let inline = ["<script>", "<style>", "style="];
        assert!(!inline.iter().any(|part| page.contains(part)), "{path}");
    }
    app.stop().await;
}
