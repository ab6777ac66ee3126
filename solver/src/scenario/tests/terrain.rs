//! Scenarios on a terrain: what is accepted, and what is refused.

use super::{HEIGHT_MAP, accepted, minimal_on_terrain, refused, set};
use crate::scenario::{MapUse, Scenario, Support};
use serde_json::{Value, json};

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
    assert_eq!(stored.with_maps(&super::maps()), scenario);
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
