//! Position of a body's centre, in a channel or on a terrain.

use serde::{Deserialize, Serialize};

/// Centre of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "PositionDocument", into = "PositionDocument")]
pub struct Position {
    /// Its place in the plane.
    pub place: Place,
    /// Its elevation [m]; `None`: it rests on the ground under the centre.
    pub elevation_m: Option<f64>,
}

/// Place in the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// x and y in a channel [m].
    InChannel {
        /// x of the centre of mass [m].
        downstream_m: f64,
        /// y of the centre of mass [m].
        lateral_m: f64,
    },
    /// Easting and northing on a terrain, in the terrain's coordinates [m].
    OnTerrain {
        /// Easting of the centre of mass [m].
        east_m: f64,
        /// Northing of the centre of mass [m].
        north_m: f64,
    },
}

impl Place {
    /// Both coordinates, as they are given [m].
    pub fn coordinates(&self) -> [f64; 2] {
        match *self {
            Self::InChannel {
                downstream_m,
                lateral_m,
            } => [downstream_m, lateral_m],
            Self::OnTerrain { east_m, north_m } => [east_m, north_m],
        }
    }

    /// Names of both coordinates.
    pub fn keys(&self) -> [&'static str; 2] {
        match self {
            Self::InChannel { .. } => ["downstream_m", "lateral_m"],
            Self::OnTerrain { .. } => ["east_m", "north_m"],
        }
    }
}

/// Centre of a body. In a channel it has `downstream_m` and `lateral_m`, on a terrain `east_m` and
/// `north_m`.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = Position))]
pub(super) struct PositionDocument {
    /// x of the centre of mass in a channel [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = f64))]
    downstream_m: Option<f64>,
    /// y of the centre of mass in a channel [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = f64))]
    lateral_m: Option<f64>,
    /// Easting of the centre of mass on a terrain, in its coordinates [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = f64))]
    east_m: Option<f64>,
    /// Northing of the centre of mass on a terrain, in its coordinates [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schema(value_type = f64))]
    north_m: Option<f64>,
    /// z of the centre of mass [m]; `null`: rests on the ground under the centre.
    elevation_m: Option<f64>,
}

impl TryFrom<PositionDocument> for Position {
    type Error = &'static str;

    fn try_from(document: PositionDocument) -> Result<Self, Self::Error> {
        let place = match document {
            PositionDocument {
                downstream_m: Some(downstream_m),
                lateral_m: Some(lateral_m),
                east_m: None,
                north_m: None,
                ..
            } => Place::InChannel {
                downstream_m,
                lateral_m,
            },
            PositionDocument {
                downstream_m: None,
                lateral_m: None,
                east_m: Some(east_m),
                north_m: Some(north_m),
                ..
            } => Place::OnTerrain { east_m, north_m },
            _ => return Err("a position has downstream_m and lateral_m, or east_m and north_m"),
        };
        Ok(Self {
            place,
            elevation_m: document.elevation_m,
        })
    }
}

impl From<Position> for PositionDocument {
    fn from(position: Position) -> Self {
        let mut document = Self {
            downstream_m: None,
            lateral_m: None,
            east_m: None,
            north_m: None,
            elevation_m: position.elevation_m,
        };
        match position.place {
            Place::InChannel {
                downstream_m,
                lateral_m,
            } => {
                document.downstream_m = Some(downstream_m);
                document.lateral_m = Some(lateral_m);
            }
            Place::OnTerrain { east_m, north_m } => {
                document.east_m = Some(east_m);
                document.north_m = Some(north_m);
            }
        }
        document
    }
}
