//! Requests with an Idempotency-Key, and their answers.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::job::JobId;
use crate::jobs::store::rows::{KeyedRequestRow, identifiers_text, integer, pack_answer, space};
use crate::jobs::store::{FormerRequest, KeptAnswer, Key, KeyRetention};
use sqlx::PgConnection;

/// Largest number of keys forgotten in one transaction.
const FORGOTTEN_AT_ONCE: i64 = 1_000;

impl PostgresStore {
    pub(super) async fn former_request(
        &self,
        submitter: Option<&str>,
        key: &Key,
    ) -> Answer<Option<FormerRequest>> {
        let mut connection = self.pool.acquire().await?;
        former_request(&mut connection, submitter, key).await
    }

    pub(super) async fn keep_answer(
        &self,
        submitter: Option<&str>,
        key: &Key,
        answer: &KeptAnswer,
    ) -> Answer<Option<KeptAnswer>> {
        let body = pack_answer(&answer.body)?;
        let mut connection = self.pool.acquire().await?;
        let done = sqlx::query(
            "UPDATE keyed_requests
             SET answer_status = $3, answer_location = $4, answer_body = $5,
                 stored_bytes = stored_bytes + length($5)
             WHERE submitter = $1 AND key = $2 AND answer_status IS NULL",
        )
        .bind(submitter.unwrap_or_default())
        .bind(&key.text)
        .bind(i64::from(answer.status))
        .bind(&answer.location)
        .bind(body)
        .execute(&mut *connection)
        .await?;
        if done.rows_affected() > 0 {
            return Ok(None);
        }
        Ok(
            match former_request(&mut connection, submitter, key).await? {
                Some(FormerRequest::Same { answer, .. }) => answer,
                Some(FormerRequest::Other) | None => None,
            },
        )
    }

    pub(super) async fn forget_keys(&self, kept: KeyRetention) -> Answer<u64> {
        let forgotten = self.forget_released_long_ago(kept.age_ms).await?;
        if forgotten > 0 {
            return Ok(forgotten);
        }
        self.forget_beyond(kept.bytes).await
    }

    async fn forget_released_long_ago(&self, age_ms: i64) -> Answer<u64> {
        let now = self.now().await?;
        let done = sqlx::query(
            "DELETE FROM keyed_requests WHERE sequence IN (
                 SELECT sequence FROM keyed_requests WHERE released_operating_ms <= $1
                 ORDER BY released_operating_ms LIMIT $2 FOR UPDATE SKIP LOCKED)",
        )
        .bind(now.operating_ms.saturating_sub(age_ms))
        .bind(FORGOTTEN_AT_ONCE)
        .execute(&self.pool)
        .await?;
        Ok(done.rows_affected())
    }

    /// Forgets the oldest released keys of a submitter whose keys take more space than this: those
    /// before which less than the excess lies.
    async fn forget_beyond(&self, bytes: u64) -> Answer<u64> {
        let done = sqlx::query(
            "WITH spender AS (
                 SELECT submitter, sum(stored_bytes) - $1 AS excess FROM keyed_requests
                 WHERE released_operating_ms IS NOT NULL
                 GROUP BY submitter HAVING sum(stored_bytes) > $1 LIMIT 1
             ), oldest AS (
                 SELECT sequence, excess,
                        sum(stored_bytes) OVER (ORDER BY sequence) - stored_bytes AS before
                 FROM keyed_requests JOIN spender USING (submitter)
                 WHERE released_operating_ms IS NOT NULL ORDER BY sequence LIMIT $2
             )
             DELETE FROM keyed_requests
             WHERE sequence IN (SELECT sequence FROM oldest WHERE before < excess)",
        )
        .bind(integer(bytes))
        .bind(FORGOTTEN_AT_ONCE)
        .execute(&self.pool)
        .await?;
        Ok(done.rows_affected())
    }
}

pub(super) async fn former_request(
    connection: &mut PgConnection,
    submitter: Option<&str>,
    key: &Key,
) -> Answer<Option<FormerRequest>> {
    let row: Option<KeyedRequestRow> = sqlx::query_as(
        "SELECT body_hash, job_ids, answer_status, answer_location, answer_body
         FROM keyed_requests WHERE submitter = $1 AND key = $2",
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
    connection: &mut PgConnection,
    submitter: Option<&str>,
    (key, operating_ms): (&Key, i64),
    jobs: &[JobId],
) -> Answer<i64> {
    let released_ms = jobs.is_empty().then_some(operating_ms);
    let ids = identifiers_text(jobs);
    let sequence = sqlx::query_scalar(
        "INSERT INTO keyed_requests (submitter, key, body_hash, released_operating_ms,
                                     stored_bytes, job_ids)
         VALUES ($1, $2, $3, $4, $5, $6)
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
