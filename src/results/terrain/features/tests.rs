//! Features of a run that was computed.

use super::{FlowOutlines, TerrainRun};
use crate::results::terrain::{Coordinates, NoCoordinates, StoredMap};
use crate::runs::{Progress, Run, RunControl, RunEnd, Sink, run};
use geojson::{Feature, FeatureCollection, Value};
use scree_solver::raster::Raster;
use scree_solver::record::{FlowMaps, Outcome, Record, Sample};
use scree_solver::scenario::{Maps, Scenario};
use serde_json::json;
use std::convert::Infallible;
use std::sync::Arc;

/// Keeps what a run hands on.
#[derive(Default)]
struct Kept {
    samples: Vec<Sample>,
    maps: Option<FlowMaps>,
    /// State after the first steps.
    state: Option<Vec<u8>>,
    steps: u32,
}

impl Sink for Kept {
    type Error = Infallible;

    fn record(&mut self, record: Record) -> Result<(), Infallible> {
        if let Record::Sample(sample) = record {
            self.samples.push(sample);
        }
        Ok(())
    }

    fn flow_maps(&mut self, maps: &FlowMaps) -> Result<(), Infallible> {
        self.maps = Some(maps.clone());
        Ok(())
    }

    fn wants_state(&mut self) -> bool {
        self.steps += 1;
        self.steps == 10
    }

    fn state(&mut self, _: f64, state: &[u8]) -> Result<(), Infallible> {
        self.state = Some(state.to_vec());
        Ok(())
    }

    fn progress(&mut self, _: &Progress) -> Result<(), Infallible> {
        Ok(())
    }
}

/// A plane near Bern that falls to the east, with a block of flow and a ball.
fn scenario() -> Scenario {
    let mut height = Raster {
        columns: 24,
        rows: 12,
        cell_size: 1.0,
        west: 2_600_000.0,
        south: 1_200_000.0,
        epsg: Some(2056),
        values: Vec::new(),
    };
    for _ in 0..height.rows {
        let columns = 0..height.columns;
        height
            .values
            .extend(columns.map(|column| 550.5 - 0.7 * column as f64));
    }
    let name = "ab".repeat(32);
    let at = |east: f64, north: f64| [2_600_000.0 + east, 1_200_000.0 + north];
    let document = json!({
        "terrain": {"height_map": name, "base_friction": 0.3}, "duration_s": 0.8,
        "sample_interval_s": 0.05,
        "flow": {
            // Clockwise, as people may give it.
            "releases": [{"polygon_m": [at(3.0, 4.0), at(3.0, 8.0), at(7.0, 8.0), at(7.0, 4.0)],
                          "thickness_m": 1.0}],
            "material": {},
        },
        "bodies": [{"shape": {"ball": {"radius_m": 0.5}},
                    "position": {"east_m": 2_600_012.0, "north_m": 1_200_002.0}}],
        "numerics": {"cell_size_m": 1.0},
    });
    let mut maps = Maps::default();
    maps.insert(&name, Arc::new(height));
    let scenario = Scenario::from_value_with(&document, &maps);
    scenario.unwrap_or_else(|error| panic!("{error:?}"))
}

fn computed(scenario: &Scenario) -> (Kept, Outcome) {
    let mut kept = Kept::default();
    let ended = run::run(scenario, 1, &RunControl::default(), &mut kept).unwrap();
    let RunEnd::Completed(outcome) = ended else {
        panic!("nobody stops it");
    };
    (kept, *outcome)
}

fn features(coordinates: &Coordinates) -> FeatureCollection {
    let scenario = scenario();
    let (kept, outcome) = computed(&scenario);
    let maps = kept.maps.expect("there is a flow");
    let outlines = FlowOutlines::of(&maps);
    let run = TerrainRun {
        scenario: &scenario,
        samples: &kept.samples,
        outcome: &outcome,
        flow: Some(&outlines),
    };
    let features = run.features(coordinates).unwrap();
    features.expect("it is on a terrain")
}

fn of_kind<'a>(features: &'a FeatureCollection, kind: &str) -> &'a Feature {
    let mut features = features.features.iter();
    let found = features.find(|feature| feature.property("kind") == Some(&json!(kind)));
    found.unwrap_or_else(|| panic!("there is no {kind}"))
}

