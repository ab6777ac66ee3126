//! OGC API – Processes: the same jobs under `/ogc`.

use crate::app::{Answer, TestApp, endless_scene, has_ended, is_running, tiny_scene};
use reqwest::{Method, Response, StatusCode};
use serde_json::{Value, json};

const EXECUTION: &str = "/ogc/processes/simulation/execution";
const EXCEPTIONS: &str = "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/";

fn request(scenario: &Value) -> Value {
    json!({"inputs": {"scenario": {"value": scenario}}})
}

async fn execute(app: &TestApp, request: &Value, headers: &[(&str, &str)]) -> Response {
    let post = app
        .client
        .post(app.url(EXECUTION))
        .body(request.to_string());
    let post = post.header("content-type", "application/json");
    let post = headers
        .iter()
        .fold(post, |post, (name, value)| post.header(*name, *value));
    post.send().await.unwrap()
}

/// Executes without waiting; returns the job's path.
async fn accepted(app: &TestApp, scenario: &Value) -> String {
    let prefer = [("prefer", "respond-async")];
    let answer = Answer::read(execute(app, &request(scenario), &prefer).await).await;
    assert_eq!(answer.status, StatusCode::CREATED, "{:#}", answer.body);
    let location = answer.location.unwrap();
    location.strip_prefix(&app.url("")).unwrap().to_owned()
}

/// The addresses of a document's links of this relation.
fn links<'a>(document: &'a Value, rel: &str) -> Vec<&'a str> {
    let links = document["links"].as_array().unwrap().iter();
    let of_rel = links.filter(|link| link["rel"].as_str().unwrap().ends_with(rel));
    of_rel.map(|link| link["href"].as_str().unwrap()).collect()
}

fn assert_exception(answer: &Answer, name: &str) {
    assert_eq!(answer.status, StatusCode::NOT_FOUND, "{:#}", answer.body);
    assert_eq!(answer.content_type, "application/problem+json");
    assert_eq!(answer.body["type"], format!("{EXCEPTIONS}{name}"));
}

#[tokio::test(flavor = "multi_thread")]
async fn every_link_from_the_landing_page_leads_somewhere() {
    let app = TestApp::start().await;
    let mut to_visit = vec![app.url("/ogc"), app.url("/ogc/")];
    let mut visited = Vec::new();
    while let Some(place) = to_visit.pop() {
        let answer = app.get(place.strip_prefix(&app.url("")).unwrap()).await;
        assert_eq!(answer.status, StatusCode::OK, "{place}");
        visited.push(place);
        let lists = [&answer.body, &answer.body["processes"][0]];
        let found = lists
            .into_iter()
            .filter_map(|list| list["links"].as_array());
        for link in found.flatten().filter(|link| !is_execution(link)) {
            let place = link["href"].as_str().unwrap().to_owned();
            if !visited.contains(&place) && !to_visit.contains(&place) {
                to_visit.push(place);
            }
        }
    }
    visited.sort();
    let paths: Vec<&str> = visited
        .iter()
        .map(|place| &place[app.url("").len()..])
        .collect();
    let wanted = [
        "/",
        "/ogc",
        "/ogc/",
        "/ogc/conformance",
        "/ogc/jobs",
        "/ogc/processes",
        "/ogc/processes/simulation",
        "/openapi.json",
    ];
    assert_eq!(paths, wanted);
    app.stop().await;
}

fn is_execution(link: &Value) -> bool {
    link["href"].as_str().unwrap().ends_with(EXECUTION)
}

