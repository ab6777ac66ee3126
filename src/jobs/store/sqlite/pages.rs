//! Pages of jobs.

use super::SqliteStore;
use super::error::Answer;
use crate::jobs::job::JobStatus;
use crate::jobs::store::page::{OUTCOME_BYTES, milliseconds_from};
use crate::jobs::store::rows::ListedRow;
use crate::jobs::store::{JobPage, Page};
use futures_util::TryStreamExt;
use sqlx::{QueryBuilder, Sqlite};

impl SqliteStore {
    pub(super) async fn page(&self, page: &Page) -> Answer<JobPage> {
        let mut query = page_query(page);
        let mut rows = query
            .build_query_as::<ListedRow>()
            .fetch(self.readers.pool());
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
fn page_query(page: &Page) -> QueryBuilder<Sqlite> {
    let mut query = QueryBuilder::new(
        "SELECT sequence, id, status, title, created_ms, started_ms, finished_ms, fraction,
             simulated_time_s, steps, substeps, point_steps_per_s, eta_s,
             (SELECT json_group_array(label) FROM labels WHERE job_id = jobs.id) AS labels,
             iif(",
    );
    query.push_bind(page.outcomes);
    query.push(", outcome, NULL) AS outcome FROM jobs WHERE sequence IN (");
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
fn push_state(query: &mut QueryBuilder<Sqlite>, page: &Page, status: JobStatus) {
    query.push("SELECT sequence FROM (SELECT sequence FROM ");
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::clock::SystemClock;
    use jiff::Timestamp;
    use sqlx::Row;
    use std::sync::Arc;

    /// Whatever a page asks for, no table is read but by a job's own number.
    #[tokio::test]
    async fn a_page_is_read_from_indices() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("test.db");
        let clock = Arc::new(SystemClock::default());
        let store = SqliteStore::open_with(&path, None, clock).await.unwrap();
        let time = Some(Timestamp::UNIX_EPOCH);
        for (label, created_from) in [(None, None), (None, time), (Some("a".to_owned()), time)] {
            let page = Page {
                statuses: vec![JobStatus::Accepted, JobStatus::Failed],
                label: label.clone(),
                created_from,
                created_to: created_from,
                before: None,
                limit: 100,
                outcomes: true,
            };
            let sql = format!("EXPLAIN QUERY PLAN {}", page_query(&page).sql().as_str());
            let explained = sqlx::query(sqlx::AssertSqlSafe(sql));
            let rows = explained.fetch_all(store.readers.pool()).await.unwrap();
            let plan: Vec<String> = rows.iter().map(|row| row.get("detail")).collect();
            let by_state = match label {
                None => "COVERING INDEX jobs_by_status (status=? AND sequence<?)",
                Some(_) => "COVERING INDEX labels_by_status (label=? AND status=? AND sequence<?)",
            };
            let of_states = plan.iter().filter(|step| step.ends_with(by_state));
            assert_eq!(of_states.count(), 2, "{plan:#?}");
            let scans = plan.iter().filter(|step| step.starts_with("SCAN"));
            let scans: Vec<_> = scans.filter(|step| !step.contains("subquery")).collect();
            assert!(scans.is_empty(), "{scans:?}");
        }
    }
}
