//! The channel: bed, side walls and back wall.

use super::poly_data::{Cells, PolyData, Section};
use scree_solver::scenario::{Channel, Scenario};

/// Height of the walls as shown over the thickness of the release; in the computation they end nowhere.
const WALL_PER_RELEASE: f64 = 1.2;

/// Kind of a surface.
#[derive(Debug, Clone, Copy)]
enum Boundary {
    Bed = 0,
    SideWall = 1,
    BackWall = 2,
}

/// The channel as poly data: rectangles, with the kind of each as `boundary`.
pub(super) fn channel(scenario: &Scenario, channel: &Channel) -> Vec<u8> {
    let half = channel.width_m / 2.0;
    let release = scenario.release();
    let wall = release.map_or(half, |release| {
        WALL_PER_RELEASE * release.vertical_thickness_m
    });
    let rise = channel.incline_length_m * channel.inclination_rad().tan();
    // Places along the channel: back, foot of the incline, open end; with z of the bed.
    let stations = [
        (-channel.incline_length_m, rise),
        (0.0, 0.0),
        (channel.runout_length_m, 0.0),
    ];
    // Round each station: the bed from right to left, then the tops of both walls.
    let round = |(x, z): (f64, f64)| {
        [(-half, z), (half, z), (-half, z + wall), (half, z + wall)].map(|(y, z)| [x, y, z])
    };
    let points = stations.map(round);
    let mut cells: Vec<([i32; 4], Boundary)> = vec![([0, 1, 3, 2], Boundary::BackWall)];
    for before in [0, 4] {
        let strip = |corners: [i32; 4]| corners.map(|corner| before + corner);
        cells.push((strip([0, 4, 5, 1]), Boundary::Bed));
        cells.push((strip([0, 2, 6, 4]), Boundary::SideWall));
        cells.push((strip([1, 5, 7, 3]), Boundary::SideWall));
    }
    let mut data = PolyData::default();
    let kinds = cells.iter().map(|(_, kind)| *kind as i32);
    data.add(Section::Cell, "boundary", 1, kinds);
    let points: Vec<_> = points.iter().flatten().collect();
    let points = points.iter().map(|point| point.map(|x| x as f32));
    let corners: Vec<_> = cells.iter().map(|(corners, _)| *corners).collect();
    data.finish(points, Cells::Polygons, &corners)
}
