//! Pages of jobs.

use super::SqliteStore;
use super::error::Answer;
use crate::jobs::store::rows::{ListedRow, page_of, push_newest};
use crate::jobs::store::{JobPage, Page};
use sqlx::{QueryBuilder, Sqlite};

impl SqliteStore {
    pub(super) async fn page(&self, page: &Page) -> Answer<JobPage> {
        let mut query = page_query(page);
        let rows = query
            .build_query_as::<ListedRow>()
            .fetch(self.readers.pool());
        page_of(rows, page).await
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
        // A limit is of a selection of its own.
        query.push("SELECT sequence FROM (");
        push_newest(&mut query, page, status);
        query.push(")");
    }
    query.push(") ORDER BY sequence DESC LIMIT ");
    query.push_bind(i64::from(page.limit) + 1);
    query
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::clock::SystemClock;
    use crate::jobs::job::JobStatus;
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
        for (label, members, created_from) in [
            (None, true, None),
            (None, true, time),
            (None, false, time),
            (Some("a".to_owned()), true, time),
        ] {
            let page = Page {
                statuses: vec![JobStatus::Accepted, JobStatus::Failed],
                label: label.clone(),
                members,
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
                None if !members => "COVERING INDEX jobs_without_members (status=? AND sequence<?)",
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
