//! Pages of jobs.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::store::rows::{ListedRow, page_of, push_newest};
use crate::jobs::store::{JobPage, Page};
use sqlx::{Postgres, QueryBuilder};

impl PostgresStore {
    pub(super) async fn page(&self, page: &Page) -> Answer<JobPage> {
        let mut query = page_query(page);
        let rows = query.build_query_as::<ListedRow>().fetch(&self.pool);
        page_of(rows, page).await
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
        query.push("(");
        push_newest(&mut query, page, status);
        query.push(")");
    }
    query.push(") ORDER BY sequence DESC LIMIT ");
    query.push_bind(i64::from(page.limit) + 1);
    query
}
