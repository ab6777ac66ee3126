//! Studies: submission, members as jobs, answers, enlargement, end.

use crate::app::{Answer, TestApp, has_ended, long_scene, tiny_scene};
use reqwest::{Method, StatusCode};
use serde_json::{Value, json};

/// A study of a tiny scene with so many members.
pub(crate) fn study(members: u64) -> Value {
    let mut scenario = tiny_scene();
    scenario.as_object_mut().unwrap().remove("flow_snapshots");
    json!({
        "title": "a small study",
        "scenario": scenario,
        "inputs": [
            {"pointer": "/channel/base_friction",
             "distribution": {"uniform": {"from": 0.3, "to": 0.5}}},
        ],
        "design": {"sobol": {"members": members, "seed": 7}},
        "questions": [
            {"exceeds": {"quantity": "displacement_m", "body": 0, "thresholds": [0.0]}},
            {"quantiles": {"quantity": "runout_m", "probabilities": [0.5]}},
        ],
    })
}

pub(crate) async fn post(app: &TestApp, study: &Value) -> Answer {
    let text = study.to_string();
    app.post_to("/v1/studies", "application/json", text).await
}

/// Submits a study that must be accepted; returns its path.
pub(crate) async fn submit(app: &TestApp, study: &Value) -> String {
    let answer = post(app, study).await;
    assert_eq!(answer.status, StatusCode::ACCEPTED, "{:#}", answer.body);
    answer.location.unwrap()
}

pub(crate) async fn change(app: &TestApp, path: &str, changes: &Value) -> Answer {
    let request = app.client.request(Method::PATCH, app.url(path));
    let request = request
        .header("content-type", "application/json")
        .body(changes.to_string());
    Answer::read(request.send().await.unwrap()).await
}

pub(crate) async fn wait_for_end(app: &TestApp, path: &str) -> Value {
    app.wait(path, |study| study["status"] != "running").await
}

