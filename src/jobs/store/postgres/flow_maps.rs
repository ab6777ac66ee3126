//! Maps of the flow of jobs on terrains.

use super::PostgresStore;
use super::error::Answer;
use crate::jobs::job::JobId;
use crate::jobs::store::rows::{MapRow, map_of};
use crate::results::terrain::{MapQuantity, StoredMap};
use sqlx::PgConnection;

impl PostgresStore {
    pub(super) async fn flow_maps(&self, job: JobId) -> Answer<Vec<MapQuantity>> {
        let names = sqlx::query_scalar("SELECT name FROM flow_maps WHERE job_id = $1::uuid");
        let names = names.bind(job.to_string());
        let names: Vec<String> = names.fetch_all(&self.pool).await?;
        let is_there = |quantity: &MapQuantity| names.iter().any(|name| name == quantity.name());
        Ok(MapQuantity::ALL.into_iter().filter(is_there).collect())
    }

    pub(super) async fn flow_map(
        &self,
        job: JobId,
        quantity: MapQuantity,
    ) -> Answer<Option<StoredMap>> {
        let row: Option<MapRow> = sqlx::query_as(
            "SELECT checksum, data FROM flow_maps WHERE job_id = $1::uuid AND name = $2",
        )
        .bind(job.to_string())
        .bind(quantity.name())
        .fetch_optional(&self.pool)
        .await?;
        Ok(row.map(|row| map_of(job, quantity, row)).transpose()?)
    }
}

pub(super) async fn write_map(
    connection: &mut PgConnection,
    job: JobId,
    map: &StoredMap,
) -> Answer<()> {
    sqlx::query(
        "INSERT INTO flow_maps (job_id, name, checksum, data) VALUES ($1::uuid, $2, $3, $4)
         ON CONFLICT (job_id, name) DO UPDATE
         SET checksum = excluded.checksum, data = excluded.data",
    )
    .bind(job.to_string())
    .bind(map.quantity.name())
    .bind(&map.file.checksum[..])
    .bind(&map.file.data)
    .execute(connection)
    .await?;
    Ok(())
}