fn geometry(feature: &Feature) -> &Value {
    &feature.geometry.as_ref().expect("a place").value
}

#[test]
fn features_of_a_run_are_where_it_was() {
    let features = features(&Coordinates::Map(Some(2056)));
    let about = features.foreign_members.as_ref().expect("what it is");
    assert_eq!(
        about["crs"]["properties"]["name"],
        "urn:ogc:def:crs:EPSG::2056"
    );
    let Value::MultiPolygon(release) = geometry(of_kind(&features, "release")) else {
        panic!("an area");
    };
    let corners = [[3, 4], [7, 4], [7, 8], [3, 8]]
        .map(|[east, north]| vec![f64::from(2_600_000 + east), f64::from(1_200_000 + north)]);
    let ring = &release[0][0];
    assert_eq!(ring.len(), 5);
    assert!(
        corners.iter().all(|corner| ring.contains(corner)),
        "{ring:?}"
    );
    let twice: f64 = ring
        .windows(2)
        .map(|pair| (pair[1][0] - pair[0][0]) * (pair[1][1] + pair[0][1] - 2_400_000.0))
        .sum();
    assert_eq!(twice, -32.0, "anticlockwise");

    let Value::MultiPolygon(area) = geometry(of_kind(&features, "inundated_area")) else {
        panic!("an area");
    };
    let eastmost = area.iter().flatten().flatten().map(|place| place[0]);
    let eastmost = eastmost.fold(0.0, f64::max) - 2_600_000.0;
    assert!(eastmost > 7.0 && eastmost < 14.0, "{eastmost}");

    let track = of_kind(&features, "track");
    let Value::LineString(line) = geometry(track) else {
        panic!("a line");
    };
    let start = (line[0][0] - 2_600_012.0).hypot(line[0][1] - 1_200_002.0);
    assert!(start < 0.01, "{start}");
    assert!(line.last().unwrap()[0] > 2_600_012.5, "it rolls east");
    let times = track.property("times_s").unwrap().as_array().unwrap();
    assert_eq!(times.len(), line.len());
    let rest = of_kind(&features, "final_position");
    assert_eq!(geometry(rest), &Value::Point(line.last().unwrap().clone()));
    let elevation = rest.property("elevation_m").unwrap().as_f64().unwrap();
    assert!((530.0..545.0).contains(&elevation), "{elevation}");
    assert_eq!(rest.property("time_s"), times.last());
}

// The coordinates' origin of LV95 is in Bern, at 7°26'19.08" E and 46°57'3.90" N.
#[test]
fn longitudes_and_latitudes_are_those_of_the_map() {
    let globe = Coordinates::wgs_84(Some(2056)).unwrap();
    let features = features(&globe);
    assert!(features.foreign_members.is_none());
    let Value::LineString(line) = geometry(of_kind(&features, "track")) else {
        panic!("a line");
    };
    let [longitude, latitude] = [line[0][0], line[0][1]];
    assert!((longitude - 7.438_79).abs() < 2e-5, "{longitude}");
    assert!((latitude - 46.951_1).abs() < 2e-5, "{latitude}");
}

#[test]
fn a_map_without_a_reference_system_has_no_longitudes() {
    let refused = Coordinates::wgs_84(None);
    assert!(matches!(refused, Err(NoCoordinates::Unknown)));
    let refused = Coordinates::wgs_84(Some(1));
    assert!(matches!(refused, Err(NoCoordinates::Projection(_))));
}

#[test]
fn a_run_has_all_its_maps_as_files() {
    let (kept, _) = computed(&scenario());
    let maps = kept.maps.expect("there is a flow");
    for stored in StoredMap::all(&maps).unwrap() {
        let given = maps.raster(stored.quantity);
        let read = stored.raster().unwrap();
        assert_eq!(
            (read.west, read.south, read.epsg),
            (given.west, given.south, given.epsg)
        );
        let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        assert!(read.values.iter().zip(&given.values).all(same));
    }
}

#[test]
fn maps_are_the_same_after_a_restart() {
    let scenario = scenario();
    let (whole, _) = computed(&scenario);
    let state = whole.state.expect("it has ten steps");
    let mut rest = Kept::default();
    let run = Run::restored(&scenario, 1, &state).unwrap();
    run.go(&RunControl::default(), &mut rest).unwrap();
    assert!(whole.maps == rest.maps);
}
