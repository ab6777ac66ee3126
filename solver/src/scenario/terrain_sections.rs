//! Readers of a terrain and of the releases on it.

use super::node::Node;
use super::reader::{Object, Several};
use super::rules::*;
use super::{Coordinates, MapUse, Maps, NamedMap, Terrain, TerrainRelease};

/// JSON names of the coordinates.
pub(super) const COORDINATES: [(&str, Coordinates); 2] =
    [("map", Coordinates::Map), ("local", Coordinates::Local)];

/// Names of maps are so many hexadecimal digits: a SHA-256.
const DIGITS: usize = 64;
/// Allowed names of a map, in words.
pub(super) const MAP_NAME: &str = "the SHA-256 of an uploaded map, 64 hexadecimal digits";

pub(super) fn read_terrain(parent: &Object<'_>, node: &Node, maps: &Maps) -> Option<Terrain> {
    let object = parent.object(node, "terrain")?;
    let height_map = match object.required("height_map", MAP_NAME) {
        Some(_) => read_map(&object, "height_map", maps).flatten(),
        None => None,
    };
    let coordinates = object.choice("coordinates", &COORDINATES, Some(Coordinates::default()));
    let base_friction = object.number(&BASE_FRICTION);
    let base_friction_map = read_map(&object, "base_friction_map", maps);
    object.refuse_unknown();
    let terrain = Terrain {
        height_map: height_map?,
        coordinates: coordinates?,
        base_friction: base_friction?,
        base_friction_map: base_friction_map?,
        maps: maps.clone(),
    };
    if let Some(name) = &terrain.base_friction_map {
        lies_on(&object, "base_friction_map", name, &terrain);
    }
    Some(terrain)
}

/// The name of a map, or null (also if left out).
fn read_map(object: &Object<'_>, key: &'static str, maps: &Maps) -> Option<Option<String>> {
    let why = match object.member(key) {
        None | Some(Node::Null) => return Some(None),
        Some(Node::Text(name)) if !is_a_name(name) => "is not the SHA-256 of a file",
        Some(Node::Text(name)) if maps.get(name).is_none() => "is not known here: upload it first",
        Some(Node::Text(name)) => return Some(Some(name.clone())),
        Some(_) => "must be a text",
    };
    object
        .report
        .refuse(&object.pointer_to(key), MAP_NAME, None, why);
    None
}

fn is_a_name(name: &str) -> bool {
    let is_digit = |digit: u8| matches!(digit, b'0'..=b'9' | b'a'..=b'f');
    name.len() == DIGITS && name.bytes().all(is_digit)
}

/// A further map is in the reference system of the height map, and overlaps it.
fn lies_on(object: &Object<'_>, key: &str, name: &str, terrain: &Terrain) {
    let (Some(map), Some(height)) = (
        terrain.maps.get(name),
        terrain.maps.get(&terrain.height_map),
    ) else {
        return;
    };
    let pointer = object.pointer_to(key);
    if let (Some(one), Some(other)) = (map.epsg, height.epsg)
        && one != other
    {
        let why = format!("is in EPSG:{one}, but the height map in EPSG:{other}");
        let allowed = format!("a map in EPSG:{other}");
        object.report.refuse(&pointer, &allowed, None, &why);
        return;
    }
    let apart = map.east() <= height.west
        || map.west >= height.east()
        || map.north() <= height.south
        || map.south >= height.north();
    if apart {
        let extent = |of: &crate::raster::Raster| {
            let (east, north) = (of.east(), of.north());
            format!(
                "easting {} to {east}, northing {} to {north}",
                of.west, of.south
            )
        };
        let why = format!("covers {}, nothing of the height map", extent(map));
        let allowed = format!("a map that overlaps {}", extent(height));
        object.report.refuse(&pointer, &allowed, Some("m"), &why);
    }
}