async fn members(app: &TestApp, path: &str) -> Vec<Value> {
    let answer = app.get(&format!("{path}/members")).await;
    assert_eq!(answer.status, StatusCode::OK, "{:#}", answer.body);
    answer.body["members"].as_array().unwrap().clone()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_study_is_computed_as_jobs_and_answered() {
    let app = TestApp::start().await;
    let path = submit(&app, &study(4)).await;
    let ended = wait_for_end(&app, &path).await;
    assert_eq!(ended["status"], "successful", "{ended:#}");
    let counts = ["members", "members_made", "members_ended"].map(|key| ended[key].clone());
    assert_eq!(counts, [json!(4), json!(4), json!(4)]);
    let answers = app.get(&format!("{path}/answers")).await.body;
    assert_eq!(answers["members"]["finished"], 4, "{answers:#}");
    let exceeds = &answers["answers"][0]["exceeds"][0]["probability"];
    assert_eq!(exceeds["known"], 4, "{answers:#}");
    let median = &answers["answers"][1]["quantiles"][0]["estimate"];
    let members = members(&app, &path).await;
    let mut runouts = Vec::new();
    for member in &members {
        let job = format!("/v1/jobs/{}", member["job"].as_str().unwrap());
        let job = app.get(&job).await.body;
        let friction = &job["scenario"]["channel"]["base_friction"];
        assert_eq!(*friction, member["values"][0]);
        assert_eq!(job["scenario"]["flow_snapshots"], 0);
        let runout = job["outcome"]["flow"]["runout_m"].as_f64().unwrap();
        let short = &member["outcome"]["finished"]["quantities"]["runout_m"];
        assert_eq!(short.as_f64().unwrap(), runout);
        runouts.push(runout);
    }
    runouts.sort_by(f64::total_cmp);
    let median = median.as_f64().unwrap();
    assert!(
        runouts[1] <= median && median <= runouts[2],
        "{median}, {runouts:?}"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_same_study_has_the_same_members_and_shares_their_jobs() {
    let app = TestApp::start().await;
    let first = submit(&app, &study(2)).await;
    wait_for_end(&app, &first).await;
    let second = submit(&app, &study(4)).await;
    wait_for_end(&app, &second).await;
    let (small, large) = (members(&app, &first).await, members(&app, &second).await);
    assert_eq!(small[..], large[..2]);
    let gone = app.delete(&format!("{first}?remove=ended")).await;
    assert_eq!(gone.status, StatusCode::NO_CONTENT);
    app.get(&first)
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-study");
    assert_eq!(members(&app, &second).await, large, "they are shared");
    let gone = app.delete(&format!("{second}?remove=ended")).await;
    assert_eq!(gone.status, StatusCode::NO_CONTENT);
    let jobs = app.get("/v1/jobs").await.body;
    assert_eq!(jobs["jobs"], json!([]), "members go with their last study");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn both_ends_of_every_input_are_checked_before_anything_runs() {
    let app = TestApp::start().await;
    let mut wrong = study(4);
    wrong["inputs"][0]["distribution"] = json!({"uniform": {"from": -0.5, "to": 0.5}});
    wrong["inputs"].as_array_mut().unwrap().push(json!({
        "pointer": "/channel/width_m", "distribution": {"choice": {"values": [
            {"value": 0.2, "weight": 1.0}, {"value": "wide", "weight": 1.0}]}}
    }));
    let refused = post(&app, &wrong).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    let fields = refused.wrong_fields();
    assert_eq!(
        fields,
        ["/inputs/0/distribution", "/inputs/1/distribution"],
        "{:#}",
        refused.body
    );
    let detail = refused.body["errors"][0]["detail"].as_str().unwrap();
    assert!(detail.contains("-0.5"), "{detail}");
    let mut wrong = study(3);
    wrong["questions"][0]["exceeds"]["thresholds"] = json!([]);
    let refused = post(&app, &wrong).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    assert_eq!(
        refused.wrong_fields(),
        ["/design/sobol/members", "/questions/0/exceeds/thresholds"],
        "{:#}",
        refused.body
    );
    assert_eq!(refused.body["errors"][0]["value"], 3);
    let mut wrong = study(4);
    wrong["questions"][0]["exceeds"]["body"] = json!(1);
    wrong["questions"][1]["quantiles"]["quantity"] = json!("runout");
    let refused = post(&app, &wrong).await;
    let expected = [
        "/questions/0/exceeds/body",
        "/questions/1/quantiles/quantity",
    ];
    assert_eq!(refused.wrong_fields(), expected, "{:#}", refused.body);
    let mut wrong = study(4);
    wrong["desing"] = json!(1);
    post(&app, &wrong)
        .await
        .assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    assert_eq!(app.get("/v1/jobs").await.body["jobs"], json!([]));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_study_goes_on_with_a_larger_design_and_keeps_its_members() {
    let app = TestApp::start().await;
    let path = submit(&app, &study(2)).await;
    wait_for_end(&app, &path).await;
    let before = members(&app, &path).await;
    let other_seed = json!({"design": {"sobol": {"members": 4, "seed": 8}}});
    let refused = change(&app, &path, &other_seed).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-study");
    let larger = json!({"design": {"sobol": {"members": 4, "seed": 7}}});
    let enlarged = change(&app, &path, &larger).await;
    assert_eq!(enlarged.status, StatusCode::OK, "{:#}", enlarged.body);
    assert_eq!(enlarged.body["members"], 4);
    wait_for_end(&app, &path).await;
    let after = members(&app, &path).await;
    assert_eq!(after.len(), 4);
    assert_eq!(after[..2], before[..]);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_dismissed_study_stops_its_members() {
    let app = TestApp::start().await;
    let mut long = study(4);
    long["scenario"] = long_scene();
    let path = submit(&app, &long).await;
    app.wait(&path, |study| study["members_made"] == 4).await;
    app.delete(&format!("{path}?remove=ended"))
        .await
        .assert_problem(StatusCode::CONFLICT, "study-active");
    let dismissed = app.delete(&path).await;
    assert_eq!(dismissed.status, StatusCode::OK, "{:#}", dismissed.body);
    assert_eq!(dismissed.body["status"], "dismissed");
    for member in members(&app, &path).await {
        assert_eq!(member["status"], "dismissed");
        let job = format!("/v1/jobs/{}", member["job"].as_str().unwrap());
        app.wait(&job, has_ended).await;
    }
    let larger = json!({"design": {"sobol": {"members": 8, "seed": 7}}});
    change(&app, &path, &larger)
        .await
        .assert_problem(StatusCode::CONFLICT, "study-ended");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_study_goes_on_after_a_stop_of_the_service() {
    let app = TestApp::start().await;
    let path = submit(&app, &study(8)).await;
    app.wait(&path, |study| study["members_ended"].as_u64() >= Some(1))
        .await;
    let directory = app.stop().await;
    let app = TestApp::start_in(directory, |_| {}).await;
    let ended = wait_for_end(&app, &path).await;
    assert_eq!(ended["members_ended"], 8);
    let interrupted = app.get(&format!("{path}/answers")).await.body;
    app.stop().await;
    let app = TestApp::start().await;
    let path = submit(&app, &study(8)).await;
    wait_for_end(&app, &path).await;
    let undisturbed = app.get(&format!("{path}/answers")).await.body;
    assert_eq!(interrupted, undisturbed);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_member_that_fails_stays_in_the_denominator() {
    let app = TestApp::start_with(|config| config.limits.job_results_bytes = Some(1)).await;
    let path = submit(&app, &study(2)).await;
    let ended = wait_for_end(&app, &path).await;
    assert_eq!(ended["status"], "successful");
    let answers = app.get(&format!("{path}/answers")).await.body;
    let failures = json!([{"reason": "results-size", "members": 2}]);
    assert_eq!(answers["members"]["failures"], failures, "{answers:#}");
    let exceeds = &answers["answers"][0]["exceeds"][0]["probability"];
    let bounds = [&exceeds["lower"], &exceeds["upper"]];
    assert_eq!(bounds, [&json!(0.0), &json!(1.0)], "{answers:#}");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_repeated_request_finds_the_study_of_the_first() {
    let app = TestApp::start().await;
    let send = async |study: &Value| {
        let request = app.client.post(app.url("/v1/studies"));
        let request = request
            .header("content-type", "application/json")
            .header("idempotency-key", "once")
            .body(study.to_string());
        Answer::read(request.send().await.unwrap()).await
    };
    let first = send(&study(2)).await;
    let second = send(&study(2)).await;
    assert_eq!(first.location, second.location);
    let other = send(&study(4)).await;
    other.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "key-of-another-request");
    let listed = app.get("/v1/studies").await.body;
    assert_eq!(listed["studies"].as_array().unwrap().len(), 1);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_single_job_is_computed_before_waiting_members() {
    let app = TestApp::start_with(|config| config.workers.count = Some(1)).await;
    let path = submit(&app, &study(16)).await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let ended = app.get(&path).await.body["members_ended"].as_u64().unwrap();
    assert!(ended < 16, "{ended} members ended first");
    app.stop().await;
}

/// A file of a study: its type and its bytes.
async fn file(app: &TestApp, path: &str) -> (String, Vec<u8>) {
    let answer = app.client.get(app.url(path)).send().await.unwrap();
    assert_eq!(answer.status(), StatusCode::OK, "{path}");
    let kind = answer.headers()["content-type"]
        .to_str()
        .unwrap()
        .to_owned();
    (kind, answer.bytes().await.unwrap().to_vec())
}

#[tokio::test(flavor = "multi_thread")]
async fn answers_come_as_tables_maps_and_pictures() {
    let app = TestApp::start().await;
    let mut asked = study(64);
    asked["questions"] = json!([
        {"sensitivity": {"quantity": "runout_m"}},
        {"rest": {"body": 0, "regions": [0.5, 0.9]}},
    ]);
    let path = submit(&app, &asked).await;
    wait_for_end(&app, &path).await;
    let (kind, csv) = file(&app, &format!("{path}/members.csv")).await;
    assert_eq!(kind, "text/csv; charset=utf-8");
    let csv = String::from_utf8(csv).unwrap();
    let lines: Vec<&str> = csv.split("\r\n").collect();
    assert!(lines[0].starts_with("level,member,/channel/base_friction,failure,front_m"));
    assert_eq!(lines.len(), 66, "a head, 64 members, and an end");
    let (kind, npz) = file(&app, &format!("{path}/members.npz")).await;
    assert_eq!((kind.as_str(), &npz[..2]), ("application/zip", &b"PK"[..]));
    let (kind, regions) = file(&app, &format!("{path}/rest.geojson")).await;
    assert_eq!(kind, "application/geo+json");
    let regions: Value = serde_json::from_slice(&regions).unwrap();
    assert_eq!(regions["type"], "FeatureCollection");
    assert!(!regions["features"].as_array().unwrap().is_empty());
    for picture in [
        "rest.svg",
        "sensitivity.svg",
        "scatter.svg",
        "rest.svg?question=1",
    ] {
        let (kind, svg) = file(&app, &format!("{path}/{picture}")).await;
        assert_eq!(kind, "image/svg+xml", "{picture}");
        roxmltree::Document::parse(std::str::from_utf8(&svg).unwrap()).unwrap();
    }
    app.get(&format!("{path}/rest.svg?question=0"))
        .await
        .assert_problem(StatusCode::NOT_FOUND, "no-answer");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_plan_of_a_study_says_what_its_members_cost() {
    let app = TestApp::start().await;
    let text = study(4).to_string();
    let planned = app
        .post_to("/v1/study-plans", "application/json", text)
        .await;
    assert_eq!(planned.status, StatusCode::OK, "{:#}", planned.body);
    let cost = &planned.body["cost"];
    assert_eq!([&cost["members"], &cost["members_costed"]], [4, 4]);
    assert!(planned.body["wall_time"]["expected_s"].as_f64().unwrap() > 0.0);
    assert_eq!(app.get("/v1/studies").await.body["studies"], json!([]));
    let path = submit(&app, &study(4)).await;
    wait_for_end(&app, &path).await;
    let mut planned = 0.0;
    for member in members(&app, &path).await {
        let job = format!("/v1/jobs/{}", member["job"].as_str().unwrap());
        let plan = app.get(&job).await.body["plan"].clone();
        planned += plan["cost"]["point_steps"].as_f64().unwrap();
    }
    assert_eq!(cost["point_steps"].as_f64().unwrap(), planned);
    app.stop().await;
}
