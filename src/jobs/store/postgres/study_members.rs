//! Members of studies: made, ended, read.

use super::error::Answer;
use super::news::Subject;
use super::studies::locked_status;
use super::submission::insert;
use super::terrains::name_in_job;
use super::{Now, PostgresStore};
use crate::jobs::store::rows::{EndedRow, MemberRow, integer, member_outcome, terrain_is_gone};
use crate::jobs::store::submission::Origin;
use crate::jobs::store::{EndedMember, ListedMember, MemberOutcome, MemberWork, NewMember};
use crate::jobs::submit::NewJob;
use crate::runs::COMMIT;
use crate::studies::study::{StudyId, StudyStatus};
use sqlx::PgConnection;

/// Largest number of ended members that are read at a time.
const ENDED_AT_ONCE: i64 = 1_000;

impl PostgresStore {
    pub(super) async fn add_members(&self, study: StudyId, members: &[NewMember]) -> Answer<usize> {
        let now = self.now().await?;
        let mut transaction = self.begin().await?;
        if locked_status(&mut transaction, study).await? != Some(StudyStatus::Running) {
            return Ok(0);
        }
        let (sequence, submitter, mut made): (i64, Option<String>, Vec<i64>) = sqlx::query_as(
            "SELECT sequence, submitter, made_on_levels FROM studies WHERE id = $1::uuid",
        )
        .bind(study.to_string())
        .fetch_one(&mut *transaction)
        .await?;
        let (mut added, mut noted) = (0, 0);
        for new in members {
            let origin = (sequence, submitter.as_deref());
            if !add_member(&mut transaction, origin, new, now).await? {
                continue;
            }
            let level = new.level as usize;
            made.resize(made.len().max(level + 1), 0);
            made[level] += 1;
            added += 1;
            noted += i64::from(matches!(new.work, MemberWork::Nothing(_)));
        }
        sqlx::query(
            "UPDATE studies SET made_on_levels = $2, noted = noted + $3 WHERE sequence = $1",
        )
        .bind(sequence)
        .bind(made)
        .bind(noted)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Queue, Subject::Events]);
        Ok(added)
    }

    pub(super) async fn members_made(&self, study: StudyId) -> Answer<Vec<u64>> {
        let made: Option<Vec<i64>> =
            sqlx::query_scalar("SELECT made_on_levels FROM studies WHERE id = $1::uuid")
                .bind(study.to_string())
                .fetch_optional(&self.pool)
                .await?;
        let made = made.unwrap_or_default();
        Ok(made.into_iter().map(i64::unsigned_abs).collect())
    }

    pub(super) async fn members(
        &self,
        study: StudyId,
        (level, member): (u32, u64),
        limit: u32,
    ) -> Answer<Vec<ListedMember>> {
        let rows: Vec<MemberRow> = sqlx::query_as(
            "SELECT level, member, job_id::text AS job_id, jobs.status AS status,
                    study_members.outcome AS outcome
             FROM study_members LEFT JOIN jobs ON jobs.id = job_id
             WHERE study = (SELECT sequence FROM studies WHERE id = $1::uuid)
               AND level = $2 AND member >= $3
             ORDER BY member LIMIT $4",
        )
        .bind(study.to_string())
        .bind(i64::from(level))
        .bind(integer(member))
        .bind(i64::from(limit))
        .fetch_all(&self.pool)
        .await?;
        let members: Result<_, _> = rows.into_iter().map(MemberRow::read).collect();
        Ok(members?)
    }

    pub(super) async fn ended_members(&self, study: StudyId) -> Answer<Vec<EndedMember>> {
        let rows: Vec<EndedRow> = sqlx::query_as(
            "SELECT level, member, jobs.status AS status, jobs.outcome AS outcome,
                    jobs.problem AS problem
             FROM study_members LEFT JOIN jobs ON jobs.id = job_id
             WHERE study = (SELECT sequence FROM studies WHERE id = $1::uuid)
               AND study_members.outcome IS NULL
               AND (jobs.id IS NULL OR jobs.finished_ms IS NOT NULL)
             LIMIT $2",
        )
        .bind(study.to_string())
        .bind(ENDED_AT_ONCE)
        .fetch_all(&self.pool)
        .await?;
        let ended: Result<_, _> = rows.into_iter().map(EndedRow::read).collect();
        Ok(ended?)
    }

    pub(super) async fn note_outcomes(
        &self,
        study: StudyId,
        outcomes: &[MemberOutcome],
    ) -> Answer<()> {
        let levels: Vec<i64> = outcomes
            .iter()
            .map(|noted| i64::from(noted.level))
            .collect();
        let members: Vec<i64> = outcomes.iter().map(|noted| integer(noted.member)).collect();
        let texts: Vec<&str> = outcomes.iter().map(|noted| &*noted.outcome).collect();
        let mut transaction = self.begin().await?;
        locked_status(&mut transaction, study).await?;
        sqlx::query(
            "WITH noted AS (
                 UPDATE study_members SET outcome = new.outcome
                 FROM unnest($2::bigint[], $3::bigint[], $4::text[]) AS new (level, member, outcome)
                 WHERE study = (SELECT sequence FROM studies WHERE id = $1::uuid)
                   AND study_members.level = new.level AND study_members.member = new.member
                   AND study_members.outcome IS NULL
                 RETURNING 1
             )
             UPDATE studies SET noted = noted + (SELECT count(*) FROM noted) WHERE id = $1::uuid",
        )
        .bind(study.to_string())
        .bind(levels)
        .bind(members)
        .bind(texts)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        Ok(())
    }

    pub(super) async fn outcomes(&self, study: StudyId) -> Answer<Vec<MemberOutcome>> {
        let rows: Vec<(i64, i64, String)> = sqlx::query_as(
            "SELECT level, member, outcome FROM study_members
             WHERE study = (SELECT sequence FROM studies WHERE id = $1::uuid)
               AND outcome IS NOT NULL
             ORDER BY level, member",
        )
        .bind(study.to_string())
        .fetch_all(&self.pool)
        .await?;
        let outcomes: Result<_, _> = rows.into_iter().map(member_outcome).collect();
        Ok(outcomes?)
    }
}

