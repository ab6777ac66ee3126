//! Port between terrains and their database. A terrain's file is kept in pieces, so that nobody
//! who reads it needs to hold it whole.

use super::StoreError;
use crate::terrains::TerrainHash;
use async_trait::async_trait;
use jiff::Timestamp;
use std::fmt::Debug;

/// Length of a piece of a file; the last may be shorter [bytes].
pub(crate) const PIECE_BYTES: usize = 1 << 20;

type Answer<T> = Result<T, StoreError>;

/// A database of terrains. As for [`JobStore`](super::JobStore), every call is one transaction.
///
/// # Errors
/// As for [`JobStore`](super::JobStore).
#[async_trait]
pub trait TerrainStore: Debug + Send + Sync {
    /// Keeps a terrain with its file. `false`, with nothing changed, if it is kept already.
    async fn put_terrain(&self, terrain: &NewTerrain<'_>) -> Answer<bool>;

    /// The terrain without its file, if there is one.
    async fn terrain(&self, hash: TerrainHash) -> Answer<Option<StoredTerrain>>;

    /// A piece of a terrain's file, from number 0 on; `None` behind the last, and of a terrain that
    /// does not exist.
    async fn terrain_piece(&self, hash: TerrainHash, piece: u32) -> Answer<Option<Vec<u8>>>;

    /// Terrains without their files, newest first.
    async fn terrains(&self, page: &TerrainPage) -> Answer<Vec<StoredTerrain>>;

    /// Removes a terrain, unless a job or a study names it.
    async fn remove_terrain(&self, hash: TerrainHash) -> Answer<TerrainRemoval>;
}

/// A terrain to be kept.
#[derive(Debug, Clone, Copy)]
pub struct NewTerrain<'a> {
    /// Its name.
    pub hash: TerrainHash,
    /// Its file, not empty.
    pub file: &'a [u8],
    /// Its description, as JSON.
    pub description: &'a str,
    /// Name of the access token of the request.
    pub submitter: Option<&'a str>,
}

/// A terrain that is kept.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredTerrain {
    /// Its place in the order of arrival.
    pub sequence: i64,
    /// Its name.
    pub hash: TerrainHash,
    /// Length of its file [bytes].
    pub bytes: u64,
    /// Time of its arrival.
    pub created: Timestamp,
    /// Its description, as JSON.
    pub description: String,
    /// Name of the access token with which it came first.
    pub submitter: Option<String>,
}

/// Selection of terrains for a list, newest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TerrainPage {
    /// Only terrains that came before the one with this sequence number.
    pub before: Option<i64>,
    /// At most this many.
    pub limit: u32,
}

/// Result of a request to remove a terrain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TerrainRemoval {
    /// The terrain does not exist.
    Unknown,
    /// It is removed.
    Removed,
    /// Jobs or studies name it: their numbers.
    InUse {
        /// Jobs that name it, in whatever state.
        jobs: u64,
        /// Studies that name it.
        studies: u64,
    },
}
