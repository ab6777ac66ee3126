//! Tracks and resting places of bodies, and outlines of the flow, as GeoJSON (RFC 7946).

use super::coordinates::{Coordinates, NoCoordinates};
use super::outline::polygons;
use geojson::{Feature, FeatureCollection, Geometry, JsonObject, Value};
use scree_solver::raster::Raster;
use scree_solver::record::{FlowMaps, MapQuantity, Outcome, Sample};
use scree_solver::scenario::{Scenario, Source, Terrain, TerrainRelease};
use serde_json::json;

/// A run on a terrain.
#[derive(Debug, Clone, Copy)]
pub struct TerrainRun<'a> {
    /// Its scenario, with the maps.
    pub scenario: &'a Scenario,
    /// Samples of its bodies.
    pub samples: &'a [Sample],
    /// Its outcome.
    pub outcome: &'a Outcome,
    /// Outlines of its flow, if there was one.
    pub flow: Option<&'a FlowOutlines>,
}

/// Maps of which outlines are drawn.
#[derive(Debug)]
pub struct FlowOutlines {
    /// Arrival time [s].
    pub arrival_time: Raster,
    /// Flow height at the end [m].
    pub deposit: Raster,
}

type Polygons = Vec<Vec<Vec<[f64; 2]>>>;

impl FlowOutlines {
    /// Those of a run.
    pub fn of(maps: &FlowMaps) -> Self {
        Self {
            arrival_time: maps.raster(MapQuantity::ArrivalTime),
            deposit: maps.raster(MapQuantity::Deposit),
        }
    }

    /// Area that the flow reached.
    pub fn inundated_area(&self) -> Polygons {
        polygons(&self.arrival_time, |time| !time.is_nan())
    }

    /// Area where flow lies at the end, of what it reached.
    pub fn deposit(&self) -> Polygons {
        let mut reached = self.deposit.clone();
        let arrivals = &self.arrival_time.values;
        for (height, arrival) in reached.values.iter_mut().zip(arrivals) {
            if arrival.is_nan() {
                *height = 0.0;
            }
        }
        polygons(&reached, |height| height > 0.0)
    }
}

impl TerrainRun<'_> {
    /// The features: releases, inundated area, deposit, and each body's track and resting place.
    /// `None` in a channel.
    ///
    /// # Errors
    /// A place has no such coordinates.
    pub fn features(
        &self,
        coordinates: &Coordinates,
    ) -> Result<Option<FeatureCollection>, NoCoordinates> {
        let Some(terrain) = self.scenario.terrain() else {
            return Ok(None);
        };
        let mut features = releases(self.scenario, terrain, coordinates)?;
        if let Some(flow) = self.flow {
            let about = json!({"kind": "inundated_area"});
            features.push(area(&flow.inundated_area(), about, coordinates)?);
            let about = json!({"kind": "deposit"});
            features.push(area(&flow.deposit(), about, coordinates)?);
        }
        for body in 0..self.scenario.bodies.len() {
            features.extend(self.track(terrain, body, coordinates)?);
            features.extend(self.rest(terrain, body, coordinates)?);
        }
        Ok(Some(FeatureCollection {
            bbox: None,
            features,
            foreign_members: note(coordinates),
        }))
    }

    /// The way of a body's centre; none if it never moves.
    fn track(
        &self,
        terrain: &Terrain,
        body: usize,
        coordinates: &Coordinates,
    ) -> Result<Option<Feature>, NoCoordinates> {
        let origin = terrain.origin();
        let (mut positions, mut times, mut elevations) = (Vec::new(), Vec::new(), Vec::new());
        for sample in self.samples {
            let Some(state) = sample.bodies.get(body) else {
                continue;
            };
            let [x, y, z] = state.position_m;
            let position = coordinates.position([origin.x + x, origin.y + y])?;
            if positions.last() != Some(&position) {
                positions.push(position);
                times.push(sample.time_s);
                elevations.push(millimetres(origin.z + z));
            }
        }
        let about = json!({
            "kind": "track", "body": body, "times_s": times, "elevations_m": elevations,
        });
        let moves = positions.len() > 1;
        Ok(moves.then(|| feature(Value::LineString(positions), about)))
    }

    fn rest(
        &self,
        terrain: &Terrain,
        body: usize,
        coordinates: &Coordinates,
    ) -> Result<Option<Feature>, NoCoordinates> {
        let Some(outcome) = self.outcome.bodies.get(body) else {
            return Ok(None);
        };
        let (origin, [x, y, z]) = (terrain.origin(), outcome.final_position_m);
        let position = coordinates.position([origin.x + x, origin.y + y])?;
        let about = json!({
            "kind": "final_position",
            "body": body,
            "time_s": self.samples.last().map(|sample| sample.time_s),
            "elevation_m": millimetres(origin.z + z),
            "peak_speed_m_s": outcome.peak_speed_m_s,
            "stop_time_s": outcome.stop_time_s,
            "displacement_m": outcome.displacement_m,
            "burial_depth_m": outcome.burial_depth_m,
        });
        Ok(Some(feature(Value::Point(position), about)))
    }
}

