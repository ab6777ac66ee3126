//! The finished maps.

use super::columns::Columns;
use super::frame::{Frame, Tiles};
use super::{Extremes, Inundation};
use crate::raster::Raster;
use serde::{Deserialize, Serialize};

/// Quantity of a map of the flow. Where no flow ever was there is no value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MapQuantity {
    /// Largest flow height [m]: volume above a cell at the density of the release, over the area of
    /// the cell.
    FlowHeightMax,
    /// Largest magnitude of the depth-averaged velocity while the flow height was at least half a
    /// spacing of points [m/s]; no value where it never was.
    FlowSpeedMax,
    /// First time at which the flow height was at least half a spacing of points [s]; no value where
    /// it never was.
    ArrivalTime,
    /// Flow height at the end of the run [m]; 0 where the flow has passed.
    Deposit,
}

impl MapQuantity {
    /// All of them, in the order in which they are listed.
    pub const ALL: [Self; 4] = [
        Self::FlowHeightMax,
        Self::FlowSpeedMax,
        Self::ArrivalTime,
        Self::Deposit,
    ];

    /// Name in paths and of files.
    pub fn name(self) -> &'static str {
        match self {
            Self::FlowHeightMax => "flow_height_max",
            Self::FlowSpeedMax => "flow_speed_max",
            Self::ArrivalTime => "arrival_time",
            Self::Deposit => "deposit",
        }
    }

    /// The quantity of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|quantity| quantity.name() == name)
    }

    /// Unit of its values.
    pub fn unit(self) -> &'static str {
        match self {
            Self::FlowHeightMax | Self::Deposit => "m",
            Self::FlowSpeedMax => "m/s",
            Self::ArrivalTime => "s",
        }
    }
}

/// Maps of what the flow of a run did to a terrain, kept only where it was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FlowMaps {
    frame: Frame,
    tiles: Tiles<MappedCell>,
}

/// A cell of the maps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct MappedCell {
    extremes: Extremes,
    /// Flow height at the end [m].
    deposit: f32,
}

impl FlowMaps {
    pub(super) fn of(inundation: &Inundation, end: &Columns) -> Self {
        let cell = |tile, place, extremes: &Extremes| MappedCell {
            extremes: *extremes,
            deposit: end.height_m(tile, place) as f32,
        };
        Self {
            frame: inundation.frame,
            tiles: inundation.tiles.with(cell),
        }
    }

    /// The map of a quantity, in the height map's coordinates.
    pub fn raster(&self, quantity: MapQuantity) -> Raster {
        self.frame.raster(&self.tiles, |cell| {
            let Extremes {
                height,
                speed,
                arrival,
            } = cell.extremes;
            let value = match quantity {
                MapQuantity::FlowHeightMax => (height > 0.0).then_some(height),
                MapQuantity::FlowSpeedMax => arrival.map(|_| speed),
                MapQuantity::ArrivalTime => arrival,
                MapQuantity::Deposit => (height > 0.0).then_some(cell.deposit),
            };
            value.map(f64::from)
        })
    }
}
