//! Compressed answers.

use crate::app::{TestApp, tiny_scene};
use flate2::read::MultiGzDecoder;
use reqwest::{Response, StatusCode};
use std::io::Read;

async fn ask(app: &TestApp, path: &str, headers: &[(&str, &str)]) -> Response {
    let request = app.client.get(app.url(path));
    let add = |request: reqwest::RequestBuilder, (name, value): &(&str, &str)| {
        request.header(*name, *value)
    };
    headers.iter().fold(request, add).send().await.unwrap()
}

fn header(response: &Response, name: &str) -> Option<String> {
    let value = response.headers().get(name)?;
    Some(value.to_str().unwrap().to_owned())
}

fn decompressed(coding: Option<&str>, bytes: &[u8]) -> Vec<u8> {
    match coding {
        None => bytes.to_vec(),
        Some("zstd") => zstd::decode_all(bytes).unwrap(),
        Some("gzip") => {
            let mut text = Vec::new();
            MultiGzDecoder::new(bytes).read_to_end(&mut text).unwrap();
            text
        }
        Some(other) => panic!("{other}"),
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn texts_are_compressed_as_the_client_accepts_and_their_tags_stay() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let of_job = [
        "",
        "/trajectory",
        "/trajectory.csv",
        "/trajectory.ndjson",
        "/flow",
        "/aerial.svg",
    ];
    let of_job = of_job.map(|part| format!("{job}{part}"));
    let others = ["/openapi.json", "/assets/app.js"].map(str::to_owned);
    for path in of_job.iter().chain(&others) {
        let plain = ask(&app, path, &[]).await;
        assert_eq!(header(&plain, "content-encoding"), None, "{path}");
        assert_eq!(
            header(&plain, "vary").as_deref(),
            Some("accept-encoding"),
            "{path}"
        );
        let tag = header(&plain, "etag");
        let text = plain.bytes().await.unwrap();
        for (accepted, coding) in [("gzip", "gzip"), ("gzip, deflate, br, zstd", "zstd")] {
            let coded = ask(&app, path, &[("accept-encoding", accepted)]).await;
            assert_eq!(
                header(&coded, "content-encoding").as_deref(),
                Some(coding),
                "{path}"
            );
            assert_eq!(
                header(&coded, "vary").as_deref(),
                Some("accept-encoding"),
                "{path}"
            );
            assert_eq!(header(&coded, "etag"), tag, "{path}");
            let bytes = coded.bytes().await.unwrap();
            assert!(bytes.len() < text.len(), "{path}");
            assert_eq!(decompressed(Some(coding), &bytes), text, "{path}");
            if let Some(tag) = &tag {
                let headers = [("accept-encoding", accepted), ("if-none-match", tag)];
                let again = ask(&app, path, &headers).await;
                assert_eq!(again.status(), StatusCode::NOT_MODIFIED, "{path}");
                assert_eq!(header(&again, "vary").as_deref(), Some("accept-encoding"));
                assert_eq!(header(&again, "etag"), Some(tag.clone()));
            }
        }
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn archives_events_and_small_answers_are_not_compressed() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let events = format!("/v1/events?job={}", job.rsplit('/').next().unwrap());
    for path in [
        format!("{job}/trajectory.npz"),
        format!("{job}/flow.zip"),
        events,
        "/healthz".to_owned(),
        "/".to_owned(),
    ] {
        for accepted in ["gzip", "identity;q=0, zstd", "identity;q=0"] {
            let answer = ask(&app, &path, &[("accept-encoding", accepted)]).await;
            assert_eq!(answer.status(), StatusCode::OK, "{path}");
            assert_eq!(header(&answer, "content-encoding"), None, "{path}");
        }
    }
    app.stop().await;
}