#[tokio::test(flavor = "multi_thread")]
async fn the_process_has_the_schemas_of_the_contract_in_openapi_3_0() {
    let app = TestApp::start().await;
    let described = app.get("/ogc/processes/simulation").await.body;
    let contract = app.get("/openapi.json").await.body;
    let schema = &described["inputs"]["scenario"]["schema"];
    let own = &contract["components"]["schemas"]["Scenario"];
    let names = |schema: &Value| {
        schema["properties"]
            .as_object()
            .unwrap()
            .keys()
            .cloned()
            .collect::<Vec<_>>()
    };
    assert_eq!(names(schema), names(own));
    assert_eq!(schema["required"], own["required"]);
    assert_eq!(schema["example"], own["examples"][0]);
    assert_eq!(schema["properties"]["flow"]["nullable"], true);
    let text = described.to_string();
    for newer in ["$ref", "\"null\"", "\"examples\"", "\"type\":["] {
        assert!(!text.contains(newer), "{newer}");
    }
    let other = app.get("/ogc/processes/sorting").await;
    assert_exception(&other, "no-such-process");
    let other = app
        .ask(Method::POST, "/ogc/processes/sorting/execution")
        .await;
    assert_exception(&other, "no-such-process");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn who_waits_gets_the_results_and_who_does_not_the_job() {
    let app = TestApp::start().await;
    let response = execute(&app, &request(&tiny_scene()), &[]).await;
    let monitor = response.headers()["link"].to_str().unwrap().to_owned();
    let waited = Answer::read(response).await;
    assert_eq!(waited.status, StatusCode::OK, "{:#}", waited.body);

    let path = accepted(&app, &tiny_scene()).await;
    let state = app.wait(&path, has_ended).await;
    assert_eq!(state["status"], "successful", "{state:#}");
    assert_eq!(state["progress"], 100);
    assert_eq!(state["updated"], state["finished"]);
    let results = links(&state, "/results")[0]
        .strip_prefix(&app.url(""))
        .unwrap();
    let results = app.get(results).await.body;
    let own_form = path.replace("/ogc", "/v1");
    let job = app.get(&own_form).await.body;
    assert_eq!(results["outcome"]["value"], job["outcome"]);
    assert_eq!(
        waited.body["outcome"]["value"]["bodies"],
        job["outcome"]["bodies"]
    );
    for output in ["trajectory", "flow", "motion", "aerial"] {
        let href = results[output]["href"].as_str().unwrap();
        let response = app.client.get(href).send().await.unwrap();
        assert_eq!(response.status(), StatusCode::OK, "{href}");
        assert_eq!(
            response.headers()["content-type"],
            *results[output]["type"].as_str().unwrap()
        );
    }

    let listed = app.get("/ogc/jobs?limit=1&status=successful").await.body;
    assert_eq!(links(&listed["jobs"][0], "self")[0], app.url(&path));
    let next = links(&listed, "next")[0]
        .strip_prefix(&app.url(""))
        .unwrap()
        .to_owned();
    let listed = app.get(&next).await.body;
    let first = links(&listed["jobs"][0], "self")[0];
    assert_eq!(monitor, format!("<{first}>; rel=\"monitor\""));
    assert_eq!(links(&listed, "next"), [""; 0]);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn raw_answers_are_the_outcome_or_links() {
    let app = TestApp::start().await;
    let mut raw = request(&tiny_scene());
    raw["outputs"] = json!({"outcome": {}});
    let outcome = Answer::read(execute(&app, &raw, &[]).await).await;
    assert!(
        outcome.body["bodies"][0]["displacement_m"].is_number(),
        "{outcome:?}"
    );
    raw["outputs"] = json!({"flow": {}, "motion": {"transmissionMode": "reference"}});
    raw["response"] = json!("raw");
    let answer = execute(&app, &raw, &[]).await;
    assert_eq!(answer.status(), StatusCode::NO_CONTENT);
    let links = answer.headers().get_all("link").iter();
    let links: Vec<&str> = links.map(|link| link.to_str().unwrap()).collect();
    let ends = [
        "/flow.zip>; rel=\"item\"",
        "/motion.svg>; rel=\"item\"",
        "; rel=\"monitor\"",
    ];
    assert_eq!(links.len(), ends.len());
    for (link, end) in links.iter().zip(ends) {
        assert!(link.ends_with(end), "{link}");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_that_takes_longer_than_its_client_waits_goes_on() {
    let app = TestApp::start().await;
    let short = [("prefer", "respond-async, wait=1")];
    let response = execute(&app, &request(&endless_scene()), &short).await;
    assert_eq!(response.headers()["preference-applied"], "respond-async");
    let answer = Answer::read(response).await;
    assert_eq!(answer.status, StatusCode::CREATED, "{:#}", answer.body);
    let path = answer.location.unwrap();
    let path = path.strip_prefix(&app.url("")).unwrap();
    let running = app.wait(path, is_running).await;
    assert!(running["started"].is_string() && running.get("finished").is_none());
    assert_eq!(links(&running, "/results"), [""; 0]);
    let results = format!("{path}/results");
    assert_exception(&app.get(&results).await, "result-not-ready");
    for _ in 0..2 {
        let dismissed = app.delete(path).await;
        assert_eq!(dismissed.status, StatusCode::OK, "{:#}", dismissed.body);
        assert_eq!(dismissed.body["status"], "dismissed");
    }
    let none = app.get(&results).await;
    none.assert_problem(StatusCode::NOT_FOUND, "job-dismissed");
    let unknown = app
        .get("/ogc/jobs/01890a5d-ac96-774b-bcce-b302099a8057")
        .await;
    assert_exception(&unknown, "no-such-job");
    let unknown = app.delete("/ogc/jobs/no-job").await;
    assert_exception(&unknown, "no-such-job");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_repeated_execution_is_the_same_job() {
    let app = TestApp::start().await;
    let asked = request(&tiny_scene());
    let key = ("idempotency-key", "once");
    let first = Answer::read(execute(&app, &asked, &[key]).await).await;
    assert_eq!(first.status, StatusCode::OK);
    let again = Answer::read(execute(&app, &asked, &[key]).await).await;
    assert_eq!(again.body, first.body);
    let later = execute(&app, &asked, &[key, ("prefer", "respond-async")]).await;
    assert_eq!(later.status(), StatusCode::CREATED);
    let all = app.get("/ogc/jobs").await.body;
    assert_eq!(all["jobs"].as_array().unwrap().len(), 1);
    let other = execute(&app, &request(&endless_scene()), &[key]).await;
    let other = Answer::read(other).await;
    other.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "key-of-another-request");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn faults_of_a_scenario_are_named_where_the_request_has_them() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["channel"]["inclination_deg"] = json!(95);
    let refused = Answer::read(execute(&app, &request(&scene), &[]).await).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-scenario");
    let wanted = ["/inputs/scenario/value/channel/inclination_deg"];
    assert_eq!(refused.wrong_fields(), wanted);
    let mut other = request(&tiny_scene());
    other["outputs"] = json!({"outcme": {}});
    let refused = Answer::read(execute(&app, &other, &[]).await).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-execute-request");
    let refused = app.post_to(EXECUTION, "application/json", "{").await;
    refused.assert_problem(StatusCode::BAD_REQUEST, "malformed-json");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn results_of_a_failed_job_are_its_problem() {
    let app = TestApp::start_with(|config| config.limits.job_results_bytes = Some(1)).await;
    let path = accepted(&app, &endless_scene()).await;
    let state = app.wait(&path, has_ended).await;
    assert_eq!(state["status"], "failed", "{state:#}");
    assert_eq!(
        links(&state, "/exceptions"),
        [app.url(&format!("{path}/results"))]
    );
    let results = app.get(&format!("{path}/results")).await;
    assert_eq!(results.status, StatusCode::INTERNAL_SERVER_ERROR);
    assert_eq!(results.content_type, "application/problem+json");
    let job = app.get(&path.replace("/ogc", "/v1")).await.body;
    for member in ["type", "title", "detail"] {
        assert_eq!(results.body[member], job["problem"][member]);
    }
    app.stop().await;
}
