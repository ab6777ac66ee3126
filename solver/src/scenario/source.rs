//! Source of a flow: the release of a channel, or the releases on a terrain.

use super::{Release, Scenario, TerrainRelease};
use serde::{Deserialize, Serialize};

/// Released material, by its ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "SourceDocument", into = "SourceDocument")]
pub enum Source {
    /// A volume on the incline of a channel.
    Channel {
        /// Released volume [m³]; 0 is a flow without points.
        volume_m3: f64,
        /// Position and shape of the release.
        release: Release,
    },
    /// Areas of a terrain, each with its thickness and time.
    Terrain {
        /// The releases.
        releases: Vec<TerrainRelease>,
    },
}

/// Source as it stands in a scenario's JSON.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub(super) struct SourceDocument {
    /// Released volume in a channel [m³]; 0 is a flow without points, anything else below 1e-15 is
    /// refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = f64))]
    volume_m3: Option<f64>,
    /// Position and shape of the release in a channel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = Release))]
    release: Option<Release>,
    /// Releases on a terrain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = Vec<TerrainRelease>))]
    releases: Option<Vec<TerrainRelease>>,
}

impl TryFrom<SourceDocument> for Source {
    type Error = &'static str;

    fn try_from(document: SourceDocument) -> Result<Self, Self::Error> {
        match (document.volume_m3, document.release, document.releases) {
            (Some(volume_m3), Some(release), None) => Ok(Self::Channel { volume_m3, release }),
            (None, None, Some(releases)) => Ok(Self::Terrain { releases }),
            _ => Err("a flow has volume_m3 and release, or releases"),
        }
    }
}

impl From<Source> for SourceDocument {
    fn from(source: Source) -> Self {
        match source {
            Source::Channel { volume_m3, release } => Self {
                volume_m3: Some(volume_m3),
                release: Some(release),
                releases: None,
            },
            Source::Terrain { releases } => Self {
                volume_m3: None,
                release: None,
                releases: Some(releases),
            },
        }
    }
}

impl Scenario {
    /// Released volume [m³]; 0 without a flow.
    pub fn released_volume_m3(&self) -> f64 {
        let Some(flow) = &self.flow else { return 0.0 };
        match &flow.source {
            Source::Channel { volume_m3, .. } => *volume_m3,
            Source::Terrain { .. } => self.terrain_releases().map(|one| one.volume()).sum(),
        }
    }

    /// Times of the releases on a terrain [s].
    pub(crate) fn release_times(&self) -> impl Iterator<Item = f64> {
        let releases = match self.flow.as_ref().map(|flow| &flow.source) {
            Some(Source::Terrain { releases }) => releases.as_slice(),
            _ => &[],
        };
        releases.iter().map(|release| release.time_s)
    }

    /// Thickness of the release [m]: normal to the incline of a channel, the vertical one of the
    /// thickest release on a terrain; `None` without a flow.
    pub fn release_thickness_m(&self) -> Option<f64> {
        let flow = self.flow.as_ref()?;
        Some(match &flow.source {
            Source::Channel { release, .. } => release.height_m,
            Source::Terrain { .. } => {
                let thickest = self.terrain_releases().map(|one| one.thickest());
                thickest.fold(0.0, f64::max)
            }
        })
    }
}
