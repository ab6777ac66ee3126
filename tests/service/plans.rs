//! Plans of runs.

use crate::app::{TestApp, tiny_scene};
use reqwest::StatusCode;
use serde_json::json;

#[tokio::test(flavor = "multi_thread")]
async fn a_plan_is_what_the_job_then_does() {
    let app = TestApp::start().await;
    let scene = tiny_scene().to_string();
    let planned = app.post_to("/v1/plans", "application/json", scene).await;
    assert_eq!(planned.status, StatusCode::OK, "{:#}", planned.body);
    let cost = &planned.body["plan"]["cost"];
    assert!(planned.body["wall_time"]["expected_s"].as_f64().unwrap() > 0.0);
    let path = app.submit(&tiny_scene()).await;
    assert_eq!(app.get(&path).await.body["plan"], planned.body["plan"]);
    let outcome = app.wait_for_success(&path).await["outcome"].clone();
    assert_eq!(outcome["plan"], planned.body["plan"]);
    assert_eq!(outcome["cost"]["points"], cost["points"]);
    assert_eq!(outcome["cost"]["substeps"], cost["substeps"]);
    assert_eq!(
        app.get("/v1/jobs").await.body["jobs"]
            .as_array()
            .unwrap()
            .len(),
        1
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn runs_behind_error_bars_are_part_of_a_plan() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["accuracy"] = json!({"error_bars": true});
    let planned = app
        .post_to("/v1/plans", "application/json", scene.to_string())
        .await
        .body;
    let path = app.submit(&scene).await;
    let outcome = app.wait_for_success(&path).await["outcome"].clone();
    let sizes = |runs: &serde_json::Value| -> Vec<f64> {
        let runs = runs.as_array().unwrap();
        let refinement_runs = runs.iter().filter(|run| run["role"] != "answer");
        refinement_runs
            .map(|run| run["cell_size_m"].as_f64().unwrap())
            .collect()
    };
    let refinement_runs = sizes(&planned["refinement_runs"]);
    assert!(!refinement_runs.is_empty());
    assert_eq!(refinement_runs, sizes(&outcome["accuracy"]["runs"]));

    scene["accuracy"] = json!({"target": 0.1, "quantity": "displacement_m"});
    scene["numerics"]["cell_size_m"] = json!(null);
    let planned = app
        .post_to("/v1/plans", "application/json", scene.to_string())
        .await
        .body;
    let time = &planned["wall_time"];
    assert!(time["expected_s"].is_null(), "{time}");
    assert!(time["low_s"].as_f64().unwrap() < time["high_s"].as_f64().unwrap());
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_planned_to_take_too_long_is_refused_with_its_numbers() {
    let app = TestApp::start_with(|config| config.limits.job_point_steps = Some(1_000)).await;
    let scene = tiny_scene().to_string();
    let mut costs = Vec::new();
    let batch = json!({"jobs": [{"scenario": tiny_scene()}]}).to_string();
    for (path, body) in [
        ("/v1/plans", scene.clone()),
        ("/v1/jobs", scene),
        ("/v1/batches", batch),
    ] {
        let refused = app.post_to(path, "application/json", body).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
        let error = &refused.body["errors"][0];
        assert_eq!(error["unit"], "point-steps");
        assert!(error["allowed"].as_str().unwrap().contains("1000"));
        costs.push(error["value"].as_u64().unwrap());
    }
    assert!(costs[0] > 1_000);
    assert_eq!(costs, [costs[0]; 3]);
    let mut alone = tiny_scene();
    alone["flow"] = json!(null);
    let refused = app.post("application/json", alone.to_string()).await;
    let bodies = refused.body["errors"][0]["value"].as_u64().unwrap();
    assert!(bodies < costs[0], "the bodies' own sub-steps count, too");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_a_scene_does_not_allow_is_refused_by_its_pointer() {
    let app = TestApp::start().await;
    let mut askew = tiny_scene();
    askew["bodies"][0]["yaw_deg"] = json!(20);
    for (key, word) in [("symmetry", "mirror"), ("approach", "sideways")] {
        let mut scene = askew.clone();
        scene["numerics"][key] = json!(word);
        for path in ["/v1/plans", "/v1/jobs"] {
            let answer = app
                .post_to(path, "application/json", scene.to_string())
                .await;
            answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
            assert_eq!(answer.wrong_fields(), [format!("/numerics/{key}")]);
        }
    }
    app.stop().await;
}
