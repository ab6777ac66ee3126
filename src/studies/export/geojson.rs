//! Resting places as GeoJSON (RFC 7946), in local coordinates [m]: x downstream and y across in a
//! channel, x east and y north of the height map's corner on a terrain. They are no longitudes and
//! latitudes, which the file says.

use geojson::{Feature, FeatureCollection, Geometry, JsonObject, Value};
use scree_studies::answers::{Atom, Polygon, Region, RestDistribution};
use serde_json::json;

/// Regions as multipolygons, atoms as points.
pub fn rest_as_geojson(rest: &RestDistribution) -> FeatureCollection {
    let regions = rest.regions.iter().map(region);
    let atoms = rest.atoms.iter().map(atom);
    let note = "local coordinates in metres: x downstream, y across in a channel; x east, y north of \
                the south-western corner of the height map on a terrain";
    FeatureCollection {
        bbox: None,
        features: regions.chain(atoms).collect(),
        foreign_members: Some(members([("coordinates", json!(note))])),
    }
}

fn region(region: &Region) -> Feature {
    let polygons = region.polygons.iter().map(rings).collect();
    feature(
        Value::MultiPolygon(polygons),
        [
            ("kind", json!("region")),
            ("probability", json!(region.probability)),
            ("area_m2", json!(region.area_m2)),
            (
                "area_standard_error_m2",
                json!(region.area_standard_error_m2),
            ),
            ("members_within", json!(region.members.estimate)),
            ("members_within_lower", json!(region.members.lower)),
            ("members_within_upper", json!(region.members.upper)),
        ],
    )
}

fn atom(atom: &Atom) -> Feature {
    feature(
        Value::Point(atom.place_m.to_vec()),
        [
            ("kind", json!("atom")),
            ("members", json!(atom.members)),
            ("share", json!(atom.share)),
        ],
    )
}

fn rings(polygon: &Polygon) -> Vec<Vec<Vec<f64>>> {
    let ring = |ring: &Vec<[f64; 2]>| ring.iter().map(|corner| corner.to_vec()).collect();
    let holes = polygon.holes_m.iter().map(ring);
    std::iter::once(ring(&polygon.outer_m))
        .chain(holes)
        .collect()
}

fn feature<const N: usize>(geometry: Value, about: [(&str, serde_json::Value); N]) -> Feature {
    Feature {
        geometry: Some(Geometry::new(geometry)),
        properties: Some(members(about)),
        ..Feature::default()
    }
}

fn members<const N: usize>(pairs: [(&str, serde_json::Value); N]) -> JsonObject {
    let pairs = pairs.into_iter();
    pairs
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}
