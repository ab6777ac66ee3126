//! Inundation of a terrain: largest flow height and speed, arrival time and deposit of every cell
//! of the height map, or of every square of its cells if they are finer than the computation's.
//!
//! A look sums mass and momentum of the points above each cell. The flow is looked at whenever it
//! may have travelled half a cell since, or half of the square over which a point is spread, so that
//! none is passed unseen, and only where it is: memory and time follow the flow, not the map.

mod columns;
mod frame;
mod maps;

use crate::simulation::{Division, PreparedScene, Simulation};
use columns::Columns;
use frame::{Frame, Tiles};
pub use maps::{FlowMaps, MapQuantity};
use serde::{Deserialize, Serialize};

/// Travel of the fastest point between two looks, over the side of a cell of the maps or, if that is
/// larger, of the square over which it is spread.
const TRAVEL: f64 = 0.5;
/// Flow height from which on a cell counts as reached, in spacings of points: half a layer of them.
/// A single point that flies ahead makes less.
const REACHED: f64 = 0.5;

/// Reach of the flow of a run so far, cell by cell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Inundation {
    frame: Frame,
    /// Bulk density of the flow at rest [kg/m³].
    density: f64,
    /// Distance of the points at the start [m].
    spacing: f64,
    /// Side of the square over which a point is spread [m].
    side: f64,
    tiles: Tiles<Extremes>,
    since: SinceLook,
}

/// Extremes of the flow above a cell.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct Extremes {
    /// Largest flow height [m]; 0 where no flow ever was.
    height: f32,
    /// Largest speed while the cell was reached [m/s].
    speed: f32,
    /// Time at which it was first reached [s].
    arrival: Option<f32>,
}

/// Travel and releases since the last look.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
struct SinceLook {
    /// Time of the last step [s].
    time: f64,
    /// Speed of the fastest point then [m/s].
    fastest: f64,
    /// Bound of the travel since the last look [m].
    travel: f64,
    /// Points released until the last look.
    released: u64,
}

impl Inundation {
    /// Nothing yet of the flow of a scene; `None` in a channel and without a flow.
    pub(super) fn of(prepared: &PreparedScene) -> Option<Self> {
        let terrain = prepared.scenario.terrain()?;
        let spacing = prepared
            .division
            .as_ref()
            .and_then(Division::on_terrain)?
            .spacing();
        let side = prepared.cell_size_m();
        Some(Self {
            frame: Frame::of(terrain.height(), side),
            density: prepared.given.flow.as_ref()?.material.bulk_density,
            spacing,
            side,
            tiles: Tiles::default(),
            since: SinceLook::default(),
        })
    }

    /// Looks at the flow between two steps, if it may have travelled far enough or points were
    /// released.
    pub(super) fn look_if_due(&mut self, simulation: &Simulation) {
        let (now, fastest) = (simulation.time_s(), simulation.fastest_m_s());
        let travel = (now - self.since.time) * fastest.max(self.since.fastest);
        let seen = self.since;
        self.since = SinceLook {
            time: now,
            fastest,
            travel: seen.travel + travel,
            ..seen
        };
        // Another step like this one may be too much.
        let far = self.since.travel + travel > TRAVEL * self.frame.cell_size.max(self.side);
        if far || simulation.released_points() != seen.released {
            self.look(simulation);
        }
    }

    fn look(&mut self, simulation: &Simulation) {
        let now = simulation.time_s();
        let reached = REACHED * self.spacing;
        for (tile, columns) in Columns::of(simulation, self).tiles() {
            let cells = self.tiles.at(tile);
            for (cell, column) in cells.iter_mut().zip(columns) {
                let height = column.height_m();
                cell.height = cell.height.max(height as f32);
                if height >= reached {
                    cell.speed = cell.speed.max(column.speed_m_s() as f32);
                    cell.arrival.get_or_insert(now as f32);
                }
            }
        }
        self.since.travel = 0.0;
        self.since.released = simulation.released_points();
    }

    /// The maps of a run that ends now.
    pub(super) fn maps(&self, simulation: &Simulation) -> FlowMaps {
        let mut last = self.clone();
        last.look(simulation);
        FlowMaps::of(&last, &Columns::of(simulation, &last))
    }
}
