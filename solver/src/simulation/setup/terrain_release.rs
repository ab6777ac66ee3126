//! Releases on a terrain as points: columns of them on a square lattice, from the ground up to the
//! thickness there.

use super::release::{MOST_POINTS, Start};
use super::{Setup, resting_point};
use crate::bed::Bed;
use crate::error::SetupError;
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::{ReleasedArea, Scenario};

/// Places along each axis at which the thickness of a column is looked up: at the edge of an area a
/// column has its share.
const LOOKED_UP: usize = 4;

/// Releases of a scenario on a terrain, divided into points.
#[derive(Debug, Clone, PartialEq)]
pub struct TerrainColumns {
    releases: Vec<DividedRelease>,
    /// Distance of the columns [m].
    spacing: f64,
}

/// A release divided into points.
#[derive(Debug, Clone, PartialEq)]
struct DividedRelease {
    /// Its time [s].
    time: f64,
    /// Identity of its first point.
    first: u64,
    columns: Vec<PointColumn>,
}

/// Points one above the other.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PointColumn {
    /// Place [m].
    place: [f64; 2],
    /// Vertical thickness of the release [m].
    thickness: f64,
    /// Points.
    count: u32,
    /// Volume of each [m³].
    volume: f64,
}

impl TerrainColumns {
    /// Division of the releases of a scenario, for cells of this size [m].
    ///
    /// # Errors
    /// Too many points for one run.
    pub(super) fn of(scenario: &Scenario, cell_size: f64) -> Result<Self, SetupError> {
        let per_cell = f64::from(scenario.numerics.points_per_cell);
        let spacing = cell_size / per_cell.cbrt();
        let needed = scenario.released_volume_m3() / spacing.powi(3);
        if needed > MOST_POINTS as f64 {
            return Err(SetupError::TooManyPoints {
                points: needed as u64,
                limit: MOST_POINTS,
                cell_size_m: cell_size,
            });
        }
        let mut divided = Self {
            releases: Vec::new(),
            spacing,
        };
        for (area, time) in scenario.terrain_releases().zip(scenario.release_times()) {
            let first = divided.points();
            divided.releases.push(DividedRelease {
                time,
                first,
                columns: columns(&area, spacing),
            });
        }
        Ok(divided)
    }

    /// Number of points, including those excluded by a body.
    pub fn points(&self) -> u64 {
        self.releases.iter().map(DividedRelease::points).sum()
    }

    /// Volume that a point has where the thickness is a whole number of spacings [m³].
    pub fn point_volume(&self) -> f64 {
        self.spacing.powi(3)
    }

    /// Number of columns of points.
    pub fn columns(&self) -> usize {
        self.releases
            .iter()
            .map(|release| release.columns.len())
            .sum()
    }

    /// Distance of the columns [m].
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// Places of the columns of each release, with the thickness there [m].
    pub fn releases(&self) -> impl Iterator<Item = impl Iterator<Item = ([f64; 2], f64)> + Clone> {
        self.releases.iter().map(|release| {
            let columns = release.columns.iter();
            columns.map(|column| (column.place, column.thickness))
        })
    }

    /// Places of all columns, with the thickness there [m].
    pub fn places(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        self.releases().flatten()
    }

    /// First release after a time [s], if there is one.
    pub(in crate::simulation) fn next_after(&self, time: f64) -> Option<f64> {
        let later = self.releases.iter().map(|release| release.time);
        later.filter(|at| *at > time).reduce(f64::min)
    }

    /// Points released at exactly this time [s] that overlap no body, and the volume excluded [m³].
    pub(in crate::simulation) fn release_at(
        &self,
        time: f64,
        given: &Setup,
        bodies: &[Body],
    ) -> (Vec<Point>, f64) {
        let due = self.releases.iter().filter(|release| release.time == time);
        let (mut points, mut left_out) = (Vec::new(), 0.0);
        for release in due {
            left_out += release.put_into(&mut points, given, bodies);
        }
        (points, left_out)
    }
}

impl DividedRelease {
    fn points(&self) -> u64 {
        self.columns
            .iter()
            .map(|column| u64::from(column.count))
            .sum()
    }

