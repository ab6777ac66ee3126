//! Terrains: kept, read, removed, and named by jobs and studies.
//!
//! Who names a terrain holds its row until the name is noted, and a removal takes the row first: so
//! none is removed that is just being named.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::store::rows::{TerrainRow, integer};
use crate::jobs::store::terrains::PIECE_BYTES;
use crate::jobs::store::{NewTerrain, StoredTerrain, TerrainPage, TerrainRemoval};
use crate::terrains::TerrainHash;
use sqlx::PgConnection;

impl PostgresStore {
    pub(super) async fn put_terrain(&self, terrain: &NewTerrain<'_>) -> Answer<bool> {
        let now_ms = self.clock.now().as_millisecond();
        let mut transaction = self.begin().await?;
        let sequence: Option<i64> = sqlx::query_scalar(
            "INSERT INTO terrains (hash, created_ms, bytes, description, submitter)
             VALUES ($1, $2, $3, $4, $5) ON CONFLICT (hash) DO NOTHING RETURNING sequence",
        )
        .bind(terrain.hash.to_string())
        .bind(now_ms)
        .bind(integer(terrain.file.len() as u64))
        .bind(terrain.description)
        .bind(terrain.submitter)
        .fetch_optional(&mut *transaction)
        .await?;
        let Some(sequence) = sequence else {
            return Ok(false);
        };
        write_file(&mut transaction, sequence, terrain.file).await?;
        transaction.commit().await?;
        Ok(true)
    }

    pub(super) async fn terrain(&self, hash: TerrainHash) -> Answer<Option<StoredTerrain>> {
        let row: Option<TerrainRow> = sqlx::query_as(
            "SELECT sequence, hash, created_ms, bytes, description, submitter
             FROM terrains WHERE hash = $1",
        )
        .bind(hash.to_string())
        .fetch_optional(&self.pool)
        .await?;
        Ok(row.map(TerrainRow::read).transpose()?)
    }

    pub(super) async fn terrain_piece(
        &self,
        hash: TerrainHash,
        piece: u32,
    ) -> Answer<Option<Vec<u8>>> {
        let data = sqlx::query_scalar(
            "SELECT data FROM terrain_pieces
             WHERE terrain = (SELECT sequence FROM terrains WHERE hash = $1) AND piece = $2",
        );
        let data = data.bind(hash.to_string()).bind(i64::from(piece));
        Ok(data.fetch_optional(&self.pool).await?)
    }

    pub(super) async fn terrains(&self, page: &TerrainPage) -> Answer<Vec<StoredTerrain>> {
        let rows: Vec<TerrainRow> = sqlx::query_as(
            "SELECT sequence, hash, created_ms, bytes, description, submitter
             FROM terrains WHERE sequence < $1 ORDER BY sequence DESC LIMIT $2",
        )
        .bind(page.before.unwrap_or(i64::MAX))
        .bind(i64::from(page.limit))
        .fetch_all(&self.pool)
        .await?;
        let terrains: Result<_, _> = rows.into_iter().map(TerrainRow::read).collect();
        Ok(terrains?)
    }

    pub(super) async fn remove_terrain(&self, hash: TerrainHash) -> Answer<TerrainRemoval> {
        let mut transaction = self.begin().await?;
        let sequence: Option<i64> =
            sqlx::query_scalar("SELECT sequence FROM terrains WHERE hash = $1 FOR UPDATE")
                .bind(hash.to_string())
                .fetch_optional(&mut *transaction)
                .await?;
        let Some(sequence) = sequence else {
            return Ok(TerrainRemoval::Unknown);
        };
        if let Some(in_use) = uses(&mut transaction, sequence).await? {
            return Ok(in_use);
        }
        sqlx::query("DELETE FROM terrains WHERE sequence = $1")
            .bind(sequence)
            .execute(&mut *transaction)
            .await?;
        transaction.commit().await?;
        Ok(TerrainRemoval::Removed)
    }
}

async fn write_file(connection: &mut PgConnection, terrain: i64, file: &[u8]) -> Answer<()> {
    for (piece, data) in file.chunks(PIECE_BYTES).enumerate() {
        sqlx::query("INSERT INTO terrain_pieces (terrain, piece, data) VALUES ($1, $2, $3)")
            .bind(terrain)
            .bind(integer(piece as u64))
            .bind(data)
            .execute(&mut *connection)
            .await?;
    }
    Ok(())
}

/// The jobs and studies that name a terrain, which can't be removed then.
async fn uses(connection: &mut PgConnection, terrain: i64) -> Answer<Option<TerrainRemoval>> {
    let (jobs, studies): (i64, i64) = sqlx::query_as(
        "SELECT (SELECT count(*) FROM job_terrains WHERE terrain = $1),
                (SELECT count(*) FROM study_terrains WHERE terrain = $1)",
    )
    .bind(terrain)
    .fetch_one(connection)
    .await?;
    let in_use = TerrainRemoval::InUse {
        jobs: jobs.unsigned_abs(),
        studies: studies.unsigned_abs(),
    };
    Ok(((jobs, studies) != (0, 0)).then_some(in_use))
}

/// Number of a terrain, which is not removed until the end of the transaction.
async fn held(connection: &mut PgConnection, hash: TerrainHash) -> Answer<Option<i64>> {
    let number = sqlx::query_scalar("SELECT sequence FROM terrains WHERE hash = $1 FOR KEY SHARE");
    let number = number.bind(hash.to_string());
    Ok(number.fetch_optional(connection).await?)
}

/// Notes the terrains that a job names. The first that does not exist, if there is one.
pub(super) async fn name_in_job(
    connection: &mut PgConnection,
    job: &str,
    terrains: &[TerrainHash],
) -> Answer<Option<TerrainHash>> {
    let statement =
        "INSERT INTO job_terrains (job_id, terrain) VALUES ($1::uuid, $2) ON CONFLICT DO NOTHING";
    name(connection, statement, job, terrains).await
}

/// Notes the terrains that a study names. The first that does not exist, if there is one.
pub(super) async fn name_in_study(
    connection: &mut PgConnection,
    study: &str,
    terrains: &[TerrainHash],
) -> Answer<Option<TerrainHash>> {
    let statement = "INSERT INTO study_terrains (study, terrain)
         SELECT sequence, $2 FROM studies WHERE id = $1::uuid ON CONFLICT DO NOTHING";
    name(connection, statement, study, terrains).await
}

/// Notes terrains by a statement that takes who names them and a terrain's number.
async fn name(
    connection: &mut PgConnection,
    statement: &'static str,
    namer: &str,
    terrains: &[TerrainHash],
) -> Answer<Option<TerrainHash>> {
    for &hash in terrains {
        let Some(terrain) = held(connection, hash).await? else {
            return Ok(Some(hash));
        };
        sqlx::query(statement)
            .bind(namer)
            .bind(terrain)
            .execute(&mut *connection)
            .await?;
    }
    Ok(None)
}
