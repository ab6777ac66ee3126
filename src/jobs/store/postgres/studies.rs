//! Studies: kept, enlarged, ended, removed.

use super::error::Answer;
use super::locks::Turn;
use super::news::Subject;
use super::submission::text;
use super::terrains::name_in_study;
use super::{Now, PostgresStore};
use crate::jobs::job::JobId;
use crate::jobs::store::page::REMOVED_AT_ONCE;
use crate::jobs::store::rows::{self, StudyRow, counts, job_id, parse_study, study_status};
use crate::jobs::store::{
    Enlarged, NewStudy, Removal, Room, StudyDismissal, StudyEnd, StudyPage, StudySubmitted,
};
use crate::studies::study::{MemberCounts, StoredStudy, StudyId, StudyStatus};
use sqlx::PgConnection;

/// Columns of a study; the numbers of its members are counted as they are made and noted.
macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT sequence, id::text AS id, status, title, created_ms, finished_ms, document,
                    submitter, problem, made, made - noted AS in_work
             FROM studies, LATERAL (
                 SELECT coalesce(sum(on_level), 0)::bigint AS made
                 FROM unnest(made_on_levels) AS on_level
             ) AS members ",
            $rest
        )
    };
}

impl PostgresStore {
    pub(super) async fn add_study(&self, study: &NewStudy<'_>) -> Answer<StudySubmitted> {
        let now = self.now().await?;
        let mut transaction = self.begin_in_turn(Turn::Study).await?;
        if let Some(former) = former_study(&mut transaction, study).await? {
            return Ok(former);
        }
        if let Some(full) = no_room(&mut transaction, study.submitter, study.room).await? {
            return Ok(full);
        }
        sqlx::query(
            "INSERT INTO studies (id, created_ms, title, document, submitter, key, request_hash)
             VALUES ($1::uuid, $2, $3, $4, $5, $6, $7)",
        )
        .bind(study.id.to_string())
        .bind(now.wall_ms)
        .bind(text(study.title))
        .bind(study.document)
        .bind(study.submitter)
        .bind(study.key.map(|key| &key.text))
        .bind(study.key.map(|key| &key.request_hash[..]))
        .execute(&mut *transaction)
        .await?;
        let id = study.id.to_string();
        if let Some(missing) = name_in_study(&mut transaction, &id, study.terrains).await? {
            return Ok(StudySubmitted::NoTerrain(missing));
        }
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(StudySubmitted::Accepted)
    }

    pub(super) async fn study(&self, id: StudyId) -> Answer<Option<StoredStudy>> {
        let row: Option<StudyRow> = sqlx::query_as(select!("WHERE id = $1::uuid"))
            .bind(id.to_string())
            .fetch_optional(&self.pool)
            .await?;
        Ok(row.map(StudyRow::read).transpose()?)
    }

    pub(super) async fn studies(&self, page: &StudyPage) -> Answer<Vec<StoredStudy>> {
        // Each text has an index.
        let query = match page.status {
            Some(_) => {
                select!("WHERE sequence < $1 AND status = $2 ORDER BY sequence DESC LIMIT $3")
            }
            None => {
                select!("WHERE sequence < $1 AND $2::text IS NULL ORDER BY sequence DESC LIMIT $3")
            }
        };
        let rows: Vec<StudyRow> = sqlx::query_as(query)
            .bind(page.before.unwrap_or(i64::MAX))
            .bind(page.status.map(StudyStatus::word))
            .bind(i64::from(page.limit))
            .fetch_all(&self.pool)
            .await?;
        let studies: Result<_, _> = rows.into_iter().map(StudyRow::read).collect();
        Ok(studies?)
    }

    pub(super) async fn running_studies(&self) -> Answer<Vec<(StudyId, MemberCounts)>> {
        let rows: Vec<(String, i64, i64)> = sqlx::query_as(
            "SELECT id::text, made, made - noted
             FROM studies, LATERAL (
                 SELECT coalesce(sum(on_level), 0)::bigint AS made
                 FROM unnest(made_on_levels) AS on_level
             ) AS members
             WHERE status = 'running' ORDER BY sequence",
        )
        .fetch_all(&self.pool)
        .await?;
        let read = |(id, made, in_work): (String, i64, i64)| {
            Ok((parse_study(&id)?, counts(made, in_work)))
        };
        rows.into_iter().map(read).collect()
    }

