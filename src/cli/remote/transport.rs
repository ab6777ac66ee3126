//! Requests to one service. All of them can be repeated without harm: submissions have a key,
//! and a dismissal that is made twice is as made once. So a request is repeated after a broken
//! connection, and while the service or a proxy before it has no room or restarts.

use super::address::Address;
use super::breakage;
use super::connection::Connection;
use super::patience::Pauses;
use super::refusal::{PROBLEM, RequestError};
use crate::cli::arguments::ServiceOptions;
use crate::cli::console;
use crate::cli::failure::Failure;
use std::cell::Cell;
use std::time::{Duration, Instant};
use ureq::http::header::{AUTHORIZATION, CONTENT_TYPE, EXPECT, LOCATION, RETRY_AFTER};
use ureq::http::request::Builder;
use ureq::http::{Request, Response};
use ureq::tls::{RootCerts, TlsConfig};
use ureq::{Agent, Body};

/// Longest time that a request may wait for the end of a job, so that no proxy gives it up [s].
pub(super) const LONGEST_WAIT_S: u32 = 30;

/// Time to wait for a connection.
const CONNECT: Duration = Duration::from_secs(15);

/// Time to wait for the next piece of an answer, in which a request may wait.
const PIECE: Duration = Duration::from_secs(LONGEST_WAIT_S as u64 + 60);

/// Length of what is shown of an answer that is not understood.
const SHOWN_CHARS: usize = 200;

/// Connections to one service.
pub(super) struct Transport {
    agent: Agent,
    address: Address,
    token: Option<String>,
    patience: Duration,
    /// Flags by which a further command finds the same service.
    flags: String,
    /// True once there was a connection: a wrong address shows at once, a service that restarts is
    /// waited for.
    was_there: Cell<bool>,
    /// True while repetitions have been told of and there was no answer since.
    has_told: Cell<bool>,
}

/// A request.
#[derive(Debug, Clone, Copy)]
struct Asked<'a> {
    method: &'static str,
    path: &'a str,
    body: Option<Submission<'a>>,
}

/// A document to submit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Submission<'a> {
    bytes: &'a [u8],
    media_type: &'static str,
    /// Idempotency key: the same for each repetition, so that there is one job; none for what is the
    /// same however often it is sent.
    key: Option<&'a str>,
}

impl<'a> Submission<'a> {
    /// A JSON document, of which there shall be one job or study.
    pub(super) fn json(text: &'a str, key: &'a str) -> Self {
        Self {
            bytes: text.as_bytes(),
            media_type: "application/json",
            key: Some(key),
        }
    }

    /// A file, which the service names by its contents.
    pub(super) fn file(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            media_type: "application/octet-stream",
            key: None,
        }
    }
}

impl Transport {
    /// Connections to the service that is chosen by flags, environment or client file.
    ///
    /// # Errors
    /// No address is given, or what is given can't be used.
    pub(super) fn open(options: &ServiceOptions) -> Result<Self, Failure> {
        let Connection { address, token } = Connection::choose(options)?;
        let certificates = TlsConfig::builder().root_certs(RootCerts::PlatformVerifier);
        let mut config = Agent::config_builder()
            .http_status_as_error(false)
            // The token is for the address that was given, and a POST must stay one.
            .max_redirects(0)
            .max_redirects_will_error(false)
            .user_agent(concat!("scree/", env!("CARGO_PKG_VERSION")))
            .tls_config(certificates.build())
            .timeout_connect(Some(CONNECT))
            .timeout_per_read(Some(PIECE))
            .timeout_per_write(Some(PIECE));
        if address.is_loopback() {
            // A proxy of the environment knows nothing of this machine's loopback interface.
            config = config.proxy(None);
        }
        Ok(Self {
            agent: config.build().new_agent(),
            address,
            token,
            patience: options.patience(),
            flags: flags(options),
            was_there: Cell::new(false),
            has_told: Cell::new(false),
        })
    }

    /// Address of the service.
    pub(super) fn address(&self) -> &Address {
        &self.address
    }

    /// A further command to the same service, for people to type.
    pub(super) fn command(&self, words: &str) -> String {
        format!("`scree {words}{}`", self.flags)
    }

    /// Answer to a GET request.
    ///
    /// # Errors
    /// No answer for too long, or a refusal.
    pub(super) fn get(&self, path: &str) -> Result<Vec<u8>, RequestError> {
        self.ask("GET", path, None)
    }

    /// Answer to a GET request; none if what is asked for does not exist.
    ///
    /// # Errors
    /// As for [`Transport::get`].
    pub(super) fn get_if_there(&self, path: &str) -> Result<Option<Vec<u8>>, RequestError> {
        if_there(self.get(path))
    }

    /// Answer to a DELETE request; none if what is asked for does not exist.
    ///
    /// # Errors
    /// As for [`Transport::get`].
    pub(super) fn delete_if_there(&self, path: &str) -> Result<Option<Vec<u8>>, RequestError> {
        if_there(self.ask("DELETE", path, None))
    }

    /// Answer to a POST request.
    ///
    /// # Errors
    /// As for [`Transport::get`].
    pub(super) fn post(
        &self,
        path: &str,
        document: Submission<'_>,
    ) -> Result<Vec<u8>, RequestError> {
        self.ask("POST", path, Some(document))
    }