/// Adds a member, unless it is there.
async fn add_member(
    connection: &mut PgConnection,
    (study, submitter): (i64, Option<&str>),
    new: &NewMember,
    now: Now,
) -> Answer<bool> {
    if is_made(connection, study, new).await? {
        return Ok(false);
    }
    let (job, outcome) = match &new.work {
        MemberWork::Job(job) => {
            let id = job_of(connection, (job, submitter), now).await?;
            (Some(id), None)
        }
        MemberWork::Nothing(outcome) => (None, Some(outcome)),
    };
    sqlx::query(
        "INSERT INTO study_members (study, level, member, job_id, outcome)
         VALUES ($1, $2, $3, $4::uuid, $5)",
    )
    .bind(study)
    .bind(i64::from(new.level))
    .bind(integer(new.member))
    .bind(job)
    .bind(outcome)
    .execute(connection)
    .await?;
    Ok(true)
}

async fn is_made(connection: &mut PgConnection, study: i64, new: &NewMember) -> Answer<bool> {
    Ok(sqlx::query_scalar(
        "SELECT EXISTS (SELECT 1 FROM study_members
                        WHERE study = $1 AND level = $2 AND member = $3)",
    )
    .bind(study)
    .bind(i64::from(new.level))
    .bind(integer(new.member))
    .fetch_one(connection)
    .await?)
}

/// The job of a member: that of another study's member, or one that succeeded by this program, if
/// it has the same scenario and submitter; else a new one. A single job that has not ended is not
/// shared, since its client may dismiss it. A shared one is kept from being removed or dismissed
/// until the member is there.
async fn job_of(
    connection: &mut PgConnection,
    (job, submitter): (&NewJob, Option<&str>),
    now: Now,
) -> Answer<String> {
    let shared: Option<String> = sqlx::query_scalar(
        "SELECT id::text FROM jobs
         WHERE scenario_hash = $1 AND submitter IS NOT DISTINCT FROM $2
           AND (status IN ('accepted', 'running') AND priority = 1
                OR status = 'successful' AND solver_version = $3 AND solver_commit = $4)
         ORDER BY (status = 'successful') DESC, sequence LIMIT 1 FOR KEY SHARE",
    )
    .bind(&job.scenario_hash)
    .bind(submitter)
    .bind(job.solver_version)
    .bind(COMMIT)
    .fetch_optional(&mut *connection)
    .await?;
    if let Some(id) = shared {
        return Ok(id);
    }
    insert(connection, job, (submitter, Origin::Study), now).await?;
    let id = job.id.to_string();
    if let Some(missing) = name_in_job(connection, &id, &job.terrains).await? {
        return Err(terrain_is_gone(missing).into());
    }
    Ok(id)
}
