//! Ground of a scenario: a channel or a terrain.

use super::{Channel, Scenario, Terrain};
use serde::{Deserialize, Serialize};

/// Ground under flow and bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "GroundDocument", into = "GroundDocument")]
pub enum Ground {
    /// Incline and floor between two side walls.
    Channel(Channel),
    /// A height map.
    Terrain(Terrain),
}

/// Ground as it stands in a scenario's JSON.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub(super) struct GroundDocument {
    /// Channel; a scenario has either a channel or a terrain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = Channel))]
    channel: Option<Channel>,
    /// Terrain; a scenario has either a channel or a terrain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = Terrain))]
    terrain: Option<Terrain>,
}

impl TryFrom<GroundDocument> for Ground {
    type Error = &'static str;

    fn try_from(document: GroundDocument) -> Result<Self, Self::Error> {
        match (document.channel, document.terrain) {
            (Some(channel), None) => Ok(Self::Channel(channel)),
            (None, Some(terrain)) => Ok(Self::Terrain(terrain)),
            _ => Err("a scenario has either a channel or a terrain"),
        }
    }
}

impl From<Ground> for GroundDocument {
    fn from(ground: Ground) -> Self {
        let (channel, terrain) = match ground {
            Ground::Channel(channel) => (Some(channel), None),
            Ground::Terrain(terrain) => (None, Some(terrain)),
        };
        Self { channel, terrain }
    }
}

impl Scenario {
    /// Its channel, if it has one.
    pub fn channel(&self) -> Option<&Channel> {
        match &self.ground {
            Ground::Channel(channel) => Some(channel),
            Ground::Terrain(_) => None,
        }
    }

    /// Its terrain, if it has one.
    pub fn terrain(&self) -> Option<&Terrain> {
        match &self.ground {
            Ground::Channel(_) => None,
            Ground::Terrain(terrain) => Some(terrain),
        }
    }
}
