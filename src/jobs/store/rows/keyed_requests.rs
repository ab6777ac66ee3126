//! Requests with an Idempotency-Key, and their answers.

use super::job_id;
use crate::jobs::job::JobId;
use crate::jobs::store::{FormerRequest, KeptAnswer, Key, StoreError};
use sqlx::FromRow;

/// Level of zstd at which an answer, mostly a scenario's text, is compressed.
const LEVEL: i32 = 3;

/// Largest answer read back [bytes]: a batch's identifiers, or a job with a scenario of any size
/// that a request may have.
const LARGEST_ANSWER: usize = 1 << 30;

/// Space of a request beside its lists and its answer [bytes], about.
const ROW_BYTES: usize = 256;

/// A request with a key.
#[derive(Debug, FromRow)]
pub(in super::super) struct KeyedRequestRow {
    body_hash: Vec<u8>,
    job_ids: String,
    answer_status: Option<i64>,
    answer_location: Option<String>,
    answer_body: Option<Vec<u8>>,
}

impl KeyedRequestRow {
    pub(in super::super) fn read(self, key: &Key) -> Result<FormerRequest, StoreError> {
        if self.body_hash != key.request_hash {
            return Ok(FormerRequest::Other);
        }
        let unreadable = |what| StoreError::Row {
            job: format!("of the key {}", key.text),
            what,
        };
        let ids: Vec<String> =
            serde_json::from_str(&self.job_ids).map_err(|_| unreadable("identifiers"))?;
        let jobs: Result<_, _> = ids.iter().map(|id| job_id(id)).collect();
        let answer = match (self.answer_status, self.answer_body) {
            (Some(status), Some(body)) => Some(KeptAnswer {
                status: u16::try_from(status).map_err(|_| unreadable("status"))?,
                location: self.answer_location,
                body: unpack_answer(&body).ok_or_else(|| unreadable("kept answer"))?,
            }),
            _ => None,
        };
        Ok(FormerRequest::Same {
            jobs: jobs?,
            answer,
        })
    }
}

/// Identifiers of jobs as they are stored: a JSON list.
pub(in super::super) fn identifiers_text(jobs: &[JobId]) -> String {
    let ids: Vec<String> = jobs.iter().map(ToString::to_string).collect();
    serde_json::Value::from(ids).to_string()
}

/// Space of a request with these identifiers, before its answer is kept [bytes], about.
pub(in super::super) fn space(identifiers: &str) -> u64 {
    (ROW_BYTES + identifiers.len()) as u64
}

/// An answer's body as it is stored.
pub(in super::super) fn pack_answer(body: &str) -> Result<Vec<u8>, StoreError> {
    zstd::bulk::compress(body.as_bytes(), LEVEL).map_err(|error| StoreError::Defect(error.into()))
}

fn unpack_answer(compressed: &[u8]) -> Option<String> {
    let mut reader = zstd::stream::read::Decoder::new(compressed).ok()?;
    let mut bytes = Vec::new();
    let limit = LARGEST_ANSWER as u64;
    std::io::Read::read_to_end(&mut std::io::Read::take(&mut reader, limit), &mut bytes).ok()?;
    String::from_utf8(bytes).ok()
}
