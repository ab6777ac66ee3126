//! Documents of terrains.

use crate::http::archive::binary;
use crate::http::documents::rfc3339;
use crate::terrains::{Description, Terrain};
use serde::Serialize;
use std::borrow::Cow;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::Schema;
use utoipa::{PartialSchema, ToSchema};

/// A terrain.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = StoredTerrain)]
pub(super) struct TerrainDocument {
    /// SHA-256 of the file, 64 hexadecimal digits in lower case: the name of the terrain.
    #[schema(min_length = 64, max_length = 64)]
    pub hash: String,
    /// Length of the file [bytes].
    pub bytes: u64,
    /// Time at which the file first came (RFC 3339).
    #[schema(format = "date-time")]
    pub created: String,
    /// Name of the access token with which it first came; null if none is required.
    #[schema(required = true)]
    pub submitter: Option<String>,
    #[serde(flatten)]
    pub description: Description,
}

/// A page of terrains, newest first.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = TerrainPage)]
pub(super) struct TerrainPageDocument {
    /// The terrains of this page.
    pub terrains: Vec<TerrainDocument>,
    /// Value of `cursor` for the next page; null on the last page.
    #[schema(required = true)]
    pub next_cursor: Option<String>,
}

/// The file of a terrain.
pub(super) struct RasterFile;

impl PartialSchema for RasterFile {
    fn schema() -> RefOr<Schema> {
        binary("A GeoTIFF or an ESRI ASCII grid.")
    }
}

impl ToSchema for RasterFile {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("RasterFile")
    }
}

impl From<Terrain> for TerrainDocument {
    fn from(terrain: Terrain) -> Self {
        let Terrain {
            stored,
            description,
        } = terrain;
        Self {
            hash: stored.hash.to_string(),
            bytes: stored.bytes,
            created: rfc3339(stored.created),
            submitter: stored.submitter,
            description,
        }
    }
}
