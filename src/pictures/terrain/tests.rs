//! Pictures of artificial runs on terrains.

use super::{MapsSeen, terrain_view};
use crate::pictures::fixtures::resting_at;
use crate::pictures::tests::texts_of;
use crate::results::terrain::FlowOutlines;
use scree_solver::raster::Raster;
use scree_solver::record::Sample;
use scree_solver::scenario::{Maps, Scenario};
use serde_json::json;
use std::sync::Arc;

/// A valley of this many cells of 5 m.
fn valley(cells: usize) -> Raster {
    let mut raster = Raster {
        columns: cells,
        rows: cells,
        cell_size: 5.0,
        west: 2_600_000.0,
        south: 1_200_000.0,
        epsg: Some(2056),
        values: vec![0.0; cells * cells],
    };
    for row in 0..cells {
        for column in 0..cells {
            let [east, north] = raster.centre(column, row);
            let (x, y) = (east - raster.west, north - raster.south);
            let middle = 0.5 * 5.0 * cells as f64 + 40.0 * (x / 130.0).sin();
            let place = raster.index(column, row);
            let rough = 4.0 * (x / 17.0).sin() * (y / 23.0).cos();
            raster.values[place] = 1400.0 - 0.4 * x + 0.6 * (y - middle).abs() + rough;
        }
    }
    raster
}

/// The scene, and maps of a flow along the valley.
fn scene(cells: usize) -> (Scenario, MapsSeen) {
    let height = valley(cells);
    let [west, south] = [height.west, height.south];
    let side = 5.0 * cells as f64;
    let mut flow = Raster {
        values: vec![f64::NAN; cells * cells],
        ..height.clone()
    };
    let (mut arrival, mut deposit) = (flow.clone(), flow.clone());
    for row in 0..cells {
        for column in 0..cells {
            let [east, north] = flow.centre(column, row);
            let (x, y) = ((east - west) / side, (north - south) / side);
            let beside = (y - 0.5 - 40.0 / side * (x * side / 130.0).sin()).abs();
            if (0.1..0.75).contains(&x) && beside < 0.05 {
                let place = flow.index(column, row);
                flow.values[place] = 3.0 * (1.0 - beside / 0.05);
                arrival.values[place] = 30.0 * x;
                deposit.values[place] = if x > 0.6 { 1.0 } else { 0.0 };
            }
        }
    }
    let name = "ab".repeat(32);
    let corner = |x: f64, y: f64| [west + x * side, south + y * side];
    let body = |north: f64| {
        json!({
            "shape": {"cube": {"side_m": 2.0}},
            "position": {"east_m": west + 0.3 * side, "north_m": south + north * side}
        })
    };
    let document = json!({
        "title": "Rock avalanche into the valley",
        "terrain": {"height_map": name, "base_friction": 0.3}, "duration_s": 30.0,
        "flow": {
            "releases": [{
                "polygon_m": [corner(0.1, 0.45), corner(0.2, 0.44), corner(0.22, 0.6), corner(0.12, 0.6)],
                "thickness_m": 3.0
            }],
            "material": {},
        },
        "bodies": [body(0.5), body(0.55)],
        "numerics": {"cell_size_m": 5.0},
    });
    let mut maps = Maps::default();
    maps.insert(&name, Arc::new(height));
    let scenario = Scenario::from_value_with(&document, &maps);
    let seen = MapsSeen {
        flow_height_max: flow,
        outlines: FlowOutlines {
            arrival_time: arrival,
            deposit,
        },
    };
    (scenario.unwrap_or_else(|error| panic!("{error:?}")), seen)
}

/// Two bodies that go down the valley.
fn samples(cells: usize) -> Vec<Sample> {
    let side = 5.0 * cells as f64;
    let at = |time: u32| {
        let share = f64::from(time) / 60.0;
        let x = (0.3 + 0.38 * share) * side;
        let middle = 0.5 * side + 40.0 * (x / 130.0).sin();
        Sample {
            time_s: f64::from(time) / 2.0,
            bodies: vec![
                resting_at([x, middle, 1.0]),
                resting_at([x - 0.05 * side * share, middle + 30.0 * share, 1.0]),
            ],
        }
    };
    (0..=60).map(at).collect()
}

#[test]
fn a_terrain_is_shown_in_its_own_coordinates() {
    for cells in [40, 200] {
        let (scenario, maps) = scene(cells);
        let svg = terrain_view(&scenario, &samples(cells), Some(&maps)).unwrap();
        assert!(svg.len() < 300_000, "{} bytes", svg.len());
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert_eq!(svg.matches("<image ").count(), 1);
        let texts = texts_of(&svg);
        for wanted in [
            "EPSG:2056",
            "largest flow height [m]",
            "release",
            "deposit",
            "26001",
        ] {
            assert!(
                texts.iter().any(|text| text.contains(wanted)),
                "{wanted}: {texts:?}"
            );
        }
        if let Some(folder) = std::env::var_os("SHOW_PICTURES") {
            let path = std::path::Path::new(&folder).join(format!("terrain-{cells}.svg"));
            std::fs::write(path, svg).unwrap();
        }
    }
}

#[test]
fn a_terrain_without_flow_or_samples_is_shown() {
    let (scenario, _) = scene(40);
    let svg = terrain_view(&scenario, &[], None).unwrap();
    assert!(
        texts_of(&svg)
            .iter()
            .all(|text| !text.contains("flow height"))
    );
    let (scenario, mut maps) = scene(40);
    for map in [
        &mut maps.flow_height_max,
        &mut maps.outlines.arrival_time,
        &mut maps.outlines.deposit,
    ] {
        map.values.fill(f64::NAN);
    }
    terrain_view(&scenario, &samples(40), Some(&maps)).unwrap();
}
