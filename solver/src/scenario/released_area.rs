//! Thickness, volume and place of a release on a terrain.

use super::polygon::{area, centroid, holds};
use super::terrain::ReleasedArea;
use crate::raster::Raster;

impl ReleasedArea<'_> {
    /// Vertical thickness at a place in local coordinates [m].
    pub(crate) fn thickness_at(&self, x: f64, y: f64) -> f64 {
        match self {
            Self::Polygon { corners, thickness } if holds(corners, x, y) => *thickness,
            Self::Polygon { .. } => 0.0,
            Self::Thickness { ground, .. } | Self::Surface { ground, .. } => {
                self.thickness_of([ground.west + x, ground.south + y])
            }
        }
    }

    /// Vertical thickness of a release by a map at a place in the map's coordinates [m]; none
    /// beyond the height map, and of a polygon.
    pub(super) fn thickness_of(&self, [east, north]: [f64; 2]) -> f64 {
        match self {
            Self::Polygon { .. } => 0.0,
            Self::Thickness { ground, .. } if ground.at_cell(east, north).is_nan() => 0.0,
            Self::Thickness { map, .. } => positive(map.at_cell(east, north)),
            Self::Surface { map, ground } => {
                above(map.at_cell(east, north), ground.at_cell(east, north))
            }
        }
    }

    /// Its map and the south-western corner of the height map; none of a polygon.
    pub(super) fn map(&self) -> Option<(&Raster, [f64; 2])> {
        match self {
            Self::Polygon { .. } => None,
            Self::Thickness { map, ground } | Self::Surface { map, ground } => {
                Some((map, [ground.west, ground.south]))
            }
        }
    }

    /// Area with any thickness [m²].
    pub(super) fn covered(&self) -> f64 {
        match self {
            Self::Polygon { corners, .. } => area(corners).abs(),
            _ => {
                let cells = self.cells().filter(|cell| cell.thickness > 0.0);
                cells.map(|cell| cell.area).sum()
            }
        }
    }

    /// A place in the middle of the release [m], if it has a place.
    pub(crate) fn middle(&self) -> Option<[f64; 2]> {
        match self {
            Self::Polygon { corners, .. } => centroid(corners),
            _ => {
                let [low, high] = self.bounds()?;
                Some([0, 1].map(|axis| 0.5 * (low[axis] + high[axis])))
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
        self.map().into_iter().flat_map(move |(map, origin)| {
            let places = (0..map.rows).flat_map(|row| (0..map.columns).map(move |of| (of, row)));
            places.map(move |(column, row)| {
                let centre = map.centre(column, row);
                ReleasedCell {
                    place: [0, 1].map(|axis| centre[axis] - origin[axis]),
                    thickness: self.thickness_of(centre),
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

    #[test]
    fn a_thickness_beyond_the_height_map_is_left_out() {
        let map = |west: f64, columns: usize| Raster {
            columns,
            rows: 1,
            cell_size: 2.0,
            west,
            south: 20.0,
            epsg: None,
            values: vec![1.0; columns],
        };
        let (ground, thickness) = (map(10.0, 2), map(8.0, 4));
        let release = ReleasedArea::Thickness {
            map: &thickness,
            ground: &ground,
        };
        assert_eq!([release.volume(), release.covered()], [8.0, 8.0]);
        assert_eq!(release.thickness_at(-1.0, 1.0), 0.0);
        assert_eq!(release.bounds(), Some([[0.0, 0.0], [4.0, 2.0]]));
        assert_eq!(release.middle(), Some([2.0, 1.0]));
    }
}
