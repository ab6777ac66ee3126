//! Rules of the releases on a terrain: they lie on the map, apart, and happen.

use super::area_rows::{Measure, Window};
use super::polygon::{area, touching};
use super::range::short;
use super::report::Report;
use super::rules::RELEASE_TIME;
use super::terrain::ReleasedArea;
use super::{Scenario, Source, Terrain, TerrainRelease};
use crate::raster::Raster;

/// Difference of the cell sizes of two maps that is rounding, over the cell size.
const SAME_SIZE: f64 = 1e-6;
/// Distance of the cells of two maps that is rounding, over the cell size.
const SAME_PLACE: f64 = 1e-3;
/// Area that two releases may have in common, over that of the smaller one.
const IN_COMMON: f64 = 1e-6;
/// Squares along the longer side of what two releases may have in common.
const SQUARES_ACROSS: f64 = 256.0;

/// Refuses releases that do not fit the terrain, or each other.
pub(super) fn releases_fit(report: &Report, scenario: &Scenario, terrain: &Terrain) {
    let releases = releases_of(scenario);
    for (index, release) in releases.iter().enumerate() {
        let pointer = pointer_to(index);
        match (
            &release.polygon_m,
            &release.thickness_map,
            &release.surface_map,
        ) {
            (Some(corners), ..) => polygon_fits(report, terrain, corners, &pointer),
            (None, Some(_), _) => thickness_fits(report, terrain, release, &pointer),
            _ => surface_fits(report, terrain, release, &pointer),
        }
    }
    if report.is_empty() && releases.len() > 1 {
        releases_are_apart(report, releases, terrain);
    }
}

/// Refuses releases after the end of the run.
pub(super) fn releases_happen(report: &Report, scenario: &Scenario) {
    let duration = scenario.duration_s;
    for (index, release) in releases_of(scenario).iter().enumerate() {
        if release.time_s > duration {
            let why = format!(
                "is {}, after the end of the run at {} s",
                short(release.time_s),
                short(duration)
            );
            let pointer = format!("{}/{}", pointer_to(index), RELEASE_TIME.key);
            let allowed = format!("0 <= x <= {}", short(duration));
            report.refuse(&pointer, &allowed, RELEASE_TIME.unit, &why);
        }
    }
}

fn releases_of(scenario: &Scenario) -> &[TerrainRelease] {
    match scenario.flow.as_ref().map(|flow| &flow.source) {
        Some(Source::Terrain { releases }) => releases,
        _ => &[],
    }
}

fn pointer_to(index: usize) -> String {
    format!("/flow/releases/{index}")
}

/// The corners of a polygon lie on the map and make an area.
fn polygon_fits(report: &Report, terrain: &Terrain, corners: &[[f64; 2]], pointer: &str) {
    let extent = terrain.extent();
    let pointer = format!("{pointer}/polygon_m");
    for (index, corner) in corners.iter().enumerate() {
        if !is_on_the_map(terrain.to_local(*corner), extent) {
            let why = format!(
                "is [{}, {}], which is not on the height map",
                short(corner[0]),
                short(corner[1])
            );
            let pointer = format!("{pointer}/{index}");
            report.refuse(&pointer, &extent_in_words(terrain), Some("m"), &why);
        }
    }
    if let Some([one, other]) = touching(corners) {
        let why = format!("has sides that cross or touch: those from corners {one} and {other}");
        let allowed = "a polygon whose sides neither cross nor touch";
        report.refuse(&pointer, allowed, None, &why);
    } else if area(corners) == 0.0 {
        let why = "has no area";
        report.refuse(&pointer, "a polygon with an area", None, why);
    }
}

/// A map of the thickness has one, and only on the height map.
fn thickness_fits(report: &Report, terrain: &Terrain, release: &TerrainRelease, pointer: &str) {
    let pointer = format!("{pointer}/thickness_map");
    let released = terrain.area(release);
    if let Some((map, origin)) = released.map()
        && let Some((thickness, local)) = beyond(map, origin, terrain.extent())
    {
        let [west, south] = corner_of(terrain);
        let why = format!(
            "has a thickness of {} m at easting {}, northing {}, which is not on the height map",
            short(thickness),
            west + local[0],
            south + local[1]
        );
        report.refuse(&pointer, &extent_in_words(terrain), Some("m"), &why);
    } else {
        has_a_thickness(report, &released, &pointer);
    }
}

/// Thickness of the first cell of a map that is not all on the height map, and its corner farthest
/// from it [m].
fn beyond(map: &Raster, origin: [f64; 2], extent: [f64; 2]) -> Option<(f64, [f64; 2])> {
    let rounding = SAME_PLACE * map.cell_size;
    let mut cells = (0..map.rows).flat_map(|row| (0..map.columns).map(move |column| (column, row)));
    cells.find_map(|(column, row)| {
        let thickness = map.value_at(column, row);
        let centre = map.centre(column, row);
        let centre = [0, 1].map(|axis| centre[axis] - origin[axis]);
        let farthest = [0, 1].map(|axis| {
            let side = (centre[axis] - 0.5 * extent[axis]).signum();
            centre[axis] + side * 0.5 * map.cell_size
        });
        let is_beyond =
            |axis: usize| farthest[axis] < -rounding || farthest[axis] > extent[axis] + rounding;
        (thickness > 0.0 && (is_beyond(0) || is_beyond(1))).then_some((thickness, farthest))
    })
}

