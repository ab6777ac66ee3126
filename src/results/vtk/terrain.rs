//! The terrain: its surface at the centres of the height map's cells.

use super::poly_data::{Cells, PolyData};
use scree_solver::scenario::Terrain;

/// Most places of the surface along each axis: a viewer takes it whole at every instant.
const MOST_PLACES: usize = 500;

/// The surface of a terrain as poly data, in local coordinates.
pub(super) fn terrain(terrain: &Terrain) -> Vec<u8> {
    let (height, origin) = (terrain.height(), terrain.origin());
    let stride = height.columns.max(height.rows).div_ceil(MOST_PLACES);
    let along = |count: usize| (0..count).step_by(stride);
    let width = along(height.columns).len() as i32;
    let points = along(height.rows).flat_map(|row| {
        along(height.columns).map(move |column| {
            let [x, y] = height.centre(column, row);
            let z = height.value_at(column, row);
            [x - origin.x, y - origin.y, z - origin.z].map(|along| along as f32)
        })
    });
    let points: Vec<[f32; 3]> = points.collect();
    let rows = points.len() as i32 / width;
    let cells = (1..rows).flat_map(|j| {
        (1..width).map(move |i| {
            let [before, after] = [j - 1, j].map(|row| row * width + i);
            [before - 1, before, after, after - 1]
        })
    });
    let cells: Vec<[i32; 4]> = cells.collect();
    PolyData::default().finish(points.into_iter(), Cells::Polygons, &cells)
}
