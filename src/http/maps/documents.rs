//! Documents of maps.

use crate::http::archive::binary;
use serde::Serialize;
use std::borrow::Cow;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::Schema;
use utoipa::{PartialSchema, ToSchema};

/// The maps of a job's flow.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowMapList)]
pub(super) struct MapListDocument {
    /// The job.
    #[schema(format = "uuid")]
    pub job_id: String,
    /// Its maps; none before it has succeeded, and without a flow.
    pub maps: Vec<MapDocument>,
}

/// A map of a job's flow: a value for each cell of its height map, or for each square of them if
/// they are finer than the cells of the computation.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowMap)]
pub(super) struct MapDocument {
    /// Name.
    pub name: &'static str,
    /// Unit of the values.
    pub unit: &'static str,
    /// Files.
    pub links: MapLinks,
}

/// Files of a map.
#[derive(Debug, Serialize, ToSchema)]
#[schema(as = FlowMapLinks)]
pub(super) struct MapLinks {
    /// GeoTIFF.
    pub geotiff: String,
    /// ESRI ASCII grid.
    pub ascii: String,
}

/// The file of a map of the flow.
pub(super) struct MapFile;

impl PartialSchema for MapFile {
    fn schema() -> RefOr<Schema> {
        binary("A GeoTIFF or an ESRI ASCII grid.")
    }
}

impl ToSchema for MapFile {
    fn name() -> Cow<'static, str> {
        Cow::Borrowed("FlowMapFile")
    }
}