    pub(super) async fn enlarge_study(
        &self,
        id: StudyId,
        (former, document): (&str, &str),
        room: Room,
    ) -> Answer<Enlarged> {
        let mut transaction = self.begin_in_turn(Turn::Study).await?;
        match locked_status(&mut transaction, id).await? {
            None => return Ok(Enlarged::Unknown),
            Some(status @ (StudyStatus::Failed | StudyStatus::Dismissed)) => {
                return Ok(Enlarged::Ended(status));
            }
            Some(StudyStatus::Running) => {}
            Some(StudyStatus::Successful) => {
                let submitter = submitter_of(&mut transaction, id).await?;
                let full = no_room(&mut transaction, submitter.as_deref(), room).await?;
                if let Some(StudySubmitted::Full(count) | StudySubmitted::QuotaSpent(count)) = full
                {
                    return Ok(Enlarged::Full(count));
                }
            }
        }
        if is_changed(&mut transaction, id, Some(former)).await? {
            return Ok(Enlarged::Changed);
        }
        sqlx::query(
            "UPDATE studies
             SET document = $2, status = 'running', finished_ms = NULL, ended_operating_ms = NULL
             WHERE id = $1::uuid",
        )
        .bind(id.to_string())
        .bind(document)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(Enlarged::Done)
    }

    pub(super) async fn end_study(
        &self,
        id: StudyId,
        StudyEnd {
            status,
            problem,
            document,
        }: StudyEnd<'_>,
    ) -> Answer<StudyDismissal> {
        let now = self.now().await?;
        let mut transaction = self.begin_in_turn(Turn::Study).await?;
        match locked_status(&mut transaction, id).await? {
            None => return Ok(StudyDismissal::Unknown),
            Some(StudyStatus::Running) => {}
            Some(before) if before == status => return Ok(StudyDismissal::Done(Vec::new())),
            Some(before) => return Ok(StudyDismissal::Ended(before)),
        }
        if is_changed(&mut transaction, id, document).await? {
            return Ok(StudyDismissal::Changed);
        }
        sqlx::query(
            "UPDATE studies
             SET status = $2, finished_ms = $3, ended_operating_ms = $4, problem = $5
             WHERE id = $1::uuid",
        )
        .bind(id.to_string())
        .bind(status.word())
        .bind(now.wall_ms)
        .bind(now.operating_ms)
        .bind(problem)
        .execute(&mut *transaction)
        .await?;
        let dismissed = dismiss_members(&mut transaction, id, now).await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(StudyDismissal::Done(dismissed))
    }

    pub(super) async fn remove_study(&self, id: StudyId) -> Answer<Removal> {
        let mut transaction = self.begin_in_turn(Turn::Study).await?;
        match locked_status(&mut transaction, id).await? {
            None => return Ok(Removal::Unknown),
            Some(StudyStatus::Running) => return Ok(Removal::Active),
            Some(_) => {}
        }
        sqlx::query(
            "INSERT INTO orphaned_jobs (job_id)
             SELECT DISTINCT job_id FROM study_members AS own
             WHERE study = (SELECT sequence FROM studies WHERE id = $1::uuid)
               AND job_id IS NOT NULL
               AND NOT EXISTS (SELECT 1 FROM study_members AS other
                               WHERE other.job_id = own.job_id AND other.study <> own.study)
             ON CONFLICT DO NOTHING",
        )
        .bind(id.to_string())
        .execute(&mut *transaction)
        .await?;
        sqlx::query("DELETE FROM studies WHERE id = $1::uuid")
            .bind(id.to_string())
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(Removal::Removed)
    }

    pub(super) async fn study_ended_before(&self, age_ms: i64) -> Answer<Option<StudyId>> {
        let now = self.now().await?;
        let id: Option<String> = sqlx::query_scalar(
            "SELECT id::text FROM studies WHERE ended_operating_ms <= $1
             ORDER BY ended_operating_ms LIMIT 1",
        )
        .bind(now.operating_ms.saturating_sub(age_ms))
        .fetch_optional(&self.pool)
        .await?;
        Ok(id.map(|id| parse_study(&id)).transpose()?)
    }

    pub(super) async fn remove_orphans(&self) -> Answer<u64> {
        if !self.has_orphans().await? {
            return Ok(0);
        }
        let mut transaction = self.begin_in_turn(Turn::Removal).await?;
        let orphans: Vec<String> = sqlx::query_scalar(
            "DELETE FROM orphaned_jobs
             WHERE job_id IN (SELECT job_id FROM orphaned_jobs LIMIT $1)
             RETURNING job_id::text",
        )
        .bind(i64::from(REMOVED_AT_ONCE))
        .fetch_all(&mut *transaction)
        .await?;
        // Locked before it is asked who has them: a study that is taking one at this moment has it
        // then.
        sqlx::query("SELECT 1 FROM jobs WHERE id = ANY ($1::uuid[]) ORDER BY sequence FOR UPDATE")
            .bind(&orphans)
            .execute(&mut *transaction)
            .await?;
        // One that a new study shares meanwhile stays, and so does one that was submitted by
        // itself.
        sqlx::query(
            "DELETE FROM jobs
             WHERE id = ANY ($1::uuid[]) AND priority = 1 AND finished_ms IS NOT NULL
               AND NOT EXISTS (SELECT 1 FROM study_members WHERE job_id = jobs.id)",
        )
        .bind(&orphans)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
        self.news.tell(&[Subject::Events]);
        Ok(orphans.len() as u64)
    }