/// The releases of a flow on a terrain, which may itself have been refused.
pub(super) fn read_releases(
    flow: &Object<'_>,
    terrain: Option<&Terrain>,
    maps: &Maps,
) -> Option<Vec<TerrainRelease>> {
    let allowed = format!("a list of 1 to {RELEASES} releases");
    let pointer = flow.pointer_to("releases");
    match flow.required("releases", &allowed)? {
        Node::List(items) if (1..=RELEASES).contains(&items.len()) => {
            let read = |(index, node): (usize, &Node)| {
                let object = Object::open(node, format!("{pointer}/{index}"), flow.report)?;
                read_release(&object, terrain, maps)
            };
            let releases: Vec<_> = items.iter().enumerate().map(read).collect();
            releases.into_iter().collect()
        }
        _ => {
            let why = format!("must be {allowed}");
            flow.report.refuse(&pointer, &allowed, None, &why);
            None
        }
    }
}

fn read_release(
    object: &Object<'_>,
    terrain: Option<&Terrain>,
    maps: &Maps,
) -> Option<TerrainRelease> {
    const CORNERS_OF_A_POLYGON: Several = Several::new(CORNERS, ["corner", "corners"]);
    let polygon_m = match object.member(CORNER.key) {
        None | Some(Node::Null) => Some(None),
        Some(_) => object.vectors(&CORNER, &CORNERS_OF_A_POLYGON).map(Some),
    };
    let thickness_m = object.automatic(&THICKNESS);
    let thickness_map = read_map(object, "thickness_map", maps);
    let surface_map = read_map(object, "surface_map", maps);
    let time_s = object.number(&RELEASE_TIME);
    object.refuse_unknown();
    let release = TerrainRelease {
        polygon_m: polygon_m?,
        thickness_m: thickness_m?,
        thickness_map: thickness_map?,
        surface_map: surface_map?,
        time_s: time_s?,
    };
    is_given_in_one_way(object, &release)?;
    if let Some(terrain) = terrain {
        let maps = [
            ("thickness_map", &release.thickness_map),
            ("surface_map", &release.surface_map),
        ];
        for (key, name) in maps {
            if let Some(name) = name {
                lies_on(object, key, name, terrain);
            }
        }
    }
    Some(release)
}

/// A release is a polygon with its thickness, or one map.
fn is_given_in_one_way(object: &Object<'_>, release: &TerrainRelease) -> Option<()> {
    let polygon = [release.polygon_m.is_some(), release.thickness_m.is_some()];
    let maps = [&release.thickness_map, &release.surface_map];
    let maps = maps.iter().filter(|map| map.is_some()).count();
    if (polygon == [true; 2] && maps == 0) || (polygon == [false; 2] && maps == 1) {
        return Some(());
    }
    let allowed = "polygon_m with thickness_m, or thickness_map, or surface_map";
    let why = format!("must have one of: {allowed}");
    object.report.refuse(&object.pointer, allowed, None, &why);
    None
}

/// The maps that a document names, in its order, whatever else is wrong with it.
pub(super) fn maps_named(document: &Node) -> Vec<NamedMap> {
    let mut found = Vec::new();
    let mut add = |node: &Node, at: &str, key: &str, of: MapUse| {
        if let Some(Node::Text(name)) = node.get(key) {
            found.push(NamedMap {
                pointer: format!("{at}/{key}"),
                name: name.clone(),
                of,
            });
        }
    };
    if let Some(terrain) = document.get("terrain") {
        add(terrain, "/terrain", "height_map", MapUse::Height);
        add(terrain, "/terrain", "base_friction_map", MapUse::Friction);
    }
    if let Some(Node::List(releases)) = document.get("flow").and_then(|flow| flow.get("releases")) {
        for (index, release) in releases.iter().enumerate() {
            let at = format!("/flow/releases/{index}");
            add(release, &at, "thickness_map", MapUse::Thickness);
            add(release, &at, "surface_map", MapUse::Surface);
        }
    }
    found
}
