//! Outlines of regions.

use super::grid::DensityGrid;
use contour::ContourBuilder;
use serde::{Deserialize, Serialize};

/// Corners of a closed ring [m]; the first one is repeated at the end.
type Ring = Vec<[f64; 2]>;

/// Polygon with holes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[cfg_attr(feature = "schema", schema(as = RegionPolygon))]
pub struct Polygon {
    /// Outer ring, downstream and across [m], counter-clockwise; its first corner is repeated at
    /// the end.
    pub outer_m: Vec<[f64; 2]>,
    /// Rings of the holes, likewise, clockwise.
    pub holes_m: Vec<Vec<[f64; 2]>>,
}

impl Polygon {
    /// Area without the holes [m²].
    pub fn area_m2(&self) -> f64 {
        let holes: f64 = self.holes_m.iter().map(|ring| ring_area(ring).abs()).sum();
        ring_area(&self.outer_m).abs() - holes
    }

    /// True if a place lies within and in no hole.
    pub fn contains(&self, place_m: [f64; 2]) -> bool {
        let within = |ring: &Ring| crossings(ring, place_m) % 2 == 1;
        within(&self.outer_m) && !self.holes_m.iter().any(within)
    }
}

/// Outline of the area with a density of at least a level, by marching squares with linear
/// interpolation.
pub(super) fn outline(density: &DensityGrid, level_per_m2: f64) -> Vec<Polygon> {
    let [columns, rows] = density.nodes;
    // The library has the first node half a step from its origin.
    let origin = [0, 1].map(|axis| density.origin_m[axis] - 0.5 * density.spacing_m[axis]);
    let contours = ContourBuilder::new(columns, rows, true)
        .x_origin(origin[0])
        .y_origin(origin[1])
        .x_step(density.spacing_m[0])
        .y_step(density.spacing_m[1])
        .contours(&density.density_per_m2, &[level_per_m2]);
    // It fails only if the numbers of nodes and values differ, and they don't.
    let contours = contours.unwrap_or_default();
    let geometries = contours.iter().flat_map(|contour| contour.geometry());
    let polygons = geometries.map(|polygon| Polygon {
        outer_m: ring(polygon.exterior()),
        holes_m: polygon.interiors().iter().map(ring).collect(),
    });
    polygons.collect()
}

fn ring<'a>(line: impl IntoIterator<Item = &'a contour::Pt>) -> Ring {
    line.into_iter()
        .map(|corner| [corner.x, corner.y])
        .collect()
}

/// Area of a closed ring, positive if it runs counter-clockwise [m²].
fn ring_area(ring: &[[f64; 2]]) -> f64 {
    let edges = ring.windows(2);
    let twice: f64 = edges
        .map(|edge| edge[0][0] * edge[1][1] - edge[1][0] * edge[0][1])
        .sum();
    0.5 * twice
}

/// Number of edges of a closed ring that a ray from a place downstream crosses.
fn crossings(ring: &[[f64; 2]], [x, y]: [f64; 2]) -> usize {
    let crosses = |edge: &&[[f64; 2]]| {
        let ([x0, y0], [x1, y1]) = (edge[0], edge[1]);
        (y0 > y) != (y1 > y) && x < x0 + (y - y0) / (y1 - y0) * (x1 - x0)
    };
    ring.windows(2).filter(crosses).count()
}