    /// Adds its points to others; returns the volume excluded by bodies [m³].
    fn put_into(&self, points: &mut Vec<Point>, given: &Setup, bodies: &[Body]) -> f64 {
        let Some(flow) = &given.flow else { return 0.0 };
        let bed = given.walls.bed.as_ref();
        let (mut id, mut left_out) = (self.first as u32, 0.0);
        points.reserve(self.points() as usize);
        for column in &self.columns {
            let [x, y] = column.place;
            let start = Start {
                material: &flow.material,
                gravity: given.gravity.norm(),
                normal: bed.normal(x, y),
            };
            let mass = flow.material.bulk_density * column.volume;
            for position in column.positions(bed) {
                id += 1;
                let Some(place) = given.place_beside(position, bodies) else {
                    left_out += column.volume;
                    continue;
                };
                let depth = bed.elevation(x, y) + column.thickness - position.z;
                let mut point = resting_point(id - 1, place, mass, column.volume);
                start.press(&mut point, depth);
                point.position += flow.way_to_bear(&point, bodies);
                points.push(point);
            }
        }
        left_out
    }
}

impl PointColumn {
    /// Positions of its points.
    fn positions(&self, bed: &dyn Bed) -> impl Iterator<Item = Vec3> {
        let [x, y] = self.place;
        let (foot, distance) = (bed.elevation(x, y), self.thickness / f64::from(self.count));
        let place = move |n: u32| Vec3::new(x, y, foot + (f64::from(n) + 0.5) * distance);
        (0..self.count).map(place)
    }
}

/// Columns of a release, all of its volume being theirs.
fn columns(area: &ReleasedArea, spacing: f64) -> Vec<PointColumn> {
    let Some([low, high]) = area.bounds() else {
        return Vec::new();
    };
    let first = low.map(|along| (along / spacing).floor() as i64);
    let last = high.map(|along| (along / spacing).ceil() as i64);
    // What is thinner than half a point is left to its neighbours, unless all of it is.
    let thinnest = 0.5 * spacing.min(area.thickest());
    let mut columns = Vec::new();
    for j in first[1]..last[1] {
        for i in first[0]..last[0] {
            let thickness = mean_thickness(area, [i, j], spacing);
            if thickness < thinnest || thickness == 0.0 {
                continue;
            }
            let count = (thickness / spacing).round().max(1.0);
            columns.push(PointColumn {
                place: [i, j].map(|along| (along as f64 + 0.5) * spacing),
                thickness,
                count: count as u32,
                volume: thickness * spacing * spacing / count,
            });
        }
    }
    let found: f64 = columns
        .iter()
        .map(|column| column.volume * f64::from(column.count))
        .sum();
    let factor = area.volume() / found;
    columns
        .iter_mut()
        .for_each(|column| column.volume *= factor);
    columns
}

/// Thickness of a release averaged over a column's cell [m].
fn mean_thickness(area: &ReleasedArea, cell: [i64; 2], spacing: f64) -> f64 {
    let places = (0..LOOKED_UP * LOOKED_UP).map(|n| {
        let inside = [n % LOOKED_UP, n / LOOKED_UP].map(|n| (n as f64 + 0.5) / LOOKED_UP as f64);
        [0, 1].map(|axis| (cell[axis] as f64 + inside[axis]) * spacing)
    });
    let thickness = places.map(|[x, y]| area.thickness_at(x, y));
    thickness.sum::<f64>() / (LOOKED_UP * LOOKED_UP) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_a_release_is_in_its_columns() {
        let area = ReleasedArea::Polygon {
            corners: vec![[0.3, 0.2], [7.1, 0.9], [6.0, 5.3], [1.0, 4.0]],
            thickness: 1.3,
        };
        for spacing in [0.5, 0.9, 3.1] {
            let columns = columns(&area, spacing);
            let sum: f64 = columns
                .iter()
                .map(|column| column.volume * f64::from(column.count))
                .sum();
            assert!(
                (sum / area.volume() - 1.0).abs() < 1e-12,
                "{spacing}: {sum}"
            );
        }
    }
}
