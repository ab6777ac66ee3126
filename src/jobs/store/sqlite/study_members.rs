//! Members of studies: made, ended, read.

use super::error::Answer;
use super::size_limit::Purpose;
use super::studies::status_of;
use super::submission::insert;
use super::terrains::name_in_job;
use super::{Now, SqliteStore};
use crate::jobs::store::rows::{
    EndedRow, MemberRow, integer, made_by_level, member_outcome, terrain_is_gone,
};
use crate::jobs::store::submission::Origin;
use crate::jobs::store::{EndedMember, ListedMember, MemberOutcome, MemberWork, NewMember};
use crate::jobs::submit::NewJob;
use crate::runs::COMMIT;
use crate::studies::study::{StudyId, StudyStatus};
use sqlx::sqlite::SqliteConnection;

/// Largest number of ended members that are read at a time.
const ENDED_AT_ONCE: u32 = 100;

impl SqliteStore {
    pub(super) async fn add_members(&self, study: StudyId, members: &[NewMember]) -> Answer<usize> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        if status_of(&mut transaction, study).await? != Some(StudyStatus::Running) {
            return Ok(0);
        }
        let (sequence, submitter): (i64, Option<String>) =
            sqlx::query_as("SELECT sequence, submitter FROM studies WHERE id = ?1")
                .bind(study.to_string())
                .fetch_one(&mut *transaction)
                .await?;
        let mut added = 0;
        for new in members {
            if is_made(&mut transaction, sequence, new).await? {
                continue;
            }
            let (job, outcome) = match &new.work {
                MemberWork::Job(job) => {
                    let wanted = (&**job, submitter.as_deref());
                    (Some(job_of(&mut transaction, wanted, now).await?), None)
                }
                MemberWork::Nothing(outcome) => (None, Some(outcome)),
            };
            sqlx::query(
                "INSERT INTO study_members (study, level, member, job_id, outcome)
                 VALUES (?1, ?2, ?3, ?4, ?5)",
            )
            .bind(sequence)
            .bind(new.level)
            .bind(integer(new.member))
            .bind(job)
            .bind(outcome)
            .execute(&mut *transaction)
            .await?;
            added += 1;
        }
        transaction.commit().await?;
        Ok(added)
    }

    pub(super) async fn members_made(&self, study: StudyId) -> Answer<Vec<u64>> {
        let rows: Vec<(i64, i64)> = sqlx::query_as(
            "SELECT level, count(*) FROM study_members
             WHERE study = (SELECT sequence FROM studies WHERE id = ?1) GROUP BY level",
        )
        .bind(study.to_string())
        .fetch_all(self.readers.pool())
        .await?;
        Ok(made_by_level(&rows)?)
    }

    pub(super) async fn members(
        &self,
        study: StudyId,
        (level, member): (u32, u64),
        limit: u32,
    ) -> Answer<Vec<ListedMember>> {
        let rows: Vec<MemberRow> = sqlx::query_as(
            "SELECT level, member, job_id, jobs.status AS status, study_members.outcome AS outcome
             FROM study_members LEFT JOIN jobs ON jobs.id = job_id
             WHERE study = (SELECT sequence FROM studies WHERE id = ?1)
               AND level = ?2 AND member >= ?3
             ORDER BY member LIMIT ?4",
        )
        .bind(study.to_string())
        .bind(level)
        .bind(integer(member))
        .bind(limit)
        .fetch_all(self.readers.pool())
        .await?;
        let members: Result<_, _> = rows.into_iter().map(MemberRow::read).collect();
        Ok(members?)
    }

    pub(super) async fn ended_members(&self, study: StudyId) -> Answer<Vec<EndedMember>> {
        let rows: Vec<EndedRow> = sqlx::query_as(
            "SELECT level, member, jobs.status AS status, jobs.outcome AS outcome, jobs.problem AS problem
             FROM study_members LEFT JOIN jobs ON jobs.id = job_id
             WHERE study = (SELECT sequence FROM studies WHERE id = ?1)
               AND study_members.outcome IS NULL
               AND (jobs.id IS NULL OR jobs.finished_ms IS NOT NULL)
             LIMIT ?2",
        )
        .bind(study.to_string())
        .bind(ENDED_AT_ONCE)
        .fetch_all(self.readers.pool())
        .await?;
        let ended: Result<_, _> = rows.into_iter().map(EndedRow::read).collect();
        Ok(ended?)
    }

    pub(super) async fn note_outcomes(
        &self,
        study: StudyId,
        outcomes: &[MemberOutcome],
    ) -> Answer<()> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        for noted in outcomes {
            sqlx::query(
                "UPDATE study_members SET outcome = ?4
                 WHERE study = (SELECT sequence FROM studies WHERE id = ?1)
                   AND level = ?2 AND member = ?3 AND outcome IS NULL",
            )
            .bind(study.to_string())
            .bind(noted.level)
            .bind(integer(noted.member))
            .bind(&noted.outcome)
            .execute(&mut *transaction)
            .await?;
        }
        transaction.commit().await?;
        Ok(())
    }

    pub(super) async fn outcomes(&self, study: StudyId) -> Answer<Vec<MemberOutcome>> {
        let rows: Vec<(i64, i64, String)> = sqlx::query_as(
            "SELECT level, member, outcome FROM study_members
             WHERE study = (SELECT sequence FROM studies WHERE id = ?1) AND outcome IS NOT NULL
             ORDER BY level, member",
        )
        .bind(study.to_string())
        .fetch_all(self.readers.pool())
        .await?;
        let outcomes: Result<_, _> = rows.into_iter().map(member_outcome).collect();
        Ok(outcomes?)
    }
}

async fn is_made(connection: &mut SqliteConnection, study: i64, new: &NewMember) -> Answer<bool> {
    Ok(sqlx::query_scalar(
        "SELECT EXISTS (SELECT 1 FROM study_members
                        WHERE study = ?1 AND level = ?2 AND member = ?3)",
    )
    .bind(study)
    .bind(new.level)
    .bind(integer(new.member))
    .fetch_one(connection)
    .await?)
}

/// The job of a member: that of another study's member, or one that succeeded by this program, if
/// it has the same scenario and submitter; else a new one. A single job that has not ended is not
/// shared, since its client may dismiss it.
async fn job_of(
    connection: &mut SqliteConnection,
    (job, submitter): (&NewJob, Option<&str>),
    now: Now,
) -> Answer<String> {
    let shared: Option<String> = sqlx::query_scalar(
        "SELECT id FROM jobs
         WHERE scenario_hash = ?1 AND submitter IS ?2
           AND (status IN ('accepted', 'running') AND priority = 1
                OR status = 'successful' AND solver_version = ?3 AND solver_commit = ?4)
         ORDER BY status = 'successful' DESC, sequence LIMIT 1",
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
