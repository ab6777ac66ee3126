//! Studies on several levels of cell size.

use crate::app::TestApp;
use crate::studies::{change, post, study, submit, wait_for_end};
use reqwest::StatusCode;
use serde_json::{Value, json};

/// A study on two levels.
fn on_two_levels() -> Value {
    let mut study = study(16);
    study["finer_levels"] = json!([{"cell_size_m": 0.0125, "members": 8}]);
    study["questions"] = json!([{"mean": {"quantity": "runout_m"}}]);
    study
}

async fn members_on(app: &TestApp, path: &str, level: u32) -> Vec<Value> {
    let answer = app.get(&format!("{path}/members?level={level}")).await;
    assert_eq!(answer.status, StatusCode::OK, "{:#}", answer.body);
    answer.body["members"].as_array().unwrap().clone()
}

/// Runout of the job of a member.
async fn runout(app: &TestApp, member: &Value) -> f64 {
    let job = format!("/v1/jobs/{}", member["job"].as_str().unwrap());
    let outcome = app.get(&job).await.body["outcome"].clone();
    outcome["flow"]["runout_m"].as_f64().unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn the_first_members_are_computed_with_finer_cells_too() {
    let app = TestApp::start().await;
    let path = submit(&app, &on_two_levels()).await;
    let ended = wait_for_end(&app, &path).await;
    assert_eq!([&ended["members"], &ended["members_ended"]], [24, 24]);
    let (coarse, fine) = (
        members_on(&app, &path, 0).await,
        members_on(&app, &path, 1).await,
    );
    assert_eq!((coarse.len(), fine.len()), (16, 8));
    let (mut differences, mut all) = (0.0, 0.0);
    for (coarse, fine) in coarse.iter().zip(&fine) {
        assert_eq!(
            (&fine["level"], &fine["values"]),
            (&json!(1), &coarse["values"])
        );
        let job = format!("/v1/jobs/{}", fine["job"].as_str().unwrap());
        let scenario = app.get(&job).await.body["scenario"].clone();
        assert_eq!(scenario["numerics"]["cell_size_m"], 0.0125);
        differences += runout(&app, fine).await - runout(&app, coarse).await;
    }
    for member in &coarse {
        all += runout(&app, member).await;
    }
    let answers = app.get(&format!("{path}/answers")).await.body;
    assert_eq!(answers["levels"][1]["finished"], 8, "{answers:#}");
    let mean = &answers["answers"][0]["mean"];
    let estimate = mean["estimate"].as_f64().unwrap();
    // The regression's slope is near 1, and the first eight members are balanced.
    let telescoping = all / 16.0 + differences / 8.0;
    assert!(
        (estimate / telescoping - 1.0).abs() < 0.01,
        "{estimate} {telescoping}"
    );
    assert!(mean["numerical_error"].as_f64().unwrap() > 0.0, "{mean:#}");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn levels_and_members_are_added_for_an_accuracy() {
    let app = TestApp::start().await;
    let mut asked = study(16);
    asked["accuracy"] = json!({"quantity": "runout_m", "target": 0.5, "budget_point_steps": 1e9});
    let planned = app
        .post_to("/v1/study-plans", "application/json", asked.to_string())
        .await;
    let forecast = &planned.body["cost"]["accuracy"];
    assert_eq!(
        forecast["levels"].as_array().unwrap().len(),
        3,
        "{:#}",
        planned.body
    );
    let path = submit(&app, &asked).await;
    let ended = wait_for_end(&app, &path).await;
    let levels = ended["study"]["finer_levels"].as_array().unwrap().clone();
    assert_eq!(levels[0]["cell_size_m"], 0.0133, "{ended:#}");
    let accuracy = app.get(&format!("{path}/answers")).await.body["accuracy"].clone();
    assert_eq!(accuracy["needed"], "nothing", "{accuracy:#}");
    assert!(accuracy["reached"].as_f64().unwrap() <= 0.5, "{accuracy:#}");
    assert_eq!(
        accuracy["levels"].as_array().unwrap().len(),
        levels.len() + 1
    );

    let tighter = json!({"accuracy": {"quantity": "runout_m", "target": 0.001,
                                      "finest_cell_size_m": 0.008}});
    let changed = change(&app, &path, &tighter).await;
    assert_eq!(changed.status, StatusCode::OK, "{:#}", changed.body);
    wait_for_end(&app, &path).await;
    let accuracy = app.get(&format!("{path}/answers")).await.body["accuracy"].clone();
    assert_eq!(accuracy["needed"], "smaller_cells", "{accuracy:#}");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_accuracy_and_a_stopping_rule_replace_each_other() {
    let app = TestApp::start().await;
    let mut asked = study(16);
    asked["questions"] = json!([{"rest": {"body": 0, "regions": [0.5]}}]);
    asked["stop"] = json!({"region": 0.5, "area_changes_less_than": 0.5, "max_members": 16});
    let path = submit(&app, &asked).await;
    wait_for_end(&app, &path).await;
    let accuracy = json!({"accuracy": {"quantity": "runout_m", "target": 1.0}});
    let changed = change(&app, &path, &accuracy).await;
    assert_eq!(changed.status, StatusCode::OK, "{:#}", changed.body);
    let ended = wait_for_end(&app, &path).await;
    assert_eq!(ended["study"]["stop"], Value::Null);
    assert_eq!(ended["study"]["accuracy"]["target"], 1.0);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn levels_that_can_not_be_are_refused_by_their_place() {
    let app = TestApp::start().await;
    let mut wrong = on_two_levels();
    wrong["finer_levels"] = json!([{"cell_size_m": 0.019, "members": 32}]);
    wrong["accuracy"] = json!({"quantity": "runout", "target": 0.0});
    wrong["design"] = json!({"latin_hypercube": {"members": 16, "seed": 1}});
    let refused = post(&app, &wrong).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    let pointers: Vec<&str> = refused.body["errors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|fault| fault["pointer"].as_str().unwrap())
        .collect();
    let expected = [
        "/design",
        "/finer_levels/0/cell_size_m",
        "/finer_levels/0/members",
        "/accuracy/target",
    ];
    assert_eq!(pointers, expected, "{:#}", refused.body);

    let mut automatic = on_two_levels();
    automatic["scenario"]["numerics"] = json!({});
    let refused = post(&app, &automatic).await;
    assert_eq!(
        refused.body["errors"][0]["pointer"],
        "/scenario/numerics/cell_size_m"
    );

    let mut tiny = on_two_levels();
    tiny["finer_levels"] = json!([{"cell_size_m": 0.005, "members": 8},
                                  {"cell_size_m": 0.00125, "members": 8},
                                  {"cell_size_m": 0.0004, "members": 8},
                                  {"cell_size_m": 0.0001, "members": 8}]);
    let refused = post(&app, &tiny).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");

    let path = submit(&app, &on_two_levels()).await;
    let other = json!({"finer_levels": [{"cell_size_m": 0.01, "members": 8}]});
    let refused = change(&app, &path, &other).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    app.stop().await;
}
