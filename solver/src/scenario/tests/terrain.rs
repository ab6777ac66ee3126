//! Scenarios on a terrain: what is accepted, and what is refused.

use super::{HEIGHT_MAP, accepted, maps, minimal_on_terrain, refused, set};
use crate::raster::Raster;
use crate::scenario::{MapUse, Scenario, ScenarioError, Support, Violation};
use serde_json::{Value, json};
use std::sync::Arc;

fn with(pointer: &str, value: Value) -> Value {
    let mut scenario = minimal_on_terrain();
    set(&mut scenario, pointer, value);
    scenario
}

#[test]
fn the_filled_scenario_reads_back_equal() {
    let scenario = accepted(&minimal_on_terrain());
    let text = serde_json::to_value(&scenario).unwrap();
    assert_eq!(accepted(&text), scenario);
    assert_eq!(text["terrain"]["base_friction"], 0.4);
    assert_eq!(text.get("channel"), None);
    assert_eq!(text["flow"].get("volume_m3"), None);
    // Stored scenarios come back through serde, without their maps.
    let stored: Scenario = serde_json::from_value(text).unwrap();
    assert_eq!(stored.with_maps(&maps()), scenario);
}

#[test]
fn coordinates_of_the_map_are_local_ones_from_its_corner() {
    let mut scenario = with("/terrain/coordinates", json!("local"));
    let corners = json!([[4, 4], [12, 4], [12, 20]]);
    set(&mut scenario, "/flow/releases/0/polygon_m", corners);
    let position = json!({"east_m": 20, "north_m": 15});
    set(&mut scenario, "/bodies/0/position", position);
    let (map, local) = (accepted(&minimal_on_terrain()), accepted(&scenario));
    assert_eq!(map.initial_pose(0), local.initial_pose(0));
    assert_eq!(map.released_volume_m3(), 64.0);
    assert_eq!(map.duration_s, local.duration_s);
    assert_eq!(map.support_of(0), Support::Terrain);
    // The lowest cell is 92.4 m high.
    assert_eq!(map.terrain().unwrap().origin().z, 92.0);
}

#[test]
fn maps_are_named_with_their_uses() {
    let text = json!({
        "terrain": {"height_map": "a", "base_friction_map": "b"},
        "flow": {"releases": [{"polygon_m": []}, {"thickness_map": "c"}, {"surface_map": "d"}]}
    });
    let named = Scenario::maps_named(&text.to_string()).unwrap();
    let named: Vec<_> = named
        .iter()
        .map(|map| (map.pointer.as_str(), map.name.as_str(), map.of))
        .collect();
    let expected = [
        ("/terrain/height_map", "a", MapUse::Height),
        ("/terrain/base_friction_map", "b", MapUse::Friction),
        ("/flow/releases/1/thickness_map", "c", MapUse::Thickness),
        ("/flow/releases/2/surface_map", "d", MapUse::Surface),
    ];
    assert_eq!(named, expected);
}

