//! Scenarios that are refused.

use crate::app::{TestApp, tiny_scene};
use reqwest::StatusCode;
use serde_json::{Value, json};

#[tokio::test(flavor = "multi_thread")]
async fn what_is_no_json_is_malformed() {
    let app = TestApp::start().await;
    for body in [
        &b""[..],
        b"{",
        b"{\"channel\": }",
        b"no",
        b"{} {}",
        b"\xff\xfe",
    ] {
        let answer = app.post("application/json", body).await;
        answer.assert_problem(StatusCode::BAD_REQUEST, "malformed-json");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn every_broken_rule_is_named_by_its_pointer() {
    let app = TestApp::start().await;
    for (pointer, value) in [
        ("/channel/inclination_deg", json!(90)),
        ("/channel/width_m", json!(-0.1)),
        ("/channel/base_friction", json!("rough")),
        ("/flow/volume_m3", json!(5.0)),
        ("/flow/material/poissons_ratio", json!(0.5)),
        ("/bodies/0/density_kg_m3", json!(0)),
        ("/bodies/0/restitution", json!(1.5)),
        ("/bodies/0/velocity_m_s", json!([0, 0])),
        ("/bodies/0/position/lateral_m", json!(0.045)),
        ("/duration_s", json!(-1)),
        ("/sample_interval_s", json!(0)),
        ("/numerics/points_per_cell", json!(0)),
        ("/numerics/courant", json!(2)),
        ("/numerics/precision", json!("half")),
        ("/numerics/solver", json!("fast")),
        ("/colour", json!("red")),
    ] {
        let answer = app
            .post(
                "application/json",
                broken(pointer, value.clone()).to_string(),
            )
            .await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
        assert!(
            answer.wrong_fields().contains(&pointer),
            "{pointer}: {:#}",
            answer.body
        );
        for error in answer.body["errors"].as_array().unwrap() {
            let keys: Vec<&String> = error.as_object().unwrap().keys().collect();
            assert_eq!(
                keys,
                ["allowed", "detail", "pointer", "unit", "value"],
                "{pointer}"
            );
        }
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn all_broken_rules_are_named_at_once() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["channel"]
        .as_object_mut()
        .unwrap()
        .remove("runout_length_m");
    scene["bodies"][0]["friction"] = json!(-1);
    scene["duration_s"] = json!("long");
    let answer = app.post("application/json", scene.to_string()).await;
    answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    // In the order of the document; this client sorts its keys.
    assert_eq!(
        answer.wrong_fields(),
        [
            "/bodies/0/friction",
            "/channel/runout_length_m",
            "/duration_s"
        ]
    );
    assert_eq!(answer.body["errors"][0]["value"], -1);
    assert_eq!(
        app.get("/v1/jobs").await.body["jobs"],
        json!([]),
        "nothing was let in"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_body_must_be_json_and_not_too_large() {
    let app = TestApp::start_with(|config| config.limits.request_body_bytes = 20_000).await;
    for content_type in ["text/plain", "application/x-www-form-urlencoded", ""] {
        let answer = app.post(content_type, tiny_scene().to_string()).await;
        answer.assert_problem(StatusCode::UNSUPPORTED_MEDIA_TYPE, "unsupported-media-type");
    }
    let mut scene = tiny_scene();
    scene["title"] = json!("x".repeat(20_000));
    let answer = app.post("application/json", scene.to_string()).await;
    answer.assert_problem(StatusCode::PAYLOAD_TOO_LARGE, "too-large");
    app.stop().await;
}

/// The tiny scene with one value replaced at a pointer.
fn broken(pointer: &str, value: Value) -> Value {
    let mut scene = tiny_scene();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let mut place = &mut scene;
    for part in parent.split('/').skip(1) {
        place = match part.parse::<usize>() {
            Ok(index) => &mut place[index],
            Err(_) => &mut place[part],
        };
    }
    place[key] = value;
    scene
}

#[tokio::test(flavor = "multi_thread")]
async fn an_answer_does_not_grow_far_beyond_its_request() {
    let app = TestApp::start().await;
    let labels = vec![""; 300_000];
    let nothing = vec![serde_json::json!({"scenario": 1, "labels": ["?"]}); 30_000];
    for batch in [
        serde_json::json!({"jobs": [{"scenario": 1, "labels": labels}]}),
        serde_json::json!({"jobs": [{"scenario": 1}], "labels": labels}),
        serde_json::json!({"jobs": nothing}),
    ] {
        let json = "application/json";
        let answer = app.post_to("/v1/batches", json, batch.to_string()).await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
        let bytes = answer.body.to_string().len();
        assert!(bytes < 200_000, "{bytes}");
    }
    let answer = app.get(&format!("/v1/jobs?{}", "a&".repeat(30_000))).await;
    answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    assert!(answer.body.to_string().len() < 1_000, "{}", answer.body);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_long_list_of_violations_says_how_many_it_leaves_out() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    for number in 0..600 {
        scene[format!("unknown{number}")] = json!(0);
    }
    let answer = app.post("application/json", scene.to_string()).await;
    answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    let errors = answer.body["errors"].as_array().unwrap();
    let last = errors.last().unwrap()["detail"].as_str().unwrap();
    assert_eq!(errors.len(), 501);
    assert!(last.contains("100 further violations"), "{last}");
    app.stop().await;
}