    async fn has_orphans(&self) -> Answer<bool> {
        let any = sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM orphaned_jobs)");
        Ok(any.fetch_one(&self.pool).await?)
    }
}

async fn submitter_of(connection: &mut PgConnection, id: StudyId) -> Answer<Option<String>> {
    Ok(
        sqlx::query_scalar("SELECT submitter FROM studies WHERE id = $1::uuid")
            .bind(id.to_string())
            .fetch_one(connection)
            .await?,
    )
}

async fn no_room(
    connection: &mut PgConnection,
    submitter: Option<&str>,
    room: Room,
) -> Answer<Option<StudySubmitted>> {
    let running = sqlx::query_as(
        "SELECT count(*), count(*) FILTER (WHERE submitter = $1) FROM studies
         WHERE status = 'running'",
    )
    .bind(submitter)
    .fetch_one(connection)
    .await?;
    Ok(room.beyond_studies(running))
}

async fn former_study(
    connection: &mut PgConnection,
    study: &NewStudy<'_>,
) -> Answer<Option<StudySubmitted>> {
    let Some(key) = study.key else {
        return Ok(None);
    };
    let row: Option<(String, Vec<u8>)> = sqlx::query_as(
        "SELECT id::text, request_hash FROM studies
         WHERE coalesce(submitter, '') = $1 AND key = $2",
    )
    .bind(study.submitter.unwrap_or_default())
    .bind(&key.text)
    .fetch_optional(connection)
    .await?;
    Ok(row.map(|row| rows::former_study(row, key)).transpose()?)
}

/// The state of a study, whose row is locked until the transaction ends.
pub(super) async fn locked_status(
    connection: &mut PgConnection,
    id: StudyId,
) -> Answer<Option<StudyStatus>> {
    let word: Option<String> =
        sqlx::query_scalar("SELECT status FROM studies WHERE id = $1::uuid FOR UPDATE")
            .bind(id.to_string())
            .fetch_optional(connection)
            .await?;
    Ok(word.map(|word| study_status(id, &word)).transpose()?)
}

/// True if a study has another document than this one.
async fn is_changed(
    connection: &mut PgConnection,
    id: StudyId,
    document: Option<&str>,
) -> Answer<bool> {
    let Some(document) = document else {
        return Ok(false);
    };
    Ok(
        sqlx::query_scalar("SELECT document <> $2 FROM studies WHERE id = $1::uuid")
            .bind(id.to_string())
            .bind(document)
            .fetch_one(connection)
            .await?,
    )
}

/// Jobs in the queue or running that were made for a study.
macro_rules! jobs_of_study {
    ($what:literal, $more:literal) => {
        concat!(
            "SELECT ",
            $what,
            " FROM study_members AS own
             JOIN jobs ON jobs.id = own.job_id
             WHERE own.study = (SELECT sequence FROM studies WHERE id = $1::uuid)
               AND own.outcome IS NULL
               AND jobs.priority = 1 AND jobs.status IN ('accepted', 'running') ",
            $more
        )
    };
}

/// Dismisses jobs that were made for a study and that no other running one has; returns them. They
/// are locked before it is asked who has them: a study that is taking one at this moment has it then.
async fn dismiss_members(
    connection: &mut PgConnection,
    id: StudyId,
    now: Now,
) -> Answer<Vec<JobId>> {
    sqlx::query(jobs_of_study!(
        "jobs.sequence",
        "ORDER BY jobs.sequence FOR UPDATE OF jobs"
    ))
    .bind(id.to_string())
    .execute(&mut *connection)
    .await?;
    let ids: Vec<String> = sqlx::query_scalar(concat!(
        "WITH alone AS (",
        jobs_of_study!(
            "DISTINCT jobs.id",
            "AND NOT EXISTS (SELECT 1 FROM study_members AS other
                             JOIN studies ON studies.sequence = other.study
                             WHERE other.job_id = own.job_id AND other.study <> own.study
                               AND studies.status = 'running')"
        ),
        "), dismissed AS (
             UPDATE jobs
             SET status = 'dismissed', finished_ms = $2, ended_operating_ms = $3, eta_s = NULL,
                 lease_owner = NULL, lease_expires_operating_ms = NULL
             FROM alone WHERE jobs.id = alone.id RETURNING jobs.id, jobs.attempt
         ), ended AS (
             UPDATE attempts SET ended_ms = $2, ending = 'dismissed'
             FROM dismissed
             WHERE job_id = dismissed.id AND attempts.attempt = dismissed.attempt
               AND ending IS NULL
         )
         SELECT id::text FROM dismissed"
    ))
    .bind(id.to_string())
    .bind(now.wall_ms)
    .bind(now.operating_ms)
    .fetch_all(connection)
    .await?;
    let ids: Result<_, _> = ids.iter().map(|id| job_id(id)).collect();
    Ok(ids?)
}
