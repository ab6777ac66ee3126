//! Pages of jobs: what all drivers select, and how they read it.

use super::ListedRow;
use crate::jobs::job::JobStatus;
use crate::jobs::store::page::{OUTCOME_BYTES, milliseconds_from};
use crate::jobs::store::{JobPage, Page, StoreError};
use futures_util::{Stream, TryStreamExt};
use sqlx::{Database, Encode, QueryBuilder, Type};
use std::pin::pin;

/// The page that begins with these rows: up to its limit, or to the size of its outcomes.
pub(in super::super) async fn page_of<E: From<sqlx::Error> + From<StoreError>>(
    rows: impl Stream<Item = Result<ListedRow, sqlx::Error>>,
    page: &Page,
) -> Result<JobPage, E> {
    let mut rows = pin!(rows);
    let (mut jobs, mut bytes) = (Vec::new(), 0);
    while let Some(row) = rows.try_next().await? {
        if jobs.len() == page.limit as usize || bytes >= OUTCOME_BYTES {
            return Ok(JobPage { jobs, more: true });
        }
        bytes += row.outcome_bytes();
        jobs.push(row.read()?);
    }
    Ok(JobPage { jobs, more: false })
}

/// Adds the selection of the newest jobs of one state, from an index of their own: however many jobs
/// there are, no more of a state are read than the page may have, and one more, which tells whether
/// there is a next page.
pub(in super::super) fn push_newest<DB: Database>(
    query: &mut QueryBuilder<DB>,
    page: &Page,
    status: JobStatus,
) where
    i64: Type<DB> + for<'q> Encode<'q, DB>,
    String: Type<DB> + for<'q> Encode<'q, DB>,
{
    query.push("SELECT sequence FROM ");
    match &page.label {
        Some(label) => query.push("labels WHERE label = ").push_bind(label.clone()),
        None => query.push("jobs WHERE true"),
    };
    match (page.members, &page.label) {
        (true, _) => {}
        (false, None) => drop(query.push(" AND priority = 0")),
        (false, Some(_)) => {
            query.push(" AND (SELECT priority FROM jobs WHERE jobs.id = job_id) = 0");
        }
    }
    query
        .push(" AND status = ")
        .push_bind(status.word().to_owned());
    query
        .push(" AND sequence < ")
        .push_bind(page.before.unwrap_or(i64::MAX));
    if let Some(time) = page.created_from {
        query
            .push(" AND created_ms >= ")
            .push_bind(milliseconds_from(time));
    }
    if let Some(time) = page.created_to {
        query
            .push(" AND created_ms <= ")
            .push_bind(time.as_millisecond());
    }
    query.push(" ORDER BY sequence DESC LIMIT ");
    query.push_bind(i64::from(page.limit) + 1);
}
