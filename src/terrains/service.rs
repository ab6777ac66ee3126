//! Terrain service: all operations on terrains that clients may ask for.

use super::description::Description;
use super::file::TerrainFile;
use super::hash::TerrainHash;
use super::reading::{FilePurpose, violation};
use crate::config::Limits;
use crate::jobs::store::{
    NewTerrain, StoreError, StoredTerrain, TerrainPage, TerrainRemoval, TerrainStore,
};
use crate::jobs::submit::Violation;
use crate::jobs::{AdmissionError, AdmissionPool};
use crate::quota::{InUse, Quota, UsedUp};
use std::sync::Arc;
use std::time::Duration;
use thiserror::Error;

/// Service that clients use to upload, read and remove terrains.
#[derive(Debug, Clone)]
pub struct TerrainService {
    store: Arc<dyn TerrainStore>,
    pool: AdmissionPool,
    uploads: Quota,
    limits: Limits,
}

/// A terrain as it is kept, and what was read of its file.
#[derive(Debug, Clone, PartialEq)]
pub struct Terrain {
    /// The terrain.
    pub stored: StoredTerrain,
    /// Its description.
    pub description: Description,
}

/// Reason why a file is not kept.
#[derive(Debug, Error)]
pub enum PutError {
    /// It is no raster for its purpose.
    #[error("{}", .0.detail)]
    Invalid(Violation),
    /// The request is not admitted.
    #[error(transparent)]
    Admission(#[from] AdmissionError),
    /// The store's own.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl TerrainService {
    /// Service for the terrains in this store, whose files are read in this pool.
    pub fn new(store: Arc<dyn TerrainStore>, pool: AdmissionPool, limits: Limits) -> Self {
        let uploads = Quota::new(limits.terrain_uploads, limits.terrain_uploads_per_caller());
        Self {
            store,
            pool,
            uploads,
            limits,
        }
    }

    /// A place for an upload of this caller, whose file is in memory meanwhile.
    ///
    /// # Errors
    /// There are as many uploads as the service, or the caller, may have.
    pub(crate) fn begin_upload(&self, caller: &str) -> Result<InUse, UsedUp> {
        self.uploads.enter(caller)
    }

    /// Largest file [bytes].
    pub fn most_bytes(&self) -> usize {
        self.limits.terrain_file_bytes
    }

    /// Longest time in which a file may arrive.
    pub fn upload_time(&self) -> Duration {
        self.limits.terrain_read_timeout()
    }

    /// Keeps a file whose values are of this purpose. True if it was new; one that is kept already
    /// is checked for the purpose all the same.
    ///
    /// # Errors
    /// [`PutError`].
    pub(crate) async fn put(
        &self,
        file: Vec<u8>,
        purpose: FilePurpose,
        (submitter, place): (Option<&str>, &InUse),
    ) -> Result<(Terrain, bool), PutError> {
        let place = self.pool.enter(place.caller())?;
        let most_cells = self.limits.terrain_cells;
        let read = place.read_raster(move || {
            let description = Description::of_file(most_cells, &file, purpose);
            description.map(|description| (TerrainHash::of(&file), description, file))
        });
        let read = read.await?;
        drop(place);
        let (hash, description, file) =
            read.map_err(|error| PutError::Invalid(violation(&error, purpose)))?;
        let new = NewTerrain {
            hash,
            file: &file,
            description: &written(&description)?,
            submitter,
        };
        let is_new = self.store.put_terrain(&new).await?;
        // It may be removed meanwhile; who uploads it again will find it gone.
        let stored = self.terrain(hash).await?;
        let stored = stored.ok_or_else(|| unreadable(hash, "row"))?;
        Ok((stored, is_new))
    }

    /// The terrain, if there is one.
    ///
    /// # Errors
    /// The store's own.
    pub async fn terrain(&self, hash: TerrainHash) -> Result<Option<Terrain>, StoreError> {
        let stored = self.store.terrain(hash).await?;
        stored.map(Terrain::of).transpose()
    }

    /// Terrains, newest first.
    ///
    /// # Errors
    /// The store's own.
    pub async fn terrains(&self, page: &TerrainPage) -> Result<Vec<Terrain>, StoreError> {
        let stored = self.store.terrains(page).await?;
        stored.into_iter().map(Terrain::of).collect()
    }

    /// The file of a terrain, from its beginning.
    pub fn file(&self, terrain: &Terrain) -> TerrainFile {
        TerrainFile::new(Arc::clone(&self.store), &terrain.stored)
    }

    /// Removes a terrain that no job and no study names.
    ///
    /// # Errors
    /// The store's own.
    pub async fn remove(&self, hash: TerrainHash) -> Result<TerrainRemoval, StoreError> {
        self.store.remove_terrain(hash).await
    }
}

impl Terrain {
    fn of(stored: StoredTerrain) -> Result<Self, StoreError> {
        let description = serde_json::from_str(&stored.description);
        Ok(Self {
            description: description.map_err(|_| unreadable(stored.hash, "description"))?,
            stored,
        })
    }
}

fn written(description: &Description) -> Result<String, StoreError> {
    serde_json::to_string(description).map_err(|error| StoreError::Defect(error.into()))
}

fn unreadable(hash: TerrainHash, what: &'static str) -> StoreError {
    StoreError::Row {
        job: format!("terrain {hash}"),
        what,
    }
}
