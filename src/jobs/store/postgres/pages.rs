//! Pages of jobs.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::job::JobStatus;
use crate::jobs::store::page::{OUTCOME_BYTES, milliseconds_from};
use crate::jobs::store::rows::ListedRow;
use crate::jobs::store::{JobPage, Page};
use futures_util::TryStreamExt;
use sqlx::{Postgres, QueryBuilder};

impl PostgresStore {
    pub(super) async fn page(&self, page: &Page) -> Answer<JobPage> {
        let mut query = page_query(page);
        let mut rows = query.build_query_as::<ListedRow>().fetch(&self.pool);
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
}

/// The statement of a page, and of one job more, which tells whether there is a next page.
fn page_query(page: &Page) -> QueryBuilder<Postgres> {
    let mut query = QueryBuilder::new(
        "SELECT sequence, id::text AS id, status, title, created_ms, started_ms, finished_ms,
             fraction, simulated_time_s, steps, substeps, point_steps_per_s, eta_s,
             (SELECT coalesce(json_agg(label ORDER BY label COLLATE \"C\"), '[]')::text FROM labels
              WHERE job_id = jobs.id) AS labels, CASE WHEN ",
    );
    query.push_bind(page.outcomes);
    query.push(" THEN outcome END AS outcome FROM jobs WHERE sequence IN (");
    for (place, &status) in page.statuses.iter().enumerate() {
        if place > 0 {
            query.push(" UNION ALL ");
        }
        push_state(&mut query, page, status);
    }
    query.push(") ORDER BY sequence DESC LIMIT ");
    query.push_bind(i64::from(page.limit) + 1);
    query
}

/// The newest jobs of one state, from an index of their own: however many jobs there are, no more
/// of a state are read than the page may have.
fn push_state(query: &mut QueryBuilder<Postgres>, page: &Page, status: JobStatus) {
    query.push("(SELECT sequence FROM ");
    match &page.label {
        Some(label) => query.push("labels WHERE label = ").push_bind(label.clone()),
        None => query.push("jobs WHERE true"),
    };
    query.push(" AND status = ").push_bind(status.word());
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
    query.push(")");
}
