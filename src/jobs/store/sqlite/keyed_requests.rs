//! Requests with an Idempotency-Key, and their answers.

use super::SqliteStore;
use super::error::Answer;
use super::rows::integer;
use super::size_limit::Purpose;
use super::submission::parse;
use crate::jobs::job::JobId;
use crate::jobs::store::{FormerRequest, KeptAnswer, Key, KeyRetention, StoreError};
use sqlx::FromRow;
use sqlx::sqlite::SqliteConnection;

/// Level of zstd at which an answer, mostly a scenario's text, is compressed.
const LEVEL: i32 = 3;

/// Largest answer read back [bytes]: a batch's identifiers, or a job with a scenario of any size
/// that a request may have.
const LARGEST_ANSWER: usize = 1 << 30;

/// Space of a request beside its lists and its answer [bytes], about.
const ROW_BYTES: usize = 256;

/// Largest number of keys forgotten in one transaction, so that submissions don't wait long.
const FORGOTTEN_AT_ONCE: u32 = 50;

#[derive(Debug, FromRow)]
struct KeyedRequestRow {
    body_hash: Vec<u8>,
    job_ids: String,
    answer_status: Option<u16>,
    answer_location: Option<String>,
    answer_body: Option<Vec<u8>>,
}

impl SqliteStore {
    pub(super) async fn former_request(
        &self,
        submitter: Option<&str>,
        key: &Key,
    ) -> Answer<Option<FormerRequest>> {
        let mut connection = self.readers.pool().acquire().await?;
        former_request(&mut connection, submitter, key).await
    }

    pub(super) async fn keep_answer(
        &self,
        submitter: Option<&str>,
        key: &Key,
        answer: &KeptAnswer,
    ) -> Answer<Option<KeptAnswer>> {
        let body = zstd::bulk::compress(answer.body.as_bytes(), LEVEL)
            .map_err(|error| StoreError::Defect(error.into()))?;
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        let done = sqlx::query(
            "UPDATE keyed_requests
             SET answer_status = ?3, answer_location = ?4, answer_body = ?5,
                 stored_bytes = stored_bytes + length(?5)
             WHERE submitter = ?1 AND key = ?2 AND answer_status IS NULL",
        )
        .bind(submitter.unwrap_or_default())
        .bind(&key.text)
        .bind(answer.status)
        .bind(&answer.location)
        .bind(body)
        .execute(&mut *transaction)
        .await?;
        if done.rows_affected() > 0 {
            transaction.commit().await?;
            return Ok(None);
        }
        Ok(
            match former_request(&mut transaction, submitter, key).await? {
                Some(FormerRequest::Same { answer, .. }) => answer,
                Some(FormerRequest::Other) | None => None,
            },
        )
    }

