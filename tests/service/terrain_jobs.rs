//! Jobs on a terrain: from the upload of its map to the outcome.

use crate::app::{TestApp, is_running};
use reqwest::StatusCode;
use scree::terrains::TerrainHash;
use serde_json::{Value, json};

/// A slope of 12 × 10 cells of 1 m that falls by 0.4 to the east.
fn slope() -> String {
    let row: String = (0..12)
        .map(|n| format!("{:.1} ", 50.0 - 0.4 * f64::from(n)))
        .collect();
    let header = "ncols 12\nnrows 10\nxllcorner 600000\nyllcorner 200000\ncellsize 1\n";
    format!("{header}{}", format!("{row}\n").repeat(10))
}

/// A release and a cube on the map of this name.
fn scene(map: &str, duration_s: f64) -> Value {
    json!({
        "terrain": {"height_map": map, "coordinates": "local"},
        "flow": {"releases": [
            {"polygon_m": [[1.5, 3], [4, 3], [4, 7], [1.5, 7]], "thickness_m": 0.6}
        ]},
        "bodies": [{"shape": {"cube": {"side_m": 0.8}},
                    "position": {"east_m": 5.5, "north_m": 5}}],
        "duration_s": duration_s, "sample_interval_s": 0.1, "flow_snapshots": 3,
        "numerics": {"cell_size_m": 0.35}
    })
}

async fn upload(app: &TestApp) -> String {
    let answer = app.post_to("/v1/terrains", "text/plain", slope()).await;
    assert_eq!(answer.status, StatusCode::CREATED, "{:#}", answer.body);
    answer.body["hash"].as_str().unwrap().to_owned()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_on_a_terrain_has_an_outcome_and_pictures() {
    let app = TestApp::start().await;
    let map = upload(&app).await;
    let id = app.submit(&scene(&map, 1.0)).await;
    let job = app.wait_for_success(&id).await;
    let outcome = &job["outcome"];
    assert!(
        outcome["bodies"][0]["displacement_m"].as_f64().unwrap() > 0.0,
        "{outcome:#}"
    );
    assert!(outcome["flow"]["runout_m"].as_f64().unwrap() > 0.0);
    assert_eq!(outcome["conservation"]["points_lost"], 0);
    assert_eq!(job["scenario"]["terrain"]["height_map"], map.as_str());
    assert_eq!(job["scenario"].get("channel"), None);
    for file in ["motion.svg", "aerial.svg", "flow.zip"] {
        let response = app.client.get(app.url(&format!("{id}/{file}")));
        let response = response.send().await.unwrap();
        assert_eq!(response.status(), StatusCode::OK, "{file}");
    }
    // The terrain stays as long as the job does.
    let terrain = format!("/v1/terrains/{map}");
    let refused = app.delete(&terrain).await;
    assert_eq!(refused.status, StatusCode::CONFLICT, "{:#}", refused.body);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_scenario_with_a_map_that_is_not_there_is_refused_by_its_field() {
    let app = TestApp::start().await;
    let nowhere = TerrainHash::of(b"nowhere").to_string();
    let scene = scene(&nowhere, 1.0).to_string();
    for path in ["/v1/jobs", "/v1/plans"] {
        let refused = app.post_to(path, "application/json", scene.clone()).await;
        refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
        assert_eq!(refused.wrong_fields(), ["/terrain/height_map"], "{path}");
        let detail = refused.body["errors"][0]["detail"].as_str().unwrap();
        assert!(detail.contains("POST /v1/terrains"), "{detail}");
    }
    app.stop().await;
}

// Heights are no coefficients of friction, though the file is there.
#[tokio::test(flavor = "multi_thread")]
async fn a_map_with_two_uses_has_to_suit_both() {
    let app = TestApp::start().await;
    let map = upload(&app).await;
    let mut scene = scene(&map, 1.0);
    scene["terrain"]["base_friction_map"] = map.into();
    let refused = app.post("application/json", scene.to_string()).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    assert_eq!(refused.wrong_fields(), ["/terrain/base_friction_map"]);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_on_a_terrain_goes_on_after_a_restart() {
    let app = TestApp::start().await;
    let map = upload(&app).await;
    let id = app.submit(&scene(&map, 1.0)).await;
    let whole = app.wait_for_success(&id).await;
    let mut longer = scene(&map, 1.0);
    longer["title"] = "interrupted".into();
    let id = app.submit(&longer).await;
    app.wait(&id, |job| is_running(job) || job["status"] == "successful")
        .await;
    let app = TestApp::start_in(app.stop().await, |_| {}).await;
    let again = app.wait_for_success(&id).await;
    for key in ["bodies", "flow", "conservation"] {
        assert_eq!(again["outcome"][key], whole["outcome"][key], "{key}");
    }
    app.stop().await;
}
