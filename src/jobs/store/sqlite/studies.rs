//! Studies: kept, enlarged, ended, removed.

use super::SqliteStore;
use super::error::Answer;
use super::queue::dismiss_row;
use super::size_limit::Purpose;
use super::terrains::name_in_study;
use crate::jobs::job::JobId;
use crate::jobs::store::page::REMOVED_AT_ONCE;
use crate::jobs::store::rows::{self, StudyRow, counts, job_id, parse_study, study_status};
use crate::jobs::store::{
    Dismissal, Enlarged, NewStudy, Removal, Room, StudyDismissal, StudyEnd, StudyPage,
    StudySubmitted,
};
use crate::studies::study::{MemberCounts, StoredStudy, StudyId, StudyStatus};
use sqlx::sqlite::SqliteConnection;
use sqlx::{Sqlite, Transaction};

const COLUMNS: &str =
    "sequence, id, status, title, created_ms, finished_ms, document, submitter, problem";

const COUNTS: &str = "(SELECT count(*) FROM study_members WHERE study = studies.sequence) AS made,
    (SELECT count(*) FROM study_members
     WHERE study = studies.sequence AND outcome IS NULL) AS in_work";

impl SqliteStore {
    pub(super) async fn add_study(&self, study: &NewStudy<'_>) -> Answer<StudySubmitted> {
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        if let Some(former) = former_study(&mut transaction, study).await? {
            return Ok(former);
        }
        if let Some(full) = no_room(&mut transaction, study.submitter, study.room).await? {
            return Ok(full);
        }
        sqlx::query(
            "INSERT INTO studies (id, created_ms, title, document, submitter, key, request_hash)
             VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
        )
        .bind(study.id.to_string())
        .bind(now.wall_ms)
        .bind(study.title)
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
        Ok(StudySubmitted::Accepted)
    }

    pub(super) async fn study(&self, id: StudyId) -> Answer<Option<StoredStudy>> {
        let row: Option<StudyRow> = sqlx::query_as(sqlx::AssertSqlSafe(format!(
            "SELECT {COLUMNS}, {COUNTS} FROM studies WHERE id = ?1"
        )))
        .bind(id.to_string())
        .fetch_optional(self.readers.pool())
        .await?;
        Ok(row.map(StudyRow::read).transpose()?)
    }

    pub(super) async fn studies(&self, page: &StudyPage) -> Answer<Vec<StoredStudy>> {
        // Each text has an index.
        let of_state = match page.status {
            Some(_) => "status = ?2",
            None => "?2 IS NULL",
        };
        let rows: Vec<StudyRow> = sqlx::query_as(sqlx::AssertSqlSafe(format!(
            "SELECT {COLUMNS}, {COUNTS} FROM studies
             WHERE sequence < ?1 AND {of_state} ORDER BY sequence DESC LIMIT ?3"
        )))
        .bind(page.before.unwrap_or(i64::MAX))
        .bind(page.status.map(StudyStatus::word))
        .bind(page.limit)
        .fetch_all(self.readers.pool())
        .await?;
        let studies: Result<_, _> = rows.into_iter().map(StudyRow::read).collect();
        Ok(studies?)
    }

    pub(super) async fn running_studies(&self) -> Answer<Vec<(StudyId, MemberCounts)>> {
        let rows: Vec<(String, i64, i64)> = sqlx::query_as(sqlx::AssertSqlSafe(format!(
            "SELECT id, {COUNTS} FROM studies WHERE status = 'running' ORDER BY sequence"
        )))
        .fetch_all(self.readers.pool())
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
        let mut transaction = self.begin_write(Purpose::Growth).await?;
        match status_of(&mut transaction, id).await? {
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
             SET document = ?2, status = 'running', finished_ms = NULL, ended_operating_ms = NULL
             WHERE id = ?1",
        )
        .bind(id.to_string())
        .bind(document)
        .execute(&mut *transaction)
        .await?;
        transaction.commit().await?;
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
        let now = self.now();
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        match status_of(&mut transaction, id).await? {
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
             SET status = ?2, finished_ms = ?3, ended_operating_ms = ?4, problem = ?5
             WHERE id = ?1",
        )
        .bind(id.to_string())
        .bind(status.word())
        .bind(now.wall_ms)
        .bind(now.operating_ms)
        .bind(problem)
        .execute(&mut *transaction)
        .await?;
        let mut dismissed = Vec::new();
        for job in jobs_of_no_other(&mut transaction, id).await? {
            if dismiss_row(&mut transaction, &job.to_string(), now).await? == Dismissal::Dismissed {
                dismissed.push(job);
            }
        }
        transaction.commit().await?;
        Ok(StudyDismissal::Done(dismissed))
    }

    pub(super) async fn remove_study(&self, id: StudyId) -> Answer<Removal> {
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        match status_of(&mut transaction, id).await? {
            None => return Ok(Removal::Unknown),
            Some(StudyStatus::Running) => return Ok(Removal::Active),
            Some(_) => {}
        }
        sqlx::query(
            "INSERT OR IGNORE INTO orphaned_jobs (job_id)
             SELECT job_id FROM study_members AS own
             WHERE study = (SELECT sequence FROM studies WHERE id = ?1) AND job_id IS NOT NULL
               AND NOT EXISTS (SELECT 1 FROM study_members AS other
                               WHERE other.job_id = own.job_id AND other.study <> own.study)",
        )
        .bind(id.to_string())
        .execute(&mut *transaction)
        .await?;
        sqlx::query("DELETE FROM studies WHERE id = ?1")
            .bind(id.to_string())
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(Removal::Removed)
    }

