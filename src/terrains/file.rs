//! Reading of a stored file, piece by piece, held to its hash.

use super::hash::{TerrainHash, TerrainHasher};
use crate::jobs::store::{StoreError, StoredTerrain, TerrainStore};
use std::sync::Arc;

/// A stored file that is being read. It holds one piece at a time, and the last is given only if
/// all of them together have the hash that names the terrain.
#[derive(Debug)]
pub struct TerrainFile {
    store: Arc<dyn TerrainStore>,
    hash: TerrainHash,
    /// Bytes still to come.
    rest: u64,
    next: u32,
    hasher: TerrainHasher,
}

impl TerrainFile {
    /// The file of a terrain in this store.
    pub fn new(store: Arc<dyn TerrainStore>, terrain: &StoredTerrain) -> Self {
        Self {
            store,
            hash: terrain.hash,
            rest: terrain.bytes,
            next: 0,
            hasher: TerrainHasher::default(),
        }
    }

    /// The next piece; `None` after the last.
    ///
    /// # Errors
    /// The store's own, or what is stored is not what was uploaded.
    pub async fn next_piece(&mut self) -> Result<Option<Vec<u8>>, StoreError> {
        if self.rest == 0 {
            return Ok(None);
        }
        let piece = self.store.terrain_piece(self.hash, self.next).await?;
        let piece = piece.filter(|piece| !piece.is_empty() && piece.len() as u64 <= self.rest);
        let piece = piece.ok_or_else(|| self.damaged())?;
        self.next += 1;
        self.rest -= piece.len() as u64;
        let mut hasher = std::mem::take(&mut self.hasher);
        let hashed = tokio::task::spawn_blocking(move || {
            hasher.update(&piece);
            (hasher, piece)
        });
        let (hasher, piece) = hashed
            .await
            .map_err(|error| StoreError::Defect(error.into()))?;
        if self.rest == 0 && hasher.clone().finish() != self.hash {
            return Err(self.damaged());
        }
        self.hasher = hasher;
        Ok(Some(piece))
    }

    /// The whole file, or what is left of it.
    ///
    /// # Errors
    /// As for [`TerrainFile::next_piece`].
    pub async fn whole(mut self) -> Result<Vec<u8>, StoreError> {
        let mut file = Vec::with_capacity(usize::try_from(self.rest).unwrap_or(0));
        while let Some(piece) = self.next_piece().await? {
            file.extend_from_slice(&piece);
        }
        Ok(file)
    }

    fn damaged(&self) -> StoreError {
        StoreError::Row {
            job: format!("terrain {}", self.hash),
            what: "file",
        }
    }
}
