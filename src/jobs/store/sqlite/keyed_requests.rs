//! Requests with an Idempotency-Key, and their answers.

use super::SqliteStore;
use super::error::Answer;
use super::size_limit::Purpose;
use crate::jobs::job::JobId;
use crate::jobs::store::rows::{KeyedRequestRow, identifiers_text, integer, pack_answer, space};
use crate::jobs::store::{FormerRequest, KeptAnswer, Key, KeyRetention};
use sqlx::sqlite::SqliteConnection;

/// Largest number of keys forgotten in one transaction, so that submissions don't wait long.
const FORGOTTEN_AT_ONCE: u32 = 50;

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
        let body = pack_answer(&answer.body)?;
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
    Ok(row.map(|row| row.read(key)).transpose()?)
}

/// Records a request with a key and its jobs; returns its number. One without jobs is released
/// at once.
pub(super) async fn keep_key(
    connection: &mut SqliteConnection,
    submitter: Option<&str>,
    (key, operating_ms): (&Key, i64),
    jobs: &[JobId],
) -> Answer<i64> {
    let released_ms = jobs.is_empty().then_some(operating_ms);
    let ids = identifiers_text(jobs);
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
    .bind(integer(space(&ids)))
    .bind(ids)
    .fetch_one(connection)
    .await?;
    Ok(sequence)
}
