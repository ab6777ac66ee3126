//! Webhooks: receivers that are told how jobs end.

use super::{ConfigError, not_allowed};
use crate::jobs::job::JobStatus;
use hyper::Uri;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A receiver of the changes of jobs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Webhook {
    /// Name under which the database notes what it has received.
    pub name: String,
    /// Address of the receiver: `http://host:port/path`.
    pub url: String,
    /// Secret that signs the messages: `whsec_` and 24 to 64 bytes in base64.
    pub secret: Secret,
    /// States of jobs that are told; default: the final ones.
    #[serde(default = "final_states")]
    pub states: Vec<JobStatus>,
}

/// A secret; it is not shown.
#[derive(Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Secret(String);

impl Secret {
    /// The secret itself.
    pub fn reveal(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for Secret {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("(secret)")
    }
}

fn final_states() -> Vec<JobStatus> {
    let all = JobStatus::ALL.into_iter();
    all.filter(|status| status.is_final()).collect()
}

/// Checks names, addresses and secrets.
pub(super) fn check(webhooks: &[Webhook]) -> Result<(), ConfigError> {
    for (place, webhook) in webhooks.iter().enumerate() {
        let names = webhooks[..place].iter();
        if names.into_iter().any(|other| other.name == webhook.name) {
            let reason = "each name is allowed once";
            return Err(not_allowed("webhooks.name", &webhook.name, reason));
        }
        if !(1..=100).contains(&webhook.name.len()) {
            let reason = "allowed are 1 to 100 bytes";
            return Err(not_allowed("webhooks.name", &webhook.name, reason));
        }
        let uri = webhook.url.parse::<Uri>().ok();
        let plain = |uri: &Uri| uri.scheme_str() == Some("http") && uri.host().is_some();
        if !uri.as_ref().is_some_and(plain) {
            let reason = "allowed is http://host:port/path; a proxy of yours can speak https";
            return Err(not_allowed("webhooks.url", &webhook.url, reason));
        }
        if standardwebhooks::Webhook::new(webhook.secret.reveal()).is_err() {
            let reason = "allowed is whsec_ and 24 to 64 random bytes in base64";
            return Err(not_allowed("webhooks.secret", "(secret)", reason));
        }
        if webhook.states.is_empty() {
            let reason = "allowed are one or more states of a job";
            return Err(not_allowed("webhooks.states", "[]", reason));
        }
    }
    Ok(())
}
