//! A small HTTP client for the demo's own service: one connection per request.

use crate::cli::failure::Failure;
use http_body_util::{BodyExt, Full};
use hyper::body::Bytes;
use hyper::header::{CONTENT_TYPE, HOST};
use hyper::{Method, Request, StatusCode};
use hyper_util::rt::TokioIo;
use serde::de::DeserializeOwned;
use std::fmt::Display;
use std::net::SocketAddr;
use tokio::net::TcpStream;

/// Client of the service at one address.
#[derive(Debug, Clone, Copy)]
pub(super) struct Client {
    address: SocketAddr,
}

/// An answer: status and body.
#[derive(Debug)]
pub(super) struct Answer {
    status: StatusCode,
    body: Bytes,
}

impl Client {
    pub(super) fn new(address: SocketAddr) -> Self {
        Self { address }
    }

    /// Gets the document at `path`.
    ///
    /// # Errors
    /// No connection, or no complete answer.
    pub(super) async fn get(&self, path: &str) -> Result<Answer, Failure> {
        self.send(Method::GET, path, Bytes::new()).await
    }

    /// Posts a JSON document to `path`.
    ///
    /// # Errors
    /// No connection, or no complete answer.
    pub(super) async fn post(&self, path: &str, json: String) -> Result<Answer, Failure> {
        self.send(Method::POST, path, Bytes::from(json)).await
    }

    async fn send(&self, method: Method, path: &str, body: Bytes) -> Result<Answer, Failure> {
        let request = Request::builder()
            .method(method)
            .uri(path)
            .header(HOST, self.address.to_string())
            .header(CONTENT_TYPE, "application/json")
            .body(Full::new(body))
            .map_err(no_answer)?;
        let stream = TcpStream::connect(self.address).await.map_err(no_answer)?;
        let handshake = hyper::client::conn::http1::handshake(TokioIo::new(stream));
        let (mut sender, connection) = handshake.await.map_err(no_answer)?;
        // Drives the connection until sender and answer are dropped; an error
        // of it also reaches the sender, where it is handled.
        let driver = tokio::spawn(connection);
        let response = sender.send_request(request).await.map_err(no_answer)?;
        let status = response.status();
        let body = response
            .into_body()
            .collect()
            .await
            .map_err(no_answer)?
            .to_bytes();
        driver.abort();
        Ok(Answer { status, body })
    }
}

impl Answer {
    /// The body, if the service accepted the request.
    ///
    /// # Errors
    /// The service refused; the error holds its message.
    pub(super) fn accepted(self) -> Result<Bytes, Failure> {
        if self.status.is_success() {
            return Ok(self.body);
        }
        let said = String::from_utf8_lossy(&self.body);
        let refusal = format!("the service answered {}: {said}", self.status);
        let at_fault = self.status.is_client_error();
        Err(if at_fault {
            Failure::Input(refusal)
        } else {
            Failure::Other(refusal)
        })
    }

    /// The body as JSON, if the service accepted the request.
    ///
    /// # Errors
    /// As for [`Answer::accepted`], or the body is other JSON.
    pub(super) fn json<T: DeserializeOwned>(self) -> Result<T, Failure> {
        let body = self.accepted()?;
        serde_json::from_slice(&body)
            .map_err(|error| Failure::other("the service's answer is not understood", error))
    }
}

fn no_answer(error: impl Display) -> Failure {
    Failure::other("no answer from the service", error)
}
