//! Maps that a scenario names: rasters by the SHA-256 of their files.

use crate::bed::SplineSurface;
use crate::raster::Raster;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

/// Maps by the SHA-256 of their files. Clones share what is made of them.
#[derive(Clone, Default)]
pub struct Maps {
    rasters: BTreeMap<String, Arc<Raster>>,
    /// Whole numbers of metres below their lowest places.
    datums: BTreeMap<String, f64>,
    /// Surfaces through them.
    surfaces: Arc<Mutex<Surfaces>>,
}

/// Surfaces by their map and by the number of cells averaged to one along each axis.
type Surfaces = BTreeMap<(String, usize), Arc<SplineSurface>>;

/// Use of a map in a scenario.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapUse {
    /// Elevations of the ground [m].
    Height,
    /// Elevations of the surface with the release still in place [m].
    Surface,
    /// Vertical thickness of a release [m].
    Thickness,
    /// Coulomb friction.
    Friction,
}

/// A map that a scenario names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedMap {
    /// JSON pointer of the field.
    pub pointer: String,
    /// SHA-256 of its file.
    pub name: String,
    /// Its use.
    pub of: MapUse,
}

impl Maps {
    /// Adds a map.
    pub fn insert(&mut self, name: &str, raster: Arc<Raster>) {
        self.datums.insert(name.to_owned(), raster.lowest().floor());
        self.rasters.insert(name.to_owned(), raster);
    }

    /// A map, if it is there.
    pub fn get(&self, name: &str) -> Option<&Arc<Raster>> {
        self.rasters.get(name)
    }

    /// Whole number of metres below the lowest place of a map; 0 if it is not there.
    pub(super) fn datum(&self, name: &str) -> f64 {
        self.datums.get(name).copied().unwrap_or_default()
    }

    /// Surface through a map for cells of this size [m].
    ///
    /// # Panics
    /// If the map is not there.
    pub(super) fn surface(&self, name: &str, cell_size: f64) -> Arc<SplineSurface> {
        let raster = self.get(name).expect("a scenario is read with its maps");
        let averaged = raster.cells_within(cell_size);
        let key = (name.to_owned(), averaged);
        let mut surfaces = self.surfaces.lock().unwrap_or_else(PoisonError::into_inner);
        let surface = surfaces.entry(key).or_insert_with(|| {
            let datum = self.datum(name);
            Arc::new(if averaged > 1 {
                SplineSurface::through(&raster.averaged(averaged), datum)
            } else {
                SplineSurface::through(raster, datum)
            })
        });
        Arc::clone(surface)
    }
}

impl fmt::Debug for Maps {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.debug_set().entries(self.rasters.keys()).finish()
    }
}

/// Maps with the same names have the same content.
impl PartialEq for Maps {
    fn eq(&self, other: &Self) -> bool {
        self.rasters.keys().eq(other.rasters.keys())
    }
}
