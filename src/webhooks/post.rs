//! Delivery of one message of a webhook.

use super::message::Message;
use crate::config::Webhook;
use http_body_util::Full;
use hyper::body::Bytes;
use hyper::{Request, StatusCode, Uri, header};
use hyper_util::rt::TokioIo;
use std::io;
use std::time::Duration;
use std::time::{SystemTime, UNIX_EPOCH};
use thiserror::Error;
use tokio::net::TcpStream;
use tokio::time::timeout;

/// Longest time for one attempt.
const LONGEST: Duration = Duration::from_secs(10);
/// Port of an address that names none.
const HTTP_PORT: u16 = 80;

/// Reason why a message was not taken.
#[derive(Debug, Error)]
pub(super) enum PostError {
    #[error("no connection: {0}")]
    Connection(#[from] io::Error),
    #[error("no answer: {0}")]
    Answer(#[from] hyper::Error),
    #[error("no answer within {} s", LONGEST.as_secs())]
    TooSlow,
    #[error("the receiver answered {0}")]
    Refused(StatusCode),
    #[error("the message can't be signed or addressed")]
    Unsendable,
}

/// Sends a message; it is taken if the answer's status is 2xx.
pub(super) async fn post(webhook: &Webhook, message: &Message) -> Result<(), PostError> {
    let sent = timeout(LONGEST, answered(webhook, message)).await;
    let status = sent.map_err(|_| PostError::TooSlow)??;
    if status.is_success() {
        Ok(())
    } else {
        Err(PostError::Refused(status))
    }
}

async fn answered(webhook: &Webhook, message: &Message) -> Result<StatusCode, PostError> {
    let (uri, request) = request(webhook, message).ok_or(PostError::Unsendable)?;
    let host = uri.host().ok_or(PostError::Unsendable)?;
    let host = host.trim_start_matches('[').trim_end_matches(']');
    let stream = TcpStream::connect((host, uri.port_u16().unwrap_or(HTTP_PORT))).await?;
    let (mut sender, connection) =
        hyper::client::conn::http1::handshake(TokioIo::new(stream)).await?;
    let driver = tokio::spawn(connection);
    let answer = sender.send_request(request).await;
    driver.abort();
    Ok(answer?.status())
}

/// The request, signed as of now.
fn request(webhook: &Webhook, message: &Message) -> Option<(Uri, Request<Full<Bytes>>)> {
    let uri: Uri = webhook.url.parse().ok()?;
    let now = SystemTime::now().duration_since(UNIX_EPOCH).ok()?;
    let now = i64::try_from(now.as_secs()).ok()?;
    let signer = standardwebhooks::Webhook::new(webhook.secret.reveal()).ok()?;
    let signature = signer
        .sign(&message.id, now, message.body.as_bytes())
        .ok()?;
    let path = uri.path_and_query().map_or("/", |path| path.as_str());
    let request = Request::post(path)
        .header(header::HOST, uri.authority()?.as_str())
        .header(header::CONTENT_TYPE, "application/json")
        .header("webhook-id", &message.id)
        .header("webhook-timestamp", now)
        .header("webhook-signature", signature)
        .body(Full::new(Bytes::from(message.body.clone())));
    Some((uri, request.ok()?))
}
