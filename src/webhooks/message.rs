//! Message of a webhook.

use crate::jobs::store::{Change, Event};
use jiff::Timestamp;
use serde_json::json;

/// Message about one event.
pub(super) struct Message {
    /// Identity, that of the event: a receiver that has seen it need not read it again.
    pub(super) id: String,
    /// JSON document.
    pub(super) body: String,
}

impl Message {
    /// Message about a change of state.
    pub(super) fn of(event: &Event) -> Option<Self> {
        let Change::Status(status) = event.change else {
            return None;
        };
        let body = json!({
            "type": format!("job.{}", status.word()),
            "timestamp": Timestamp::now().to_string(),
            "data": {"id": event.job.to_string(), "status": status, "attempt": event.attempt},
        });
        Some(Self {
            id: format!("{}-{}", event.job, event.sequence),
            body: body.to_string(),
        })
    }
}
