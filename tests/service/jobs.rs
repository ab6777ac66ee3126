//! Submitting, reading and listing jobs.

use crate::app::{TestApp, endless_scene, has_ended, is_running, tiny_scene};
use reqwest::StatusCode;
use serde_json::{Value, json};

#[tokio::test(flavor = "multi_thread")]
async fn a_job_goes_from_accepted_to_successful() {
    let app = TestApp::start().await;
    let answer = app
        .post("application/json; charset=utf-8", tiny_scene().to_string())
        .await;
    assert_eq!(answer.status, StatusCode::ACCEPTED);
    let id = answer.body["id"].as_str().unwrap();
    assert_eq!(
        answer.location.as_deref(),
        Some(format!("/v1/jobs/{id}").as_str())
    );
    assert_eq!(answer.body["outcome"], Value::Null);

    let job = app.wait_for_success(&answer.location.unwrap()).await;
    assert_eq!(job["problem"], Value::Null);
    assert_eq!(job["attempt"], 1);
    assert_eq!(job["progress"]["fraction"], 1.0);
    assert_eq!(job["progress"]["simulated_time_s"], 0.05);
    assert_eq!(job["progress"]["eta_s"], Value::Null);
    assert!(job["progress"]["steps"].as_u64() > Some(0));
    assert!(job["progress"]["substeps"].as_u64() >= job["progress"]["steps"].as_u64());
    let times: Vec<&str> = ["created", "started", "finished"]
        .map(|key| job[key].as_str().unwrap())
        .into();
    assert!(
        times.is_sorted(),
        "RFC 3339 in UTC sorts as text: {times:?}"
    );
    assert!(
        times
            .iter()
            .all(|time| time.ends_with('Z') && &time[10..11] == "T"),
        "{times:?}"
    );
    assert_eq!(job["outcome"]["bodies"].as_array().unwrap().len(), 1);
    assert_eq!(job["outcome"]["cost"]["threads"], 1);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_scenario_comes_back_with_its_defaults_filled_in() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    let scenario = app.get(&job).await.body["scenario"].take();
    // Values of the request, and the documented defaults of fields that were left out.
    assert_eq!(scenario["channel"]["width_m"], 0.1);
    assert_eq!(scenario["gravity_m_s2"], 9.81);
    assert_eq!(scenario["bodies"][0]["sphero_radius_m"], 0.002);
    assert_eq!(
        scenario["bodies"][0]["position"]["elevation_m"],
        Value::Null
    );
    assert_eq!(scenario["numerics"]["courant"], Value::Null);
    assert_eq!(scenario["numerics"]["precision"], "single");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_flow_of_too_many_points_is_refused_at_once() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    // 0.0003 m³ in cells of 0.2 mm with 64 points each: 2.4 thousand million points.
    scene["numerics"] = json!({"cell_size_m": 0.0002, "points_per_cell": 64});
    let answer = app.post("application/json", scene.to_string()).await;
    answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    assert_eq!(answer.wrong_fields(), ["/numerics/cell_size_m"]);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_numerical_failure_is_final_says_where_and_keeps_what_there_is() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    // A block of 1,000,000 kg/m³ falls on the cube, whose contact can only carry its own
    // weight.
    let cube = json!({"shape": {"cube": {"side_m": 0.04}}, "contact_modulus_pa": 1e6,
                      "position": {"downstream_m": 0.1}});
    let block = json!({"shape": {"cube": {"side_m": 0.04}}, "density_kg_m3": 1e6,
                       "position": {"downstream_m": 0.1, "elevation_m": 0.2}});
    scene["bodies"] = json!([cube, block]);
    scene["duration_s"] = json!(0.5);
    scene["sample_interval_s"] = json!(0.0001);
    let path = app.submit(&scene).await;
    let job = app.wait(&path, has_ended).await;
    assert_eq!(job["status"], "failed", "{job:#}");
    assert_eq!(job["outcome"], Value::Null);
    assert_eq!(job["problem"]["type"], "urn:scree:failure:numerical");
    let time_s = job["problem"]["time_s"].as_f64().unwrap();
    assert!(time_s > 0.0 && time_s < 0.5, "{time_s}");
    assert!(job["progress"]["fraction"].as_f64().unwrap() < 1.0);
    let trajectory = app.get(&format!("{path}/trajectory")).await.body;
    let times = trajectory["columns"]["time_s"].as_array().unwrap();
    let last = times.last().unwrap().as_f64().unwrap();
    assert!(times.len() > 1 && last <= time_s, "{last} {time_s}");
    app.delete(&path)
        .await
        .assert_problem(StatusCode::CONFLICT, "job-ended");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn scenes_with_nothing_to_do_succeed_too() {
    let app = TestApp::start().await;
    for (key, value, samples) in [
        ("duration_s", json!(0), Some(1)),
        ("flow", Value::Null, Some(6)),
        ("bodies", json!([]), None),
    ] {
        let mut scene = tiny_scene();
        scene[key] = value;
        let path = app.submit(&scene).await;
        app.wait_for_success(&path).await;
        let trajectory = app.get(&format!("{path}/trajectory")).await;
        match samples {
            Some(samples) => {
                let times = trajectory.body["columns"]["time_s"].as_array().unwrap();
                assert_eq!(times.len(), samples, "{key}");
            }
            None => trajectory.assert_problem(StatusCode::NOT_FOUND, "unknown-body"),
        }
        assert_eq!(
            app.get(&format!("{path}/flow")).await.status,
            StatusCode::OK,
            "{key}"
        );
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_go_page_by_page_newest_first() {
    let app = TestApp::start().await;
    let running = app.submit(&endless_scene()).await;
    app.wait(&running, is_running).await;
    let mut expected = vec![running.clone()];
    for _ in 0..4 {
        expected.insert(0, app.submit(&tiny_scene()).await);
    }

    let mut seen = Vec::new();
    let mut path = "/v1/jobs?limit=2".to_owned();
    let mut pages = 0;
    loop {
        let page = app.get(&path).await;
        assert_eq!(page.status, StatusCode::OK);
        seen.extend(paths(&page.body));
        pages += 1;
        let Some(cursor) = page.body["next_cursor"].as_str() else {
            break;
        };
        path = format!("/v1/jobs?limit=2&cursor={cursor}");
    }
    assert_eq!((seen, pages), (expected.clone(), 3));

    let only_running = app.get("/v1/jobs?status=running").await.body;
    assert_eq!(paths(&only_running), std::slice::from_ref(&running));
    assert_eq!(only_running["jobs"][0]["title"], "endless");
    let waiting = app.get("/v1/jobs?status=accepted&limit=3").await.body;
    assert_eq!(paths(&waiting), expected[..3]);
    assert_eq!(
        app.get("/v1/jobs?status=failed").await.body,
        json!({"jobs": [], "next_cursor": null})
    );
    let both = app.get("/v1/jobs?status=accepted,running").await.body;
    assert_eq!(paths(&both), expected);
    let both = app.get("/v1/jobs?status=running&status=failed").await.body;
    assert_eq!(paths(&both), std::slice::from_ref(&running));
    app.delete(&running).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn lists_are_of_a_span_of_time_and_have_outcomes_on_request() {
    let app = TestApp::start().await;
    let (first, second) = (
        app.submit(&tiny_scene()).await,
        app.submit(&tiny_scene()).await,
    );
    let first_job = app.wait_for_success(&first).await;
    let second_job = app.wait_for_success(&second).await;
    let created = |job: &Value| job["created"].as_str().unwrap().to_owned();
    let ask = async |query: String| app.get(&format!("/v1/jobs?{query}")).await.body;
    let all = [second.clone(), first.clone()];
    let since = created(&first_job);
    assert_eq!(paths(&ask(format!("created_from={since}")).await), all);
    let until = created(&second_job);
    assert_eq!(paths(&ask(format!("created_to={until}")).await), all);
    let until = until.replace('Z', "%2B01:00");
    assert!(paths(&ask(format!("created_to={until}")).await).is_empty());

    let page = ask("include=outcome&limit=1".to_owned()).await;
    assert_eq!(page["jobs"][0]["outcome"], second_job["outcome"]);
    let cursor = page["next_cursor"].as_str().unwrap();
    let page = ask(format!("include=outcome&cursor={cursor}")).await;
    assert_eq!(page["jobs"][0]["outcome"], first_job["outcome"]);
    assert_eq!(page["next_cursor"], Value::Null);
    let page = ask(String::new()).await;
    assert_eq!(page["jobs"][0].get("outcome"), None);
    let waiting = app.submit(&endless_scene()).await;
    let page = ask("include=outcome&limit=1".to_owned()).await;
    assert_eq!(page["jobs"][0].get("outcome"), Some(&Value::Null));
    app.delete(&waiting).await;
    app.stop().await;
}

fn paths(page: &Value) -> Vec<String> {
    let jobs = page["jobs"].as_array().unwrap();
    jobs.iter()
        .map(|job| format!("/v1/jobs/{}", job["id"].as_str().unwrap()))
        .collect()
}
