//! Submission of jobs: one request, one transaction, all of its jobs or none.

use super::error::Answer;
use super::keyed_requests::{former_request, keep_key};
use super::size_limit::Purpose;
use super::terrains::name_in_job;
use super::{Now, SqliteStore};
use crate::jobs::job::JobId;
use crate::jobs::store::rows::{integer, job_id};
use crate::jobs::store::submission::Origin;
use crate::jobs::store::{Submission, Submitted};
use crate::jobs::submit::NewJob;
use sqlx::sqlite::SqliteConnection;

impl SqliteStore {
    pub(super) async fn submit(&self, submission: &Submission<'_>) -> Answer<Submitted> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        let submitter = submission.submitter;
        if let Some(key) = submission.key
            && let Some(former) = former_request(&mut transaction, submitter, key).await?
        {
            return Ok(Submitted::Before(former));
        }
        if let Some(full) = no_room(&mut transaction, submission).await? {
            return Ok(full);
        }
        let request = match submission.key {
            Some(key) => {
                let ids: Vec<JobId> = submission.jobs.iter().map(|job| job.id).collect();
                Some(keep_key(&mut transaction, submitter, (key, now.operating_ms), &ids).await?)
            }
            None => None,
        };
        for job in submission.jobs {
            let origin = Origin::Request(request);
            insert(&mut transaction, job, (submitter, origin), now).await?;
            let id = job.id.to_string();
            if let Some(missing) = name_in_job(&mut transaction, &id, &job.terrains).await? {
                return Ok(Submitted::NoTerrain(missing));
            }
        }
        transaction.commit().await?;
        Ok(Submitted::Accepted)
    }

    pub(super) async fn finished_like(
        &self,
        scenario_hash: &str,
        solver: (&str, &str),
    ) -> Answer<Option<JobId>> {
        let id: Option<String> = sqlx::query_scalar(
            "SELECT id FROM jobs
             WHERE scenario_hash = ?1 AND status = 'successful'
               AND solver_version = ?2 AND solver_commit = ?3
             ORDER BY sequence DESC LIMIT 1",
        )
        .bind(scenario_hash)
        .bind(solver.0)
        .bind(solver.1)
        .fetch_optional(self.readers.pool())
        .await?;
        Ok(id.map(|id| job_id(&id)).transpose()?)
    }
}

async fn no_room(
    connection: &mut SqliteConnection,
    submission: &Submission<'_>,
) -> Answer<Option<Submitted>> {
    // Members of studies take no place of a request's: only few of them wait at a time.
    let waiting =
        sqlx::query_scalar("SELECT count(*) FROM jobs WHERE status = 'accepted' AND priority = 0")
            .fetch_one(&mut *connection)
            .await?;
    let full = submission.beyond_queue(waiting);
    if full.is_some() || submission.room.submitter.is_none() {
        return Ok(full);
    }
    let own = sqlx::query_scalar(
        "SELECT count(*) FROM jobs
         WHERE submitter = ?1 AND status IN ('accepted', 'running') AND priority = 0",
    )
    .bind(submission.submitter)
    .fetch_one(connection)
    .await?;
    Ok(submission.beyond_quota(own))
}

pub(super) async fn insert(
    connection: &mut SqliteConnection,
    job: &NewJob,
    (submitter, origin): (Option<&str>, Origin),
    now: Now,
) -> Answer<()> {
    let id = job.id.to_string();
    sqlx::query(
        "INSERT INTO jobs (id, created_ms, scenario, title, bodies, solver_version,
                           scenario_hash, submitter, keyed_request, plan,
                           created_operating_ms, priority)
         VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)",
    )
    .bind(&id)
    .bind(now.wall_ms)
    .bind(&job.scenario)
    .bind(&job.title)
    .bind(integer(job.bodies as u64))
    .bind(job.solver_version)
    .bind(&job.scenario_hash)
    .bind(submitter)
    .bind(origin.keyed_request())
    .bind(&job.plan)
    .bind(now.operating_ms)
    .bind(origin.priority())
    .execute(&mut *connection)
    .await?;
    for label in &job.labels {
        sqlx::query(
            "INSERT INTO labels (label, job_id, sequence, status, created_ms)
             SELECT ?1, id, sequence, status, created_ms FROM jobs WHERE id = ?2",
        )
        .bind(label)
        .bind(&id)
        .execute(&mut *connection)
        .await?;
    }
    Ok(())
}
