//! Rasters of terrains for use: read from the store once, and shared by all jobs of a process that
//! name them.

use super::file::TerrainFile;
use super::hash::TerrainHash;
use super::reading::{FilePurpose, raster, violation};
use crate::jobs::store::{StoreError, TerrainStore};
use crate::jobs::submit::{Violation, excerpt};
use scree_solver::raster::Raster;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use thiserror::Error;
use tokio::sync::Mutex as AsyncMutex;

/// Size of the rasters that are kept for further jobs [bytes]. The one used last is kept however
/// large it is: the members of a study mostly share one.
const KEPT_BYTES: usize = 256 << 20;

/// A raster as a document names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedRaster {
    /// JSON pointer to the field that names it.
    pub pointer: String,
    /// The name: the hash of a terrain.
    pub name: String,
    /// Use of its values.
    pub purpose: FilePurpose,
}

/// Error of rasters that can't be had.
#[derive(Debug, Error)]
pub enum LoadError {
    /// Fields that name no terrain, or one that does not suit their purpose.
    #[error("{}", details(.0))]
    Invalid(Vec<Violation>),
    /// The store's own.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// The rasters of a process. Clones share what is kept.
#[derive(Debug, Clone)]
pub struct Rasters {
    store: Arc<dyn TerrainStore>,
    kept: Arc<Mutex<Kept>>,
    /// Held while a file is read: of those who need the same one, one reads it, and at no time are
    /// several in memory twice, as file and as raster.
    reading: Arc<AsyncMutex<()>>,
}

/// A raster by its file and use: holes are something else in each.
type Key = (TerrainHash, FilePurpose);

/// Rasters that are kept, the one used last at the end.
#[derive(Debug)]
struct Kept {
    most_bytes: usize,
    rasters: VecDeque<(Key, Arc<Raster>)>,
}

impl Rasters {
    /// Rasters of the terrains in this store.
    pub fn new(store: Arc<dyn TerrainStore>) -> Self {
        let kept = Kept {
            most_bytes: KEPT_BYTES,
            rasters: VecDeque::new(),
        };
        Self {
            store,
            kept: Arc::new(Mutex::new(kept)),
            reading: Arc::default(),
        }
    }

    /// The rasters of these names, in their order.
    ///
    /// # Errors
    /// All fields that name no terrain, or one that does not suit its purpose; or the store's own.
    pub async fn load(&self, named: &[NamedRaster]) -> Result<Vec<Arc<Raster>>, LoadError> {
        let mut rasters = Vec::new();
        let mut violations = Vec::new();
        for one in named {
            match self.load_one(one).await? {
                Ok(raster) => rasters.push(raster),
                Err(violation) => violations.push(violation),
            }
        }
        if violations.is_empty() {
            Ok(rasters)
        } else {
            Err(LoadError::Invalid(violations))
        }
    }

    async fn load_one(
        &self,
        named: &NamedRaster,
    ) -> Result<Result<Arc<Raster>, Violation>, StoreError> {
        let Ok(hash) = named.name.parse() else {
            return Ok(Err(no_name(named)));
        };
        let key = (hash, named.purpose);
        if let Some(raster) = self.kept().find(key) {
            return Ok(Ok(raster));
        }
        let _reading = self.reading.lock().await;
        // Another may have read it meanwhile.
        if let Some(raster) = self.kept().find(key) {
            return Ok(Ok(raster));
        }
        let read = self.read(hash, named).await?;
        if let Ok(raster) = &read {
            self.kept().keep(key, Arc::clone(raster));
        }
        Ok(read)
    }

