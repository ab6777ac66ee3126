//! Results of a job on a terrain: maps, tracks and outlines, and its picture.

use crate::app::TestApp;
use reqwest::{Response, StatusCode};
use scree_rasters::{Purpose, read, write_geotiff};
use scree_solver::raster::Raster;
use serde_json::{Value, json};

/// A plane that falls to the east, near Bern.
fn plane() -> Raster {
    let mut raster = Raster {
        columns: 30,
        rows: 16,
        cell_size: 1.0,
        west: 2_600_000.0,
        south: 1_200_000.0,
        epsg: Some(2056),
        values: Vec::new(),
    };
    for _ in 0..raster.rows {
        let columns = 0..raster.columns;
        let heights = columns.map(|column| 550.5 - 0.75 * column as f64);
        raster.values.extend(heights);
    }
    raster
}

fn scene(height_map: &Value) -> Value {
    let at = |east: f64, north: f64| json!([2_600_000.0 + east, 1_200_000.0 + north]);
    json!({
        "title": "block on a plane",
        "terrain": {"height_map": height_map, "base_friction": 0.3}, "duration_s": 0.8,
        "sample_interval_s": 0.05, "flow_snapshots": 3,
        "flow": {
            "releases": [{"polygon_m": [at(3.0, 6.0), at(7.0, 6.0), at(7.0, 10.0), at(3.0, 10.0)],
                          "thickness_m": 1.0}],
            "material": {},
        },
        "bodies": [{"shape": {"ball": {"radius_m": 0.5}},
                    "position": {"east_m": 2_600_014.0, "north_m": 1_200_003.0}}],
        "numerics": {"cell_size_m": 1.0, "ending": "full"},
    })
}

async fn ask(app: &TestApp, path: &str) -> Response {
    let answer = app.client.get(app.url(path)).send().await.unwrap();
    assert_eq!(answer.status(), StatusCode::OK, "{path}");
    answer
}

fn kinds(features: &Value) -> Vec<&str> {
    let features = features["features"].as_array().unwrap().iter();
    let kinds = features.map(|feature| feature["properties"]["kind"].as_str().unwrap());
    kinds.collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn results_on_a_terrain_are_in_the_coordinates_of_its_map() {
    let app = TestApp::start().await;
    let file = write_geotiff(&plane()).unwrap();
    let terrain = app.post_to("/v1/terrains", "image/tiff", file).await;
    assert_eq!(terrain.status, StatusCode::CREATED, "{:#}", terrain.body);
    let job = app.submit(&scene(&terrain.body["hash"])).await;
    app.wait_for_success(&job).await;

    let list = app.get(&format!("{job}/maps")).await.body;
    let maps = list["maps"].as_array().unwrap();
    let names: Vec<_> = maps
        .iter()
        .map(|map| map["name"].as_str().unwrap())
        .collect();
    let expected = [
        "flow_height_max",
        "flow_speed_max",
        "arrival_time",
        "deposit",
    ];
    assert_eq!(names, expected);
    for map in maps {
        let geotiff = ask(&app, map["links"]["geotiff"].as_str().unwrap()).await;
        assert_eq!(geotiff.headers()["content-type"], "image/tiff");
        let raster = read(&geotiff.bytes().await.unwrap(), Purpose::Result).unwrap();
        assert_eq!(
            (raster.west, raster.south, raster.epsg),
            (2_600_000.0, 1_200_000.0, Some(2056))
        );
        let ascii = ask(&app, map["links"]["ascii"].as_str().unwrap()).await;
        let ascii = read(&ascii.bytes().await.unwrap(), Purpose::Result).unwrap();
        // Both have 32-bit floats.
        let same = |(a, b): (&f64, &f64)| *a as f32 == *b as f32 || (a.is_nan() && b.is_nan());
        assert!(raster.values.iter().zip(&ascii.values).all(same), "{map}");
        assert!(raster.at_cell(2_600_005.5, 1_200_008.5) >= 0.0);
        assert!(raster.at_cell(2_600_025.5, 1_200_014.5).is_nan());
    }

    let wanted = [
        "release",
        "inundated_area",
        "deposit",
        "track",
        "final_position",
    ];
    for (coordinates, east) in [("map", 2_600_013.99..2_600_014.01), ("wgs84", 7.438..7.44)] {
        let tracks = ask(
            &app,
            &format!("{job}/tracks.geojson?coordinates={coordinates}"),
        )
        .await;
        assert_eq!(tracks.headers()["content-type"], "application/geo+json");
        let tracks: Value = serde_json::from_slice(&tracks.bytes().await.unwrap()).unwrap();
        assert_eq!(kinds(&tracks), wanted);
        let start = &tracks["features"][3]["geometry"]["coordinates"][0][0];
        assert!(east.contains(&start.as_f64().unwrap()), "{start}");
    }
    let refused = app
        .get(&format!("{job}/tracks.geojson?coordinates=mars"))
        .await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");

    let picture = ask(&app, &format!("{job}/aerial.svg"))
        .await
        .text()
        .await
        .unwrap();
    assert!(picture.contains("<image ") && picture.contains("EPSG:2056"));
    ask(&app, &format!("{job}/motion.svg")).await;
    app.stop().await;
}