/// (pointer set, value, pointer reported, part of the detail)
type Case = (&'static str, Value, &'static str, &'static str);

#[test]
fn what_does_not_fit_the_terrain_is_refused() {
    let polygon = "/flow/releases/0/polygon_m";
    let cases: [Case; 14] = [
        (
            "/channel",
            json!({"inclination_deg": 1}),
            "/channel",
            "has either",
        ),
        (
            "/terrain/height_map",
            json!("f".repeat(64)),
            "/terrain/height_map",
            "upload it first",
        ),
        (
            "/terrain/height_map",
            json!("alps.tif"),
            "/terrain/height_map",
            "is not the SHA-256",
        ),
        (
            "/flow/releases",
            json!([]),
            "/flow/releases",
            "a list of 1 to 64",
        ),
        (
            "/flow/volume_m3",
            json!(3),
            "/flow/volume_m3",
            "not a known field",
        ),
        (
            "/flow/releases/0",
            json!({"polygon_m": [[1, 1], [2, 1], [1, 2]]}),
            "/flow/releases/0",
            "must have one of",
        ),
        (
            "/flow/releases/0/thickness_map",
            json!(HEIGHT_MAP),
            "/flow/releases/0",
            "must have one of",
        ),
        (
            "/flow/releases/0/polygon_m/1",
            json!([45, 4]),
            "/flow/releases/0/polygon_m/1",
            "not on the height map",
        ),
        (
            polygon,
            json!([[1, 1], [5, 5], [5, 1], [1, 5]]),
            polygon,
            "corners 0 and 2",
        ),
        (polygon, json!([[1, 1], [5, 5]]), polygon, "has 2 corners"),
        (
            "/bodies/0/position/east_m",
            json!(0.5),
            "/bodies/0/position",
            "bounding radius",
        ),
        (
            "/bodies/0/position/elevation_m",
            json!(3),
            "/bodies/0/position/elevation_m",
            "into the ground",
        ),
        (
            "/bodies/0/position/downstream_m",
            json!(3),
            "/bodies/0/position/downstream_m",
            "not a known field",
        ),
        (
            "/numerics/cell_size_m",
            json!(20),
            "/numerics/cell_size_m",
            "too coarse",
        ),
    ];
    for (pointer, value, blamed, detail) in cases {
        let found = refused(&with(pointer, value.clone()));
        let blame = found.iter().find(|one| one.pointer == blamed);
        let blame = blame.unwrap_or_else(|| panic!("{pointer} {value}: {found:#?}"));
        assert!(
            blame.detail.contains(detail),
            "{pointer} {value}: {blame:?}"
        );
    }
}

#[test]
fn a_body_needs_its_place_on_a_terrain() {
    let mut scenario = minimal_on_terrain();
    scenario["bodies"][0]["position"] = json!({});
    let found = refused(&scenario);
    let pointers: Vec<_> = found.iter().map(|one| one.pointer.as_str()).collect();
    let missing = ["/bodies/0/position/east_m", "/bodies/0/position/north_m"];
    assert_eq!(pointers, missing);
}

/// Name of a further map.
const FURTHER: &str = "ff112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";

/// A square map of one value, this far from the corner of the height map [m].
fn further(columns: usize, cell_size: f64, offset: [f64; 2], value: f64) -> Raster {
    Raster {
        columns,
        rows: columns,
        cell_size,
        west: 600_000.0 + offset[0],
        south: 5_000_000.0 + offset[1],
        epsg: None,
        values: vec![value; columns * columns],
    }
}

/// Violations of a scenario whose release is by this map.
fn refused_by(key: &str, map: Raster) -> Vec<Violation> {
    let mut maps = maps();
    maps.insert(FURTHER, Arc::new(map));
    let scenario = with("/flow/releases/0", json!({key: FURTHER}));
    match Scenario::from_value_with(&scenario, &maps) {
        Ok(_) => Vec::new(),
        Err(ScenarioError::Invalid(violations)) => violations,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn a_thickness_lies_on_the_height_map() {
    assert_eq!(
        refused_by("thickness_map", further(20, 2.0, [0.0; 2], 1.0)),
        []
    );
    assert_eq!(
        refused_by("thickness_map", further(7, 1.3, [3.1, 0.7], 1.0)),
        []
    );
    let found = refused_by("thickness_map", further(4, 2.0, [-1.0, 10.0], 1.5));
    assert_eq!(found[0].pointer, "/flow/releases/0/thickness_map");
    assert_eq!(found[0].unit.as_deref(), Some("m"));
    let detail = "a thickness of 1.5 m at easting 599999, northing 5000010, which is not on";
    assert!(found[0].detail.contains(detail), "{}", found[0].detail);
    // What is beyond the edge may have no thickness.
    let mut map = further(2, 2.0, [-2.0, 10.0], 1.0);
    map.values = vec![0.0, 1.0, f64::NAN, 1.0];
    assert_eq!(refused_by("thickness_map", map), []);
}

#[test]
fn a_surface_has_the_cells_of_the_height_map() {
    assert_eq!(
        refused_by("surface_map", further(4, 2.0, [6.0, 8.0], 110.0)),
        []
    );
    for map in [
        further(4, 2.0, [7.0, 8.0], 110.0),
        further(8, 1.0, [6.0, 8.0], 110.0),
    ] {
        let cells = format!(
            "cells of {} m from easting {}, northing 5000008",
            map.cell_size, map.west
        );
        let found = refused_by("surface_map", map);
        assert_eq!(found[0].pointer, "/flow/releases/0/surface_map");
        let detail = &found[0].detail;
        assert!(detail.contains(&cells), "{detail}");
        let height = "the height map cells of 2 m from easting 600000, northing 5000000";
        assert!(detail.contains(height), "{detail}");
    }
}

/// A release within a rectangle, this far from the corner of the height map [m].
fn rectangle([west, east]: [f64; 2], [south, north]: [f64; 2], time: f64) -> Value {
    let place = |x: f64, y: f64| [600_000.0 + x, 5_000_000.0 + y];
    let corners = [
        place(west, south),
        place(east, south),
        place(east, north),
        place(west, north),
    ];
    json!({"polygon_m": corners, "thickness_m": 1, "time_s": time})
}

#[test]
fn releases_at_the_same_time_are_apart() {
    let first = rectangle([4.0, 12.3], [4.0, 12.0], 0.0);
    let apart = [
        rectangle([12.3, 18.0], [5.0, 9.0], 0.0),
        rectangle([12.3, 18.0], [12.0, 15.0], 0.0),
        rectangle([14.0, 18.0], [4.0, 12.0], 0.0),
        rectangle([4.0, 12.3], [4.0, 12.0], 0.5),
    ];
    for second in apart {
        accepted(&with("/flow/releases", json!([first, second])));
    }
    let overlapping = [
        rectangle([12.29, 18.0], [5.0, 9.0], 0.0),
        rectangle([4.0, 12.3], [4.0, 12.0], 0.0),
        rectangle([7.0, 7.5], [2.0, 20.0], 0.0),
        json!({"thickness_map": HEIGHT_MAP}),
    ];
    for second in overlapping {
        let found = refused(&with("/flow/releases", json!([first, second])));
        assert_eq!(found[0].pointer, "/flow/releases/1", "{found:#?}");
        let detail = "overlaps release 0, which starts at the same time";
        assert!(found[0].detail.contains(detail), "{}", found[0].detail);
    }
}

#[test]
fn triangles_along_a_diagonal_are_apart() {
    let half = |corner: [f64; 2]| {
        let corners = [[600_004.1, 5_000_004.3], [600_020.7, 5_000_017.9], corner];
        json!({"polygon_m": corners, "thickness_m": 1})
    };
    let (below, above) = (
        half([600_020.7, 5_000_004.3]),
        half([600_004.1, 5_000_017.9]),
    );
    accepted(&with("/flow/releases", json!([below, above])));
}

#[test]
fn a_release_happens_before_the_end() {
    let late = rectangle([4.0, 12.0], [4.0, 12.0], 2.0);
    let mut scenario = with("/flow/releases/0", late);
    assert!(accepted(&scenario).duration_s > 2.0);
    set(&mut scenario, "/duration_s", json!(2));
    accepted(&scenario);
    set(&mut scenario, "/duration_s", json!(1.5));
    let found = refused(&scenario);
    assert_eq!(found[0].pointer, "/flow/releases/0/time_s");
    assert_eq!(found[0].allowed, "0 <= x <= 1.5");
    assert_eq!(found[0].unit.as_deref(), Some("s"));
    assert!(
        found[0].detail.contains("is 2, after the end"),
        "{found:#?}"
    );
}

#[test]
fn a_closed_polygon_is_that_without_its_last_corner() {
    let mut scenario = minimal_on_terrain();
    let closed = json!([600_004, 5_000_004]);
    let open = accepted(&scenario);
    set(&mut scenario, "/flow/releases/0/polygon_m/3", closed);
    let closed = accepted(&scenario);
    assert_eq!(closed.released_volume_m3(), open.released_volume_m3());
}

#[test]
fn automatic_cells_of_a_thin_release_are_not_too_fine() {
    let mut scenario = with("/flow/releases/0/thickness_m", json!(1e-6));
    scenario["bodies"] = json!([]);
    let scenario = accepted(&scenario);
    let areas: Vec<_> = scenario.terrain_releases().collect();
    let per_cell = f64::from(scenario.numerics.points_per_cell);
    let spacing = scenario.cell_size_m() / per_cell.cbrt();
    let squares = crate::scenario::squares_of(&areas, spacing);
    assert!((1.5e7..=2e7).contains(&squares), "{squares}");
}