    pub(super) async fn forget_keys(&self, kept: KeyRetention) -> Answer<u64> {
        let mut keys = self.keys_released_long_ago(kept.age_ms).await?;
        if keys.is_empty() {
            keys = self.keys_beyond(kept.bytes).await?;
        }
        if keys.is_empty() {
            return Ok(0);
        }
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        for key in &keys {
            sqlx::query("DELETE FROM keyed_requests WHERE sequence = ?1")
                .bind(key)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(keys.len() as u64)
    }

    async fn keys_released_long_ago(&self, age_ms: i64) -> Answer<Vec<i64>> {
        let keys = sqlx::query_scalar(
            "SELECT sequence FROM keyed_requests WHERE released_operating_ms <= ?1
             ORDER BY released_operating_ms LIMIT ?2",
        );
        Ok(keys
            .bind(self.operating_ms().saturating_sub(age_ms))
            .bind(FORGOTTEN_AT_ONCE)
            .fetch_all(self.readers.pool())
            .await?)
    }

    /// The oldest released keys of a submitter whose keys take more space than this.
    async fn keys_beyond(&self, bytes: u64) -> Answer<Vec<i64>> {
        let spender: Option<(String, i64)> = sqlx::query_as(
            "SELECT submitter, sum(stored_bytes) AS bytes FROM keyed_requests
             WHERE released_operating_ms IS NOT NULL
             GROUP BY submitter HAVING bytes > ?1 LIMIT 1",
        )
        .bind(integer(bytes))
        .fetch_optional(self.readers.pool())
        .await?;
        let Some((submitter, spent)) = spender else {
            return Ok(Vec::new());
        };
        let oldest: Vec<(i64, i64)> = sqlx::query_as(
            "SELECT sequence, stored_bytes FROM keyed_requests
             WHERE submitter = ?1 AND released_operating_ms IS NOT NULL
             ORDER BY sequence LIMIT ?2",
        )
        .bind(submitter)
        .bind(FORGOTTEN_AT_ONCE)
        .fetch_all(self.readers.pool())
        .await?;
        let mut excess = spent - integer(bytes);
        let mut keys = Vec::new();
        for (key, stored) in oldest {
            if excess <= 0 {
                break;
            }
            excess -= stored;
            keys.push(key);
        }
        Ok(keys)
    }
}

pub(super) async fn former_request(
    connection: &mut SqliteConnection,
    submitter: Option<&str>,
    key: &Key,
) -> Answer<Option<FormerRequest>> {
    let row: Option<KeyedRequestRow> = sqlx::query_as(
        "SELECT body_hash, job_ids, answer_status, answer_location, answer_body
         FROM keyed_requests WHERE submitter = ?1 AND key = ?2",
    )
    .bind(submitter.unwrap_or_default())
    .bind(&key.text)
    .fetch_optional(connection)
    .await?;
    row.map(|row| row.read(key)).transpose()
}

/// Records a request with a key and its jobs; returns its number. One without jobs is released
/// at once.
pub(super) async fn keep_key(
    connection: &mut SqliteConnection,
    submitter: Option<&str>,
    (key, operating_ms): (&Key, i64),
    jobs: impl Iterator<Item = JobId>,
) -> Answer<i64> {
    let ids: Vec<String> = jobs.map(|id| id.to_string()).collect();
    let released_ms = ids.is_empty().then_some(operating_ms);
    let ids = serde_json::Value::from(ids).to_string();
    let sequence = sqlx::query_scalar(
        "INSERT INTO keyed_requests (submitter, key, body_hash, released_operating_ms,
                                     stored_bytes, job_ids)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6)
         RETURNING sequence",
    )
    .bind(submitter.unwrap_or_default())
    .bind(&key.text)
    .bind(&key.request_hash[..])
    .bind(released_ms)
    .bind(integer((ROW_BYTES + ids.len()) as u64))
    .bind(ids)
    .fetch_one(connection)
    .await?;
    Ok(sequence)
}

impl KeyedRequestRow {
    fn read(self, key: &Key) -> Answer<FormerRequest> {
        if self.body_hash != key.request_hash {
            return Ok(FormerRequest::Other);
        }
        let unreadable = |what| StoreError::Row {
            job: format!("of the key {}", key.text),
            what,
        };
        let ids: Vec<String> =
            serde_json::from_str(&self.job_ids).map_err(|_| unreadable("identifiers"))?;
        let jobs: Result<_, _> = ids.iter().map(|id| parse(id)).collect();
        let answer = match (self.answer_status, self.answer_body) {
            (Some(status), Some(body)) => Some(KeptAnswer {
                status,
                location: self.answer_location,
                body: text(&body).ok_or_else(|| unreadable("kept answer"))?,
            }),
            _ => None,
        };
        Ok(FormerRequest::Same {
            jobs: jobs?,
            answer,
        })
    }
}

fn text(compressed: &[u8]) -> Option<String> {
    let mut reader = zstd::stream::read::Decoder::new(compressed).ok()?;
    let mut bytes = Vec::new();
    let limit = LARGEST_ANSWER as u64;
    std::io::Read::read_to_end(&mut std::io::Read::take(&mut reader, limit), &mut bytes).ok()?;
    String::from_utf8(bytes).ok()
}
