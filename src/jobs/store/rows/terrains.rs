//! Terrains, without their files.

use super::broken;
use crate::jobs::store::{StoreError, StoredTerrain};
use crate::terrains::TerrainHash;
use jiff::Timestamp;
use sqlx::FromRow;

/// A terrain.
#[derive(Debug, FromRow)]
pub(in super::super) struct TerrainRow {
    sequence: i64,
    hash: String,
    created_ms: i64,
    bytes: i64,
    description: String,
    submitter: Option<String>,
}

impl TerrainRow {
    pub(in super::super) fn read(self) -> Result<StoredTerrain, StoreError> {
        let broken = |what| broken(&format!("terrain {}", self.hash), what);
        Ok(StoredTerrain {
            sequence: self.sequence,
            hash: self.hash.parse().map_err(|_| broken("hash"))?,
            bytes: self.bytes.unsigned_abs(),
            created: Timestamp::from_millisecond(self.created_ms).map_err(|_| broken("a time"))?,
            description: self.description,
            submitter: self.submitter,
        })
    }
}

/// A member of a study whose terrain is gone, although its study names it.
pub(in super::super) fn terrain_is_gone(hash: TerrainHash) -> StoreError {
    broken(&format!("terrain {hash}"), "file")
}
