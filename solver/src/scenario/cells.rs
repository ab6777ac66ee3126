//! Cell size of a scenario: given, or chosen by its bodies and its release (docs/method.md,
//! equation 30).

use super::area_rows::{MOST_POINTS, squares_of};
use super::{Ground, Scenario};
use crate::method::METHOD;

/// Cell size of a scene without flow or bodies [m].
const CELL_SIZE_OF_NOTHING: f64 = 0.01;

impl Scenario {
    /// Cell size asked for [m]: that of the numerics or the automatic one.
    pub fn cell_size_m(&self) -> f64 {
        (self.numerics.cell_size_m).unwrap_or_else(|| automatic_cell_size(self))
    }
}

/// Four cells across the thinnest body, eight across the release, the finer of both; coarser if
/// that needs more than 400,000 points, of a release on a terrain that is thinner than a point up
/// to twice as many.
fn automatic_cell_size(scenario: &Scenario) -> f64 {
    let thinnest = (0..scenario.bodies.len())
        .map(|body| scenario.shape_of(body).least_width())
        .fold(f64::INFINITY, f64::min);
    let volume = scenario.released_volume_m3();
    let release = scenario.release_thickness_m().filter(|_| volume > 0.0);
    let release = release.unwrap_or(f64::INFINITY);
    let fine = (thinnest / METHOD.resolution.cells_per_body)
        .min(release / METHOD.resolution.cells_per_release);
    if fine.is_infinite() {
        return CELL_SIZE_OF_NOTHING;
    }
    let per_cell = f64::from(scenario.numerics.points_per_cell);
    let affordable = (volume * per_cell / METHOD.resolution.automatic_points).cbrt();
    let cell = fine.max(affordable);
    match &scenario.ground {
        Ground::Channel(channel) => cell.min(channel.width_m),
        Ground::Terrain(_) => not_too_fine_for_releases(scenario, cell, per_cell),
    }
}

/// A cell size of which the releases on a terrain, however thin, have no more squares to look at
/// than one run may.
fn not_too_fine_for_releases(scenario: &Scenario, mut cell: f64, per_cell: f64) -> f64 {
    let areas: Vec<_> = scenario.terrain_releases().collect();
    loop {
        let over = squares_of(&areas, cell / per_cell.cbrt()) / MOST_POINTS as f64;
        if over <= 1.0 {
            return cell;
        }
        cell *= over.sqrt().max(1.01);
    }
}