    pub(super) async fn study_ended_before(&self, age_ms: i64) -> Answer<Option<StudyId>> {
        let id: Option<String> = sqlx::query_scalar(
            "SELECT id FROM studies WHERE ended_operating_ms <= ?1
             ORDER BY ended_operating_ms LIMIT 1",
        )
        .bind(self.operating_ms().saturating_sub(age_ms))
        .fetch_optional(self.readers.pool())
        .await?;
        Ok(id.map(|id| parse_study(&id)).transpose()?)
    }

    pub(super) async fn remove_orphans(&self) -> Answer<u64> {
        let orphans: Vec<String> = sqlx::query_scalar("SELECT job_id FROM orphaned_jobs LIMIT ?1")
            .bind(REMOVED_AT_ONCE)
            .fetch_all(self.readers.pool())
            .await?;
        if orphans.is_empty() {
            return Ok(0);
        }
        let mut transaction = self.begin_write(Purpose::Upkeep).await?;
        for job in &orphans {
            // One that a new study shares meanwhile stays, and so does one that was submitted by
            // itself.
            sqlx::query(
                "DELETE FROM jobs
                 WHERE id = ?1 AND priority = 1 AND finished_ms IS NOT NULL
                   AND NOT EXISTS (SELECT 1 FROM study_members WHERE job_id = ?1)",
            )
            .bind(job)
            .execute(&mut *transaction)
            .await?;
            sqlx::query("DELETE FROM orphaned_jobs WHERE job_id = ?1")
                .bind(job)
                .execute(&mut *transaction)
                .await?;
        }
        transaction.commit().await?;
        Ok(orphans.len() as u64)
    }
}

async fn submitter_of(
    transaction: &mut Transaction<'_, Sqlite>,
    id: StudyId,
) -> Answer<Option<String>> {
    Ok(
        sqlx::query_scalar("SELECT submitter FROM studies WHERE id = ?1")
            .bind(id.to_string())
            .fetch_one(&mut **transaction)
            .await?,
    )
}

async fn no_room(
    transaction: &mut Transaction<'_, Sqlite>,
    submitter: Option<&str>,
    room: Room,
) -> Answer<Option<StudySubmitted>> {
    let running = sqlx::query_as(
        "SELECT count(*), count(*) FILTER (WHERE submitter = ?1)
         FROM studies WHERE status = 'running'",
    )
    .bind(submitter)
    .fetch_one(&mut **transaction)
    .await?;
    Ok(room.beyond_studies(running))
}

/// The study of an earlier request with the same key.
async fn former_study(
    transaction: &mut Transaction<'_, Sqlite>,
    study: &NewStudy<'_>,
) -> Answer<Option<StudySubmitted>> {
    let Some(key) = study.key else {
        return Ok(None);
    };
    let row: Option<(String, Vec<u8>)> = sqlx::query_as(
        "SELECT id, request_hash FROM studies
         WHERE coalesce(submitter, '') = ?1 AND key = ?2",
    )
    .bind(study.submitter.unwrap_or_default())
    .bind(&key.text)
    .fetch_optional(&mut **transaction)
    .await?;
    Ok(row.map(|row| rows::former_study(row, key)).transpose()?)
}

pub(super) async fn status_of(
    connection: &mut SqliteConnection,
    id: StudyId,
) -> Answer<Option<StudyStatus>> {
    let word: Option<String> = sqlx::query_scalar("SELECT status FROM studies WHERE id = ?1")
        .bind(id.to_string())
        .fetch_optional(connection)
        .await?;
    Ok(word.map(|word| study_status(id, &word)).transpose()?)
}

/// True if a study has another document than this one.
async fn is_changed(
    connection: &mut SqliteConnection,
    id: StudyId,
    document: Option<&str>,
) -> Answer<bool> {
    let Some(document) = document else {
        return Ok(false);
    };
    Ok(
        sqlx::query_scalar("SELECT document <> ?2 FROM studies WHERE id = ?1")
            .bind(id.to_string())
            .bind(document)
            .fetch_one(connection)
            .await?,
    )
}

/// Jobs in the queue or running that were made for a study and that no other running one has.
async fn jobs_of_no_other(connection: &mut SqliteConnection, id: StudyId) -> Answer<Vec<JobId>> {
    let ids: Vec<String> = sqlx::query_scalar(
        "SELECT own.job_id FROM study_members AS own
         JOIN jobs ON jobs.id = own.job_id
         WHERE own.study = (SELECT sequence FROM studies WHERE id = ?1) AND own.outcome IS NULL
           AND jobs.priority = 1 AND jobs.status IN ('accepted', 'running')
           AND NOT EXISTS (SELECT 1 FROM study_members AS other
                           JOIN studies ON studies.sequence = other.study
                           WHERE other.job_id = own.job_id AND other.study <> own.study
                             AND studies.status = 'running')",
    )
    .bind(id.to_string())
    .fetch_all(connection)
    .await?;
    let ids: Result<_, _> = ids.iter().map(|id| job_id(id)).collect();
    Ok(ids?)
}
