//! Releases on a terrain as points: columns of them on a square lattice, from the ground up to the
//! thickness there.

use super::release::Start;
use super::{Setup, resting_point};
use crate::bed::Bed;
use crate::error::SetupError;
use crate::math::Vec3;
use crate::points::Point;
use crate::rigid::Body;
use crate::scenario::{MOST_POINTS, Measure, ReleasedArea, Scenario, Window, squares_of};

/// Thickness from which on a column is made of its own, over the distance of the columns: half of
/// it but for rounding.
const THINNEST: f64 = 0.5 * (1.0 - 1e-9);

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
        let areas: Vec<_> = scenario.terrain_releases().collect();
        let is_bounded = |needed: f64| {
            if needed <= MOST_POINTS as f64 {
                return Ok(());
            }
            Err(SetupError::TooManyPoints {
                points: needed as u64,
                limit: MOST_POINTS,
                cell_size_m: cell_size,
            })
        };
        // Squares without a column cost time as well.
        let points = scenario.released_volume_m3() / spacing.powi(3);
        is_bounded(points.max(squares_of(&areas, spacing)))?;
        let mut divided = Self {
            releases: Vec::new(),
            spacing,
        };
        for (area, time) in areas.iter().zip(scenario.release_times()) {
            let first = divided.points();
            divided.releases.push(DividedRelease {
                time,
                first,
                columns: columns(area, spacing),
            });
        }
        is_bounded(divided.points() as f64)?;
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
fn columns(area: &ReleasedArea<'_>, spacing: f64) -> Vec<PointColumn> {
    let Some(bounds) = area.bounds() else {
        return Vec::new();
    };
    let window = Window::around(bounds, spacing);
    let mut gathering = Gathering::new(THINNEST * spacing);
    area.each_row(&window, Measure::Thickness, |row, thickness| {
        gathering.take_row([window.first[0], row], thickness);
    });
    let volume = area.volume();
    let heaps = gathering.finish();
    let found: f64 = heaps.made.iter().map(|heap| heap.thickness).sum();
    if found > 0.0 {
        let factor = volume / (found * spacing * spacing);
        let of = |heap: &Heap| PointColumn::of(heap, spacing, factor);
        return heaps.made.iter().map(of).collect();
    }
    let thickest = heaps.thickest.map(|heap| heap.middle(spacing));
    let place = thickest.or_else(|| area.middle());
    let single = place.filter(|_| volume > 0.0).map(|place| PointColumn {
        // The square around it may reach beyond the map.
        place: [0, 1].map(|axis| place[axis].clamp(bounds[0][axis], bounds[1][axis])),
        thickness: volume / (spacing * spacing),
        count: 1,
        volume,
    });
    single.into_iter().collect()
}

/// Thickness in a square of the lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Heap {
    /// Its column and row.
    square: [i64; 2],
    /// Thickness [m].
    thickness: f64,
}

/// Heaps of a release. What is too thin for a column is handed on to the next square of its row, up
/// to the first that makes a column with it; what is left at the end of a run of squares goes to the
/// last column of the run, or on if it has none.
#[derive(Debug, Clone, PartialEq)]
struct Gathering {
    made: Vec<Heap>,
    /// Thickness from which on a heap is made [m].
    thinnest: f64,
    /// Thickness handed on [m].
    carried: f64,
    /// True if the run of squares has a heap.
    run_has_heap: bool,
    /// Thickest square, if there is one with a thickness.
    thickest: Option<Heap>,
}

impl Gathering {
    fn new(thinnest: f64) -> Self {
        Self {
            made: Vec::new(),
            thinnest,
            carried: 0.0,
            run_has_heap: false,
            thickest: None,
        }
    }

    /// Takes the squares of a row from here on.
    fn take_row(&mut self, [first, row]: [i64; 2], thickness: &[f64]) {
        for (column, &thickness) in thickness.iter().enumerate() {
            if thickness > 0.0 {
                self.take(Heap {
                    square: [first + column as i64, row],
                    thickness,
                });
            } else {
                self.end_run();
            }
        }
        self.end_run();
    }

    fn take(&mut self, heap: Heap) {
        let is_thicker = |thickest: Heap| heap.thickness > thickest.thickness;
        if self.thickest.is_none_or(is_thicker) {
            self.thickest = Some(heap);
        }
        self.carried += heap.thickness;
        if self.carried >= self.thinnest {
            self.made.push(Heap {
                thickness: self.carried,
                ..heap
            });
            (self.carried, self.run_has_heap) = (0.0, true);
        }
    }

    fn end_run(&mut self) {
        if self.run_has_heap {
            self.give_to_last();
        }
        self.run_has_heap = false;
    }

    fn give_to_last(&mut self) {
        if let Some(last) = self.made.last_mut() {
            last.thickness += self.carried;
            self.carried = 0.0;
        }
    }

    /// The gathering with what is left given to the last heap.
    fn finish(mut self) -> Self {
        self.give_to_last();
        self
    }
}

impl Heap {
    /// Middle of its square [m].
    fn middle(&self, spacing: f64) -> [f64; 2] {
        self.square.map(|along| (along as f64 + 0.5) * spacing)
    }
}

impl PointColumn {
    /// Points of a heap, their volume by this factor.
    fn of(heap: &Heap, spacing: f64, factor: f64) -> Self {
        let count = (heap.thickness / spacing).round().max(1.0);
        Self {
            place: heap.middle(spacing),
            thickness: heap.thickness,
            count: count as u32,
            volume: heap.thickness * spacing * spacing / count * factor,
        }
    }
}

#[cfg(test)]
mod tests;