    /// A raster from the store.
    async fn read(
        &self,
        hash: TerrainHash,
        named: &NamedRaster,
    ) -> Result<Result<Arc<Raster>, Violation>, StoreError> {
        let Some(terrain) = self.store.terrain(hash).await? else {
            return Ok(Err(unknown(named)));
        };
        let file = TerrainFile::new(Arc::clone(&self.store), &terrain);
        let file = file.whole().await?;
        let purpose = named.purpose;
        let read = tokio::task::spawn_blocking(move || raster(&file, purpose));
        let read = read
            .await
            .map_err(|error| StoreError::Defect(error.into()))?;
        Ok(read.map(Arc::new).map_err(|error| Violation {
            pointer: named.pointer.clone(),
            ..violation(&error, purpose)
        }))
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Kept {
    fn find(&mut self, key: Key) -> Option<Arc<Raster>> {
        let place = self.rasters.iter().position(|(kept, _)| *kept == key)?;
        let found = self.rasters.remove(place)?;
        let raster = Arc::clone(&found.1);
        self.rasters.push_back(found);
        Some(raster)
    }

    fn keep(&mut self, key: Key, raster: Arc<Raster>) {
        self.rasters.push_back((key, raster));
        let mut bytes: usize = self.rasters.iter().map(|(_, one)| size(one)).sum();
        while bytes > self.most_bytes && self.rasters.len() > 1 {
            if let Some((_, oldest)) = self.rasters.pop_front() {
                bytes -= size(&oldest);
            }
        }
    }
}

fn size(raster: &Raster) -> usize {
    size_of_val(raster.values.as_slice())
}

/// The fault of a field that does not name anything.
fn no_name(named: &NamedRaster) -> Violation {
    let allowed = "the SHA-256 of a terrain's file, 64 hexadecimal digits in lower case";
    let detail = format!(
        "{} = \"{}\" names no terrain: {allowed}",
        named.pointer,
        excerpt(&named.name)
    );
    refused(named, allowed, detail)
}

/// The fault of a field that names a terrain which is not there.
fn unknown(named: &NamedRaster) -> Violation {
    let detail = format!(
        "{} names terrain {}, which is not in the database: upload its file first (POST /v1/terrains)",
        named.pointer, named.name
    );
    refused(named, "the name of an uploaded terrain", detail)
}

fn refused(named: &NamedRaster, allowed: &str, detail: String) -> Violation {
    Violation {
        pointer: named.pointer.clone(),
        value: excerpt(&named.name).into(),
        allowed: allowed.to_owned(),
        unit: None,
        detail,
    }
}

fn details(violations: &[Violation]) -> String {
    let details: Vec<_> = violations.iter().map(|one| one.detail.as_str()).collect();
    details.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::ServiceConfig;
    use crate::database::{self, Part};
    use crate::jobs::store::{NewTerrain, TerrainRemoval};
    use tempfile::TempDir;

    fn grid(height: f64) -> Vec<u8> {
        let row = format!("{height} {height} {height}\n");
        format!("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\n{row}{row}{row}").into()
    }

    fn named(hash: &impl ToString, purpose: FilePurpose) -> NamedRaster {
        NamedRaster {
            pointer: "/terrain/height_map".to_owned(),
            name: hash.to_string(),
            purpose,
        }
    }

    async fn library(folder: &TempDir) -> Rasters {
        let config = ServiceConfig {
            database: folder.path().join("test.db").into(),
            ..ServiceConfig::default()
        };
        let store = database::open(&config, Part::Service, 1).await;
        Rasters::new(store.unwrap())
    }

    async fn put(rasters: &Rasters, file: &[u8]) -> TerrainHash {
        let terrain = NewTerrain {
            hash: TerrainHash::of(file),
            file,
            description: "{}",
            submitter: None,
        };
        assert!(rasters.store.put_terrain(&terrain).await.unwrap());
        terrain.hash
    }

    #[tokio::test]
    async fn a_raster_is_read_once_for_all_who_name_it() {
        let folder = TempDir::new().unwrap();
        let rasters = library(&folder).await;
        let hash = put(&rasters, &grid(7.0)).await;
        let asked = [named(&hash, FilePurpose::HeightMap)];
        let (one, other) = tokio::join!(rasters.load(&asked), rasters.load(&asked));
        let (one, other) = (one.unwrap(), other.unwrap());
        assert_eq!(one[0].values, [7.0; 9]);
        assert!(Arc::ptr_eq(&one[0], &other[0]));
        // What is kept needs no store.
        let removal = rasters.store.remove_terrain(hash).await.unwrap();
        assert_eq!(removal, TerrainRemoval::Removed);
        let again = rasters.clone().load(&asked).await.unwrap();
        assert!(Arc::ptr_eq(&one[0], &again[0]));
        let other_use = [named(&hash, FilePurpose::Thickness)];
        assert!(rasters.load(&other_use).await.is_err(), "read anew");
    }

    #[tokio::test]
    async fn every_field_that_is_at_fault_is_named() {
        let folder = TempDir::new().unwrap();
        let rasters = library(&folder).await;
        let low = put(&rasters, &grid(-20.0)).await;
        let asked = [
            named(&low, FilePurpose::HeightMap),
            named(&TerrainHash::of(b"nowhere"), FilePurpose::HeightMap),
            named(&"alps.tif", FilePurpose::HeightMap),
            named(&low, FilePurpose::Thickness),
        ];
        let Err(LoadError::Invalid(violations)) = rasters.load(&asked).await else {
            panic!("three of them are at fault");
        };
        assert_eq!(violations.len(), 3);
        assert!(
            violations
                .iter()
                .all(|one| one.pointer == "/terrain/height_map")
        );
        assert!(violations[0].detail.contains("POST /v1/terrains"));
        assert_eq!(violations[1].value, "alps.tif");
        assert_eq!(violations[2].value, -20.0);
    }

    #[tokio::test]
    async fn a_stored_file_that_was_changed_is_not_used() {
        let folder = TempDir::new().unwrap();
        let rasters = library(&folder).await;
        let file = grid(7.0);
        let terrain = NewTerrain {
            hash: TerrainHash::of(b"something else"),
            file: &file,
            description: "{}",
            submitter: None,
        };
        rasters.store.put_terrain(&terrain).await.unwrap();
        let asked = [named(&terrain.hash, FilePurpose::HeightMap)];
        let error = rasters.load(&asked).await.unwrap_err();
        assert!(
            matches!(error, LoadError::Store(StoreError::Row { .. })),
            "{error:?}"
        );
    }

    #[test]
    fn the_rasters_used_last_are_kept() {
        let raster = |cells: usize| {
            Arc::new(Raster {
                columns: cells,
                rows: 1,
                cell_size: 1.0,
                west: 0.0,
                south: 0.0,
                epsg: None,
                values: vec![0.0; cells],
            })
        };
        let key = |name: &str| (TerrainHash::of(name.as_bytes()), FilePurpose::HeightMap);
        let mut kept = Kept {
            most_bytes: 80,
            rasters: VecDeque::new(),
        };
        kept.keep(key("a"), raster(5));
        kept.keep(key("b"), raster(5));
        assert!(kept.find(key("a")).is_some());
        kept.keep(key("c"), raster(5));
        assert!(kept.find(key("b")).is_none(), "used least recently");
        assert!(kept.find(key("a")).is_some() && kept.find(key("c")).is_some());
        kept.keep(key("large"), raster(50));
        assert!(kept.find(key("large")).is_some() && kept.find(key("c")).is_none());
    }
}
