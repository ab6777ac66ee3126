//! Thickness, volume and place of a release on a terrain.

use super::terrain::ReleasedArea;
use crate::raster::Raster;

impl ReleasedArea<'_> {
    /// Vertical thickness at a place in local coordinates [m].
    pub(crate) fn thickness_at(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Polygon { corners, thickness } if holds(corners, x, y) => *thickness,
            Self::Polygon { .. } => 0.0,
            Self::Thickness { map, origin } => positive(map.at_cell(origin[0] + x, origin[1] + y)),
            Self::Surface { map, ground } => {
                let (east, north) = (ground.west + x, ground.south + y);
                above(map.at_cell(east, north), ground.at_cell(east, north))
            }
        }
    }

    /// Volume [m³].
    pub(crate) fn volume(&self) -> f64 {
        match self {
            Self::Polygon { corners, thickness } => area(corners).abs() * thickness,
            _ => self.cells().map(|cell| cell.thickness * cell.area).sum(),
        }
    }

    /// Largest thickness [m].
    pub(crate) fn thickest(&self) -> f64 {
        match self {
            Self::Polygon { thickness, .. } => *thickness,
            _ => self.cells().map(|cell| cell.thickness).fold(0.0, f64::max),
        }
    }

    /// South-western and north-eastern corner of the area [m]; `None` if it has none.
    pub(crate) fn bounds(&self) -> Option<[[f64; 2]; 2]> {
        let grow = |bounds: Option<[[f64; 2]; 2]>, [x, y]: [f64; 2]| {
            let [low, high] = bounds.unwrap_or([[x, y]; 2]);
            Some([
                [low[0].min(x), low[1].min(y)],
                [high[0].max(x), high[1].max(y)],
            ])
        };
        match self {
            Self::Polygon { corners, .. } => corners.iter().copied().fold(None, grow),
            _ => {
                let cells = self.cells().filter(|cell| cell.thickness > 0.0);
                let corners = cells.flat_map(|cell| {
                    let half = 0.5 * cell.area.sqrt();
                    [-half, half].map(|side| cell.place.map(|along| along + side))
                });
                corners.fold(None, grow)
            }
        }
    }

    /// Cells of a release by a map; none of a polygon.
    fn cells(&self) -> impl Iterator<Item = ReleasedCell> {
        let (map, origin) = match self {
            Self::Polygon { .. } => (None, [0.0; 2]),
            Self::Thickness { map, origin } => (Some(*map), *origin),
            Self::Surface { map, ground } => (Some(*map), [ground.west, ground.south]),
        };
        map.into_iter().flat_map(move |map: &Raster| {
            let places = (0..map.rows).flat_map(|row| (0..map.columns).map(move |of| (of, row)));
            places.map(move |(column, row)| {
                let [east, north] = map.centre(column, row);
                let place = [east - origin[0], north - origin[1]];
                ReleasedCell {
                    place,
                    thickness: self.thickness_at(place[0], place[1]),
                    area: map.cell_size * map.cell_size,
                }
            })
        })
    }
}

/// A cell of a release by a map.
struct ReleasedCell {
    /// Its centre [m].
    place: [f64; 2],
    /// Thickness [m].
    thickness: f64,
    /// Area [m²].
    area: f64,
}

/// A thickness; no value is none.
fn positive(value: f64) -> f64 {
    if value > 0.0 { value } else { 0.0 }
}

/// Height of one surface above another [m]; no value is none.
fn above(surface: f64, ground: f64) -> f64 {
    positive(surface - ground)
}

/// Area of a polygon [m²], positive if its corners go round anticlockwise.
pub(super) fn area(corners: &[[f64; 2]]) -> f64 {
    // From the first corner on: coordinates of maps are large.
    let Some(&[x, y]) = corners.first() else {
        return 0.0;
    };
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let twice = sides.map(|(a, b)| (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y));
    0.5 * twice.sum::<f64>()
}

/// True if a polygon holds a place: an odd number of its sides lies east of it.
fn holds(corners: &[[f64; 2]], x: f64, y: f64) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = sides.filter(|(a, b)| {
        let spans = (a[1] > y) != (b[1] > y);
        spans && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

/// Two sides of a polygon that cross, by the indices of their first corners.
pub(super) fn crossing(corners: &[[f64; 2]]) -> Option<[usize; 2]> {
    let count = corners.len();
    let side = |n: usize| (corners[n], corners[(n + 1) % count]);
    let pairs = (0..count).flat_map(|a| (a + 2..count).map(move |b| (a, b)));
    pairs
        .filter(|&(a, b)| !(a == 0 && b + 1 == count))
        .find(|&(a, b)| cross(side(a), side(b)))
        .map(|(a, b)| [a, b])
}

type Side = ([f64; 2], [f64; 2]);

fn cross((a, b): Side, (c, d): Side) -> bool {
    let left = |from: [f64; 2], to: [f64; 2], of: [f64; 2]| {
        (to[0] - from[0]) * (of[1] - from[1]) - (to[1] - from[1]) * (of[0] - from[0])
    };
    let apart = |one: f64, other: f64| one * other < 0.0;
    apart(left(a, b, c), left(a, b, d)) && apart(left(c, d, a), left(c, d, b))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 2]; 4] = [[1.0, 1.0], [3.0, 1.0], [3.0, 4.0], [1.0, 4.0]];

    #[test]
    fn a_polygon_has_thickness_within_and_volume() {
        let release = ReleasedArea::Polygon {
            corners: SQUARE.to_vec(),
            thickness: 0.5,
        };
        assert_eq!(release.thickness_at(2.0, 2.0), 0.5);
        assert_eq!(release.thickness_at(0.9, 2.0), 0.0);
        assert_eq!(release.volume(), 3.0);
        assert_eq!(release.bounds(), Some([[1.0, 1.0], [3.0, 4.0]]));
        let clockwise: Vec<_> = SQUARE.into_iter().rev().collect();
        assert_eq!(area(&clockwise), -6.0);
    }

    #[test]
    fn crossing_sides_are_found() {
        assert_eq!(crossing(&SQUARE), None);
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(crossing(&bow), Some([0, 2]));
    }

    #[test]
    fn what_lies_above_the_ground_is_released() {
        let map = |values: [f64; 4]| Raster {
            columns: 2,
            rows: 2,
            cell_size: 2.0,
            west: 10.0,
            south: 20.0,
            epsg: None,
            values: values.to_vec(),
        };
        let (ground, surface) = (map([1.0; 4]), map([1.0, 2.5, 0.0, f64::NAN]));
        let release = ReleasedArea::Surface {
            map: &surface,
            ground: &ground,
        };
        assert_eq!(release.volume(), 6.0);
        assert_eq!(release.thickest(), 1.5);
        assert_eq!(release.thickness_at(3.0, 1.0), 1.5);
        assert_eq!(release.bounds(), Some([[2.0, 0.0], [4.0, 2.0]]));
    }
}