    fn ask(
        &self,
        method: &'static str,
        path: &str,
        body: Option<Submission<'_>>,
    ) -> Result<Vec<u8>, RequestError> {
        let asked = Asked { method, path, body };
        let mut pauses: Option<Pauses> = None;
        let mut has_broken = false;
        loop {
            let (error, retry_after) = match self.ask_once(asked) {
                Ok(body) => return Ok(body),
                Err(refused) => refused,
            };
            if !error.is_unconnected() {
                self.was_there.set(true);
            }
            if !self.was_there.get() || !error.is_temporary() {
                return Err(error);
            }
            has_broken |= error.has_broken();
            let now = Instant::now();
            let pauses = pauses.get_or_insert_with(|| Pauses::new(self.patience, now));
            let Some(pause) = pauses.next(retry_after, now) else {
                let may_be_accepted = has_broken && body.is_some_and(|body| body.key.is_some());
                return Err(if may_be_accepted {
                    error.after_sending()
                } else {
                    error
                });
            };
            if !self.has_told.replace(true) {
                let seconds = self.patience.as_secs();
                console::note(&format!("{error}; trying again for up to {seconds} s"));
            }
            std::thread::sleep(pause);
        }
    }

    /// The answer, or why there is none and after which time to try again.
    fn ask_once(&self, asked: Asked<'_>) -> Result<Vec<u8>, (RequestError, Option<Duration>)> {
        let answer = self.send(asked).map_err(|error| (error, None))?;
        self.was_there.set(true);
        let status = answer.status();
        let retry_after = retry_after(&answer);
        let moved_to = moved_to(&answer);
        let is_problem = answer.body().mime_type() == Some(PROBLEM);
        let body = self.read(answer).map_err(|error| (error, None))?;
        if status.is_success() {
            self.has_told.set(false);
            return Ok(body);
        }
        let url = self.address.to_string();
        let problem = is_problem.then(|| serde_json::from_slice(&body).ok());
        let error = match problem.flatten() {
            Some(problem) => RequestError::Refused { url, problem },
            None => RequestError::Unexpected {
                url,
                status: status.as_u16(),
                beginning: moved_to.unwrap_or_else(|| beginning(&body)),
            },
        };
        Err((error, retry_after))
    }

    fn send(&self, asked: Asked<'_>) -> Result<Response<Body>, RequestError> {
        let uri = format!("{}{}", self.address, asked.path);
        let mut request = Request::builder().method(asked.method).uri(uri);
        if let Some(token) = &self.token {
            request = request.header(AUTHORIZATION, format!("Bearer {token}"));
        }
        let answer = match asked.body {
            Some(document) => headed(request, document)
                .body(document.bytes)
                .map_err(ureq::Error::from)
                .and_then(|request| self.agent.run(request)),
            None => request
                .body(())
                .map_err(ureq::Error::from)
                .and_then(|request| self.agent.run(request)),
        };
        answer.map_err(|error| self.unreachable(&error))
    }

    fn read(&self, mut answer: Response<Body>) -> Result<Vec<u8>, RequestError> {
        // Trajectories may be long, and the service is trusted.
        let body = answer.body_mut().with_config().limit(u64::MAX);
        let read = body.read_to_vec();
        read.map_err(|error| match self.unreachable(&error) {
            // Whatever breaks off once an answer has begun may be whole the next time.
            RequestError::Unreachable { url, cause, .. } => RequestError::Unreachable {
                url,
                cause,
                is_temporary: true,
                is_unconnected: false,
            },
            other => other,
        })
    }

    fn unreachable(&self, error: &ureq::Error) -> RequestError {
        let is_unconnected = breakage::is_unconnected(error);
        RequestError::Unreachable {
            url: self.address.to_string(),
            cause: breakage::cause(error),
            is_temporary: is_unconnected || breakage::has_broken(error),
            is_unconnected,
        }
    }
}

/// The request with the headers of its document. The service is asked before a file is sent: it
/// refuses one that is too large by its length.
fn headed(request: Builder, document: Submission<'_>) -> Builder {
    let request = request.header(CONTENT_TYPE, document.media_type);
    match document.key {
        Some(key) => request.header("Idempotency-Key", key),
        None => request.header(EXPECT, "100-continue"),
    }
}

fn if_there(answer: Result<Vec<u8>, RequestError>) -> Result<Option<Vec<u8>>, RequestError> {
    match answer {
        Err(error) if error.is_missing() => Ok(None),
        answer => answer.map(Some),
    }
}

/// The flags that were given, without a token.
fn flags(options: &ServiceOptions) -> String {
    let mut flags = String::new();
    if let Some(url) = &options.url {
        flags.push_str(&format!(" --url {url}"));
    }
    let files = [
        ("token-file", &options.token_file),
        ("client-file", &options.client_file),
    ];
    for (name, path) in files {
        if let Some(path) = path {
            flags.push_str(&format!(" --{name} {}", path.display()));
        }
    }
    flags
}

/// Time that the service asks to wait. Dates, which proxies may send, are passed over.
fn retry_after(answer: &Response<Body>) -> Option<Duration> {
    let text = answer.headers().get(RETRY_AFTER)?.to_str().ok()?;
    text.trim().parse().ok().map(Duration::from_secs)
}

/// Address that an answer leads to, which is for the user to judge.
fn moved_to(answer: &Response<Body>) -> Option<String> {
    let place = answer.headers().get(LOCATION)?.to_str().ok()?;
    let is_redirection = answer.status().is_redirection();
    is_redirection.then(|| format!("it is at {place}"))
}

fn beginning(body: &[u8]) -> String {
    let text = String::from_utf8_lossy(body);
    text.trim().chars().take(SHOWN_CHARS).collect()
}
