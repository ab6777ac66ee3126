//! Webhooks: signed, sent until they are taken, and in order.

use crate::app::{TestApp, tiny_scene};
use serde_json::{Value, json};
use standardwebhooks::Webhook;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};

const SECRET: &str = "whsec_MfKQ9r8GKYqrTwjUPD8ILPZIo2LaLaSwMfKQ9r8GKYo=";

/// A receiver that answers one request after the other with the next of these statuses.
async fn received(listener: &TcpListener, statuses: &[u16]) -> Vec<Value> {
    let mut messages = Vec::new();
    for status in statuses {
        let (mut stream, _) = listener.accept().await.unwrap();
        messages.push(message(&mut stream).await);
        let answer = format!("HTTP/1.1 {status} X\r\ncontent-length: 0\r\n\r\n");
        stream.write_all(answer.as_bytes()).await.unwrap();
    }
    messages
}

/// The next message, if its signature is that of the secret.
async fn message(stream: &mut TcpStream) -> Value {
    let mut text = Vec::new();
    loop {
        let mut part = [0; 4096];
        let count = stream.read(&mut part).await.unwrap();
        assert!(count > 0, "the request broke off");
        text.extend_from_slice(&part[..count]);
        let all = String::from_utf8_lossy(&text).into_owned();
        let Some((head, body)) = all.split_once("\r\n\r\n") else {
            continue;
        };
        let length: usize = header(head, "content-length").parse().unwrap();
        if body.len() == length {
            let headers = ["webhook-id", "webhook-timestamp", "webhook-signature"];
            let headers = headers.map(|name| (name, header(head, name)));
            let mut map = reqwest::header::HeaderMap::new();
            for (name, value) in headers {
                map.insert(name, value.parse().unwrap());
            }
            Webhook::new(SECRET)
                .unwrap()
                .verify(body.as_bytes(), &map)
                .expect("it is signed");
            let mut message: Value = serde_json::from_str(body).unwrap();
            message["webhook-id"] = json!(map["webhook-id"].to_str().unwrap());
            return message;
        }
    }
}

fn header<'a>(head: &'a str, name: &str) -> &'a str {
    let mut lines = head.lines().filter_map(|line| line.split_once(": "));
    lines
        .find(|(of, _)| of.eq_ignore_ascii_case(name))
        .unwrap()
        .1
}

#[tokio::test(flavor = "multi_thread")]
async fn a_receiver_is_told_how_jobs_end_until_it_takes_the_message() {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let url = format!("http://{}/hook?of=lab", listener.local_addr().unwrap());
    let webhook = json!({"name": "lab", "url": url, "secret": SECRET});
    let webhook: scree::config::Webhook = serde_json::from_value(webhook).unwrap();
    let app = TestApp::start_with(|config| config.webhooks = vec![webhook.clone()]).await;
    let first = app.submit(&tiny_scene()).await;
    let told = received(&listener, &[500, 204]).await;
    assert_eq!(told[0], told[1], "the same message again");
    assert_eq!(told[0]["type"], "job.successful");
    assert!(first.ends_with(told[0]["data"]["id"].as_str().unwrap()));

    // What happened meanwhile is told after a restart, and what was taken is not told again.
    drop(listener);
    let second = app.submit(&tiny_scene()).await;
    app.wait_for_success(&second).await;
    let directory = app.stop().await;
    let listener = TcpListener::bind(url[7..].split('/').next().unwrap()).await;
    let listener = listener.unwrap();
    let app = TestApp::start_in(directory, |config| config.webhooks = vec![webhook]).await;
    let told = received(&listener, &[200]).await;
    assert!(second.ends_with(told[0]["data"]["id"].as_str().unwrap()));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_webhook_that_can_not_work_is_refused_at_the_start() {
    for (key, value, named) in [
        ("url", json!("https://example.org/hook"), "webhooks.url"),
        ("url", json!("/hook"), "webhooks.url"),
        ("secret", json!("whsec_short"), "webhooks.secret"),
        ("states", json!([]), "webhooks.states"),
        ("name", json!(""), "webhooks.name"),
    ] {
        let mut webhook = json!({"name": "lab", "url": "http://127.0.0.1:9/", "secret": SECRET});
        webhook[key] = value;
        let webhook = serde_json::from_value(webhook).unwrap();
        let config = scree::config::ServiceConfig {
            webhooks: vec![webhook],
            ..Default::default()
        };
        let refused = config.check(1).unwrap_err().to_string();
        assert!(refused.contains(named), "{refused}");
        assert!(!refused.contains("whsec_short"), "{refused}");
    }
}