/// The areas of the releases on the map.
pub(crate) fn released_areas(scenario: &Scenario, terrain: &Terrain) -> Vec<Polygons> {
    let releases = releases_of(scenario).iter();
    releases
        .map(|release| released_area(terrain, release))
        .collect()
}

fn releases_of(scenario: &Scenario) -> &[TerrainRelease] {
    match scenario.flow.as_ref().map(|flow| &flow.source) {
        Some(Source::Terrain { releases }) => releases,
        _ => &[],
    }
}

/// The areas of the releases.
fn releases(
    scenario: &Scenario,
    terrain: &Terrain,
    coordinates: &Coordinates,
) -> Result<Vec<Feature>, NoCoordinates> {
    let features = releases_of(scenario)
        .iter()
        .enumerate()
        .map(|(index, release)| {
            let about = json!({
                "kind": "release", "release": index, "time_s": release.time_s,
                "thickness_m": release.thickness_m,
            });
            area(&released_area(terrain, release), about, coordinates)
        });
    features.collect()
}

/// The area of a release in the map's coordinates.
fn released_area(terrain: &Terrain, release: &TerrainRelease) -> Polygons {
    if let Some(corners) = &release.polygon_m {
        let origin = terrain.origin();
        let corners = corners.iter().map(|corner| {
            let [x, y] = terrain.to_local(*corner);
            [origin.x + x, origin.y + y]
        });
        return vec![vec![anticlockwise(corners.collect())]];
    }
    let map = |name: &Option<String>| name.as_ref().and_then(|name| terrain.maps.get(name));
    if let Some(thickness) = map(&release.thickness_map) {
        return polygons(thickness, |thickness| thickness > 0.0);
    }
    let Some(surface) = map(&release.surface_map) else {
        return Vec::new();
    };
    let mut thickness = Raster::clone(surface);
    for row in 0..thickness.rows {
        for column in 0..thickness.columns {
            let [east, north] = thickness.centre(column, row);
            let place = thickness.index(column, row);
            thickness.values[place] -= terrain.height().at_cell(east, north);
        }
    }
    polygons(&thickness, |thickness| thickness > 0.0)
}

/// A closed ring of these corners, the area on its left.
fn anticlockwise(mut corners: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let next = corners.iter().cycle().skip(1);
    let pairs = corners.iter().zip(next);
    let twice: f64 = pairs.map(|(a, b)| (b[0] - a[0]) * (b[1] + a[1])).sum();
    if twice > 0.0 {
        corners.reverse();
    }
    corners.extend(corners.first().copied());
    corners
}

fn area(
    polygons: &Polygons,
    about: serde_json::Value,
    coordinates: &Coordinates,
) -> Result<Feature, NoCoordinates> {
    let ring = |ring: &Vec<[f64; 2]>| -> Result<Vec<Vec<f64>>, NoCoordinates> {
        ring.iter()
            .map(|place| coordinates.position(*place))
            .collect()
    };
    let polygon = |rings: &Vec<Vec<[f64; 2]>>| rings.iter().map(ring).collect();
    let polygons: Result<_, NoCoordinates> = polygons.iter().map(polygon).collect();
    Ok(feature(Value::MultiPolygon(polygons?), about))
}

fn feature(geometry: Value, about: serde_json::Value) -> Feature {
    Feature {
        geometry: Some(Geometry::new(geometry)),
        properties: members(about),
        ..Feature::default()
    }
}

/// Remark on coordinates that are no longitudes and latitudes.
fn note(coordinates: &Coordinates) -> Option<JsonObject> {
    let Coordinates::Map(epsg) = coordinates else {
        return None;
    };
    let note = "easting and northing in the coordinates of the height map, in metres; no longitudes \
                and latitudes";
    let crs = epsg.map(|epsg| {
        json!({"type": "name", "properties": {"name": format!("urn:ogc:def:crs:EPSG::{epsg}")}})
    });
    let mut about = json!({"coordinates": note});
    if let Some(crs) = crs {
        about["crs"] = crs;
    }
    members(about)
}

fn members(object: serde_json::Value) -> Option<JsonObject> {
    match object {
        serde_json::Value::Object(members) => Some(members),
        _ => None,
    }
}

fn millimetres(length: f64) -> f64 {
    (length * 1e3).round() / 1e3
}

#[cfg(test)]
mod tests;
