use super::*;
use crate::raster::Raster;
use crate::scenario::Maps;
use serde_json::json;
use std::sync::Arc;

fn volume(columns: &[PointColumn]) -> f64 {
    let volume = |column: &PointColumn| column.volume * f64::from(column.count);
    columns.iter().map(volume).sum()
}

fn polygon(corners: &[[f64; 2]], thickness: f64) -> ReleasedArea<'static> {
    ReleasedArea::Polygon {
        corners: corners.to_vec(),
        thickness,
    }
}

fn rectangle([west, south]: [f64; 2], [east, north]: [f64; 2]) -> [[f64; 2]; 4] {
    [[west, south], [east, south], [east, north], [west, north]]
}

fn map(columns: usize, cell_size: f64, values: Vec<f64>) -> Raster {
    Raster {
        columns,
        rows: values.len() / columns,
        cell_size,
        west: 500.0,
        south: 700.0,
        epsg: None,
        values,
    }
}

#[test]
fn all_of_a_release_is_in_its_columns() {
    let area = polygon(&[[0.3, 0.2], [7.1, 0.9], [6.0, 5.3], [1.0, 4.0]], 1.3);
    for spacing in [0.5, 0.9, 3.1] {
        let columns = columns(&area, spacing);
        let sum = volume(&columns);
        assert!(
            (sum / area.volume() - 1.0).abs() < 1e-12,
            "{spacing}: {sum}"
        );
        // Squares are covered exactly: nothing is scaled but by rounding.
        let thickness: f64 = columns.iter().map(|column| column.thickness).sum();
        let sum = thickness * spacing * spacing;
        assert!((sum / area.volume() - 1.0).abs() < 1e-9, "{spacing}: {sum}");
    }
}

#[test]
fn a_release_of_whole_squares_is_divided_exactly() {
    let columns = columns(&polygon(&rectangle([25.0, 26.0], [35.0, 34.0]), 2.0), 0.5);
    assert_eq!(columns.len(), 320);
    for (n, column) in columns.iter().enumerate() {
        let place = [25.25 + 0.5 * (n % 20) as f64, 26.25 + 0.5 * (n / 20) as f64];
        let expected = PointColumn {
            place,
            thickness: 2.0,
            count: 4,
            volume: 0.125,
        };
        assert_eq!(*column, expected);
    }
}

#[test]
fn a_thin_release_does_not_heap_up_at_its_peak() {
    let mut values = vec![0.2; 1600];
    values[820] = 2.0;
    let (ground, thickness) = (map(40, 1.0, vec![0.0; 1600]), map(40, 1.0, values));
    let area = ReleasedArea::Thickness {
        map: &thickness,
        ground: &ground,
    };
    let columns = columns(&area, 1.0);
    assert!((volume(&columns) / area.volume() - 1.0).abs() < 1e-12);
    let highest = columns.iter().map(|column| column.thickness);
    let highest = highest.fold(0.0, f64::max);
    assert!((2.0..2.6).contains(&highest), "{highest}");
    // Half of the volume is where half of it lies.
    let south = columns.iter().filter(|column| column.place[1] < 20.0);
    let south: f64 = south.map(|column| column.thickness).sum();
    assert!((south - 160.0).abs() < 1e-9, "{south}");
    assert!(columns.len() as f64 <= 2.0 * area.volume());
}

#[test]
fn thin_squares_are_handed_on_along_their_row() {
    let row = [0.2, 0.2, 0.2, 0.7, 0.1, 0.0, 0.3, 0.0, 0.4, 0.2];
    let mut gathering = Gathering::new(0.5);
    gathering.take_row([10, 3], &row);
    let heaps = gathering.finish().made;
    let made: Vec<_> = heaps
        .iter()
        .map(|heap| (heap.square[0], (heap.thickness * 10.0).round()))
        .collect();
    assert_eq!(made, [(12, 6.0), (13, 8.0), (18, 9.0)]);
}

#[test]
fn a_release_smaller_than_a_point_is_one_point() {
    let square = rectangle([10.0, 10.0], [14.0, 14.0]);
    let sliver = [[10.0, 10.3], [14.0, 10.3], [14.0, 10.3001]];
    let nearly_nothing = rectangle([3.0, 3.0], [3.1, 3.0 + 1e-12]);
    for (corners, spacing) in [
        (square.as_slice(), 7.5),
        (&sliver, 0.25),
        (&nearly_nothing, 1.0),
    ] {
        let area = polygon(corners, 1.0);
        let columns = columns(&area, spacing);
        assert_eq!([columns.len() as u32, columns[0].count], [1, 1]);
        assert_eq!(columns[0].volume, area.volume());
        let [low, high] = area.bounds().unwrap();
        for axis in 0..2 {
            let range = low[axis]..=high[axis];
            assert!(range.contains(&columns[0].place[axis]), "{columns:?}");
        }
    }
}

#[test]
fn a_fine_spot_of_a_map_is_not_missed() {
    let mut values = vec![0.0; 10_000];
    values[3_456] = 3.0;
    let (ground, thickness) = (map(10, 1.0, vec![0.0; 100]), map(100, 0.1, values));
    let area = ReleasedArea::Thickness {
        map: &thickness,
        ground: &ground,
    };
    let columns = columns(&area, 1.0);
    assert_eq!(columns.len(), 1);
    assert!((volume(&columns) - 0.03).abs() < 1e-12);
    assert!((columns[0].place[0] - 5.6).abs() < 0.11, "{columns:?}");
}

#[test]
fn many_corners_cost_little() {
    let corners: Vec<_> = (0..1000)
        .map(|n| std::f64::consts::TAU * f64::from(n) / 1000.0)
        .map(|angle| [30.0 + 28.0 * angle.cos(), 30.0 + 28.0 * angle.sin()])
        .collect();
    let area = polygon(&corners, 0.05);
    let columns = columns(&area, 0.05);
    assert!((volume(&columns) / area.volume() - 1.0).abs() < 1e-9);
    assert!(columns.len() > 900_000, "{}", columns.len());
}

#[test]
fn squares_that_are_looked_at_are_limited() {
    let maps = {
        let mut maps = Maps::default();
        maps.insert(&"a".repeat(64), Arc::new(map(60, 1.0, vec![9.0; 3600])));
        maps
    };
    let document = json!({
        "terrain": {"height_map": "a".repeat(64), "coordinates": "local"},
        "flow": {"releases": [{
            "polygon_m": rectangle([1.0, 1.0], [59.0, 59.0]), "thickness_m": 1e-6
        }]},
        "bodies": [],
    });
    let scenario = Scenario::from_value_with(&document, &maps).unwrap();
    let found = TerrainColumns::of(&scenario, 0.01);
    let Err(SetupError::TooManyPoints { points, .. }) = found else {
        panic!("it is divided");
    };
    assert!(points > 130_000_000, "{points}");
    let coarse = TerrainColumns::of(&scenario, 0.5).unwrap();
    let most = 2.0 * scenario.released_volume_m3() / coarse.point_volume() + 1.0;
    assert!((1.0..=most).contains(&(coarse.points() as f64)));
}