/// A map of the surface has the cells of the height map, and is above it somewhere.
fn surface_fits(report: &Report, terrain: &Terrain, release: &TerrainRelease, pointer: &str) {
    let pointer = format!("{pointer}/surface_map");
    let released = terrain.area(release);
    let height = terrain.height();
    match released.map() {
        Some((map, _)) if !has_cells_of(map, height) => {
            let cells = |of: &Raster| {
                format!(
                    "cells of {} m from easting {}, northing {}",
                    of.cell_size, of.west, of.south
                )
            };
            let why = format!("has {}, the height map {}", cells(map), cells(height));
            let allowed = "a map whose cells are those of the height map";
            report.refuse(&pointer, allowed, Some("m"), &why);
        }
        _ => has_a_thickness(report, &released, &pointer),
    }
}

/// True if the cells of a map are those of another, as far as it reaches.
fn has_cells_of(map: &Raster, other: &Raster) -> bool {
    let size = other.cell_size;
    let is_whole = |cells: f64| (cells - cells.round()).abs() <= SAME_PLACE;
    (map.cell_size - size).abs() <= SAME_SIZE * size
        && is_whole((map.west - other.west) / size)
        && is_whole((map.south - other.south) / size)
}

fn has_a_thickness(report: &Report, released: &ReleasedArea<'_>, pointer: &str) {
    if released.thickest() <= 0.0 {
        let why = "gives no thickness anywhere: nothing would be released";
        let allowed = "a map with a thickness above 0 on the height map";
        report.refuse(pointer, allowed, None, why);
    }
}

/// A release with its bounds and its area.
struct Placed<'a> {
    area: ReleasedArea<'a>,
    bounds: [[f64; 2]; 2],
    /// Area with any thickness [m²].
    covered: f64,
}

/// Releases at the same time do not overlap.
fn releases_are_apart(report: &Report, releases: &[TerrainRelease], terrain: &Terrain) {
    let placed: Vec<_> = releases
        .iter()
        .map(|release| {
            let area = terrain.area(release);
            let (bounds, covered) = (area.bounds(), area.covered());
            bounds.map(|bounds| Placed {
                area,
                bounds,
                covered,
            })
        })
        .collect();
    for index in 0..releases.len() {
        let overlapped = (0..index).find(|&before| {
            releases[before].time_s == releases[index].time_s
                && (placed[before].as_ref().zip(placed[index].as_ref()))
                    .is_some_and(|(one, other)| overlap(one, other))
        });
        if let Some(before) = overlapped {
            let why = format!("overlaps release {before}, which starts at the same time");
            let allowed = format!("areas apart, or another {}", RELEASE_TIME.key);
            report.refuse(&pointer_to(index), &allowed, None, &why);
        }
    }
}

/// True if two releases overlap: squares of a lattice have larger shares of both than fit into
/// them.
fn overlap(one: &Placed<'_>, other: &Placed<'_>) -> bool {
    let low = [0, 1].map(|axis| one.bounds[0][axis].max(other.bounds[0][axis]));
    let high = [0, 1].map(|axis| one.bounds[1][axis].min(other.bounds[1][axis]));
    let longer = (high[0] - low[0]).max(high[1] - low[1]);
    if low[0] >= high[0] || low[1] >= high[1] {
        return false;
    }
    let spacing = longer / SQUARES_ACROSS;
    let window = Window::around([low, high], spacing);
    let mut sums: Vec<f64> = Vec::with_capacity(window.squares() as usize);
    let shares = Measure::Share;
    one.area
        .each_row(&window, shares, |_, row| sums.extend(row));
    let (mut place, mut in_common) = (0, 0.0_f64);
    other.area.each_row(&window, shares, |_, row| {
        for share in row {
            in_common += (sums[place] + share - 1.0).max(0.0);
            place += 1;
        }
    });
    in_common * spacing * spacing > IN_COMMON * one.covered.min(other.covered)
}

pub(super) fn is_on_the_map(place: [f64; 2], extent: [f64; 2]) -> bool {
    (0..2).all(|axis| place[axis] >= 0.0 && place[axis] <= extent[axis])
}

/// South-western corner of the map in the terrain's coordinates.
fn corner_of(terrain: &Terrain) -> [f64; 2] {
    terrain.to_local([0.0; 2]).map(|offset| 0.0 - offset)
}

/// Places on the map, in the terrain's coordinates.
pub(super) fn extent_in_words(terrain: &Terrain) -> String {
    let corner = corner_of(terrain);
    let extent = terrain.extent();
    let range = |axis: usize| {
        let (low, high) = (corner[axis], corner[axis] + extent[axis]);
        format!("{} to {}", short(low), short(high))
    };
    format!("easting {}, northing {}", range(0), range(1))
}
