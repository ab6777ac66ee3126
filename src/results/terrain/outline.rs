//! Outlines of regions of cells: polygons along the edges of the cells, one per region, with holes.

use scree_solver::raster::Raster;
use std::collections::{BTreeMap, BTreeSet};

/// A ring of a polygon: its corners in the raster's coordinates [m], the last as the first.
type Ring = Vec<[f64; 2]>;

/// A cell, or a corner of cells, by column and row.
type Place = [i64; 2];

/// Steps along an edge: east, north, west, south.
const STEPS: [Place; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

/// The cells whose value is within, as polygons: the outer ring anticlockwise, then the holes
/// clockwise (RFC 7946). Cells that only touch at a corner are not connected.
pub fn polygons(raster: &Raster, within: impl Fn(f64) -> bool) -> Vec<Vec<Ring>> {
    let chosen = raster.values.iter().enumerate();
    let chosen = chosen.filter(|(_, value)| within(**value));
    let place = |index: usize| [index % raster.columns, index / raster.columns];
    let cells = chosen.map(|(index, _)| place(index).map(|along| along as i64));
    let mut edges = Edges::of(&regions(&cells.collect()));
    let mut polygons: BTreeMap<usize, Vec<Ring>> = BTreeMap::new();
    while let Some((region, corners)) = edges.take_ring() {
        let coordinates = corners.into_iter().map(|corner| {
            let [east, north] = corner.map(|along| along as f64 * raster.cell_size);
            [raster.west + east, raster.south + north]
        });
        // The first ring of a region begins at its westernmost corner: it is the outer one.
        polygons
            .entry(region)
            .or_default()
            .push(coordinates.collect());
    }
    polygons.into_values().collect()
}

/// Number of the connected region of each cell.
fn regions(cells: &BTreeSet<Place>) -> BTreeMap<Place, usize> {
    let mut numbers = BTreeMap::new();
    let mut count = 0;
    for first in cells {
        let mut open = vec![*first];
        while let Some(cell) = open.pop() {
            if !cells.contains(&cell) || numbers.contains_key(&cell) {
                continue;
            }
            numbers.insert(cell, count);
            open.extend(STEPS.map(|step| moved(cell, step)));
        }
        count += 1;
    }
    numbers
}

fn moved(place: Place, step: Place) -> Place {
    [place[0] + step[0], place[1] + step[1]]
}

/// Edges with their region on the left, by the corner where they begin and their direction.
struct Edges(BTreeMap<(Place, usize), usize>);

impl Edges {
    fn of(regions: &BTreeMap<Place, usize>) -> Self {
        let mut edges = BTreeMap::new();
        for (cell, region) in regions {
            // The edge that runs in a direction lies on the right of it, seen from the cell.
            for (direction, corner) in [[0, 0], [1, 0], [1, 1], [0, 1]].into_iter().enumerate() {
                let beside = moved(*cell, STEPS[(direction + 3) % 4]);
                if !regions.contains_key(&beside) {
                    edges.insert((moved(*cell, corner), direction), *region);
                }
            }
        }
        Self(edges)
    }

    /// Takes the edges of a ring; returns its region and its corners.
    fn take_ring(&mut self) -> Option<(usize, Vec<Place>)> {
        let (start, region) = self.0.pop_first()?;
        let (mut corner, mut direction) = start;
        let mut corners = vec![corner];
        loop {
            corner = moved(corner, STEPS[direction]);
            // To the left first: that stays with the cell on the left.
            let ways = [1, 0, 3].map(|turn| (corner, (direction + turn) % 4));
            let next = ways
                .into_iter()
                .find(|way| *way == start || self.0.contains_key(way));
            let Some(next) = next else {
                unreachable!("edges of cells form rings");
            };
            if next.1 != direction || next == start {
                corners.push(corner);
            }
            if next == start {
                return Some((region, corners));
            }
            self.0.remove(&next);
            direction = next.1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A raster from rows of digits, the northern one first.
    fn raster(rows: &[&str]) -> Raster {
        let digits = rows.iter().rev().flat_map(|row| row.bytes());
        Raster {
            columns: rows[0].len(),
            rows: rows.len(),
            cell_size: 2.0,
            west: 100.0,
            south: 50.0,
            epsg: None,
            values: digits.map(|digit| f64::from(digit - b'0')).collect(),
        }
    }

    /// Area within a ring, positive if it runs anticlockwise [m²].
    fn area(ring: &Ring) -> f64 {
        let pairs = ring.windows(2);
        let twice = pairs.map(|pair| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1]);
        0.5 * twice.sum::<f64>()
    }

    fn outlines(rows: &[&str]) -> Vec<Vec<Ring>> {
        polygons(&raster(rows), |value| value > 0.0)
    }

    #[test]
    fn a_rectangle_has_four_corners() {
        let ring = vec![
            [102.0, 50.0],
            [106.0, 50.0],
            [106.0, 52.0],
            [102.0, 52.0],
            [102.0, 50.0],
        ];
        assert_eq!(outlines(&["0000", "0110"]), [[ring]]);
        assert!(outlines(&["00", "00"]).is_empty());
    }

    #[test]
    fn regions_are_apart_and_keep_their_holes() {
        let found = outlines(&["1111100", "1010100", "1111110", "0000001"]);
        assert_eq!(found.len(), 2, "touching at a corner is not enough");
        for polygon in &found {
            for ring in polygon {
                assert_eq!(ring.first(), ring.last());
                assert!(ring.len() > 4);
            }
        }
        let large = found.iter().find(|polygon| polygon.len() == 3);
        let large = large.expect("one of them has two holes");
        let areas: Vec<f64> = large.iter().map(area).collect();
        assert_eq!(areas, [4.0 * 16.0, -4.0, -4.0]);
    }

    // Every cell lies in as many outer rings minus holes as its value says.
    #[test]
    fn areas_add_up_to_those_of_the_cells() {
        let mut state = 1_u64;
        for _ in 0..50 {
            let mut raster = raster(&["000000000"; 9]);
            for value in &mut raster.values {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1);
                *value = (state >> 63) as f64;
            }
            let cells: f64 = raster.values.iter().sum();
            let found = polygons(&raster, |value| value > 0.0);
            for polygon in &found {
                assert!(area(&polygon[0]) > 0.0);
                assert!(polygon[1..].iter().all(|hole| area(hole) < 0.0));
            }
            let sum: f64 = found.iter().flatten().map(area).sum();
            assert_eq!(sum, 4.0 * cells);
        }
    }
}
