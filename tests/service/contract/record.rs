//! Records the examples of the contract.

use crate::app::{Answer, TestApp, endless_scene, is_running};
use serde_json::{Value, json};
use std::path::Path;

/// Entries that are kept of a long list.
const KEPT: usize = 2;

fn scene() -> Value {
    json!({
        "title": "A cube in the way",
        "channel": {"inclination_deg": 40, "incline_length_m": 1, "runout_length_m": 1},
        "flow": {"volume_m3": 0.002},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
        "duration_s": 0.2,
        "sample_interval_s": 0.1,
        "flow_snapshots": 2,
    })
}

/// Records all examples in this folder.
pub(super) async fn all(folder: &Path) {
    let write = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
    };
    let document = |name: &str, document: &Value| {
        let text = serde_json::to_string_pretty(document).unwrap();
        write(name, &(text + "\n"));
    };
    let app = TestApp::start().await;
    let json_type = "application/json";
    let job = app.post_to("/v1/jobs?label=study:cubes", json_type, scene().to_string());
    let path = job.await.location.unwrap();
    document("job.json", &app.wait_for_success(&path).await);
    document(
        "job-page.json",
        &app.get("/v1/jobs?include=outcome").await.body,
    );
    let planned = app.post_to("/v1/plans", json_type, scene().to_string());
    document("planned.json", &planned.await.body);
    let batch = json!({"labels": ["study:cubes"], "jobs": [
        {"scenario": scene(), "labels": ["side:40mm"]},
        {"scenario": scene()},
    ]});
    document("batch.json", &batch);
    let answer = app.post_to("/v1/batches", json_type, batch.to_string());
    document("batch-answer.json", &answer.await.body);
    document("health.json", &app.get("/healthz").await.body);
    let trajectory = format!("{path}/trajectory");
    document("trajectory.json", &app.get(&trajectory).await.body);
    let mut flow = app.get(&format!("{path}/flow")).await.body;
    for list in ["point_id", "position_m", "speed_m_s"] {
        flow[list].as_array_mut().unwrap().truncate(KEPT);
    }
    flow["thinning"] = json!(flow["points"].as_u64().unwrap() / KEPT as u64);
    document("flow-snapshot.json", &flow);
    let fields = "fields=time_s,position_m";
    let csv = app.get(&format!("{trajectory}?format=csv&{fields}")).await;
    write("trajectory.csv", csv.body.as_str().unwrap());
    let lines = app
        .client
        .get(app.url(&format!("{trajectory}?format=ndjson&{fields}")));
    let lines = lines.send().await.unwrap().text().await.unwrap();
    write("trajectory.ndjson", &lines);
    let id = path.rsplit('/').next().unwrap();
    let events = app.client.get(app.url(&format!("/v1/events?job={id}")));
    write(
        "events.txt",
        &events.send().await.unwrap().text().await.unwrap(),
    );
    let metrics = app.get("/metrics").await;
    write("metrics.txt", metrics.body.as_str().unwrap());
    for (name, answer) in ogc(&app, id).await {
        document(&format!("ogc/{name}.json"), &answer);
    }
    let height_map = include_bytes!("../../../rasters/tests/files/tiled-zstd-uint16.tif");
    let terrain = app.post_to("/v1/terrains", "image/tiff", &height_map[..]);
    document("terrain.json", &terrain.await.body);
    document("terrain-page.json", &app.get("/v1/terrains").await.body);
    document("problems.json", &problems(&app, &path).await);
    app.stop().await;
}

/// Documents of OGC API – Processes, of this job and under a name instead of a passing port.
async fn ogc(app: &TestApp, id: &str) -> Vec<(&'static str, Value)> {
    let execute = json!({
        "inputs": {"scenario": {"value": scene()}},
        "outputs": {"outcome": {"transmissionMode": "value"}, "flow": {}},
        "response": "document",
    });
    let mut documents = vec![("execute", execute)];
    for (name, path) in [
        ("landing-page", "/ogc"),
        ("conformance", "/ogc/conformance"),
        ("process-list", "/ogc/processes"),
        ("process-description", "/ogc/processes/simulation"),
        ("job-list", "/ogc/jobs?status=successful&limit=1"),
        ("status-info", &format!("/ogc/jobs/{id}")),
        ("results", &format!("/ogc/jobs/{id}/results")),
    ] {
        let request = app.client.get(app.url(path));
        let answer = request.header("host", "localhost").send().await.unwrap();
        documents.push((name, shortened(Answer::read(answer).await.body)));
    }
    documents
}

/// A description of a process without what the contract has of its documents; any other document
/// as it is.
fn shortened(mut document: Value) -> Value {
    for schema in ["/inputs/scenario/schema", "/outputs/outcome/schema"] {
        if let Some(Value::Object(schema)) = document.pointer_mut(schema) {
            schema.retain(|member, _| ["type", "description"].contains(&member.as_str()));
        }
    }
    document
}

/// Problems that a client can bring about, by their status.
async fn problems(app: &TestApp, ended: &str) -> Value {
    let json_type = "application/json";
    let mut steep = scene();
    steep["channel"]["inclination_deg"] = json!(95);
    let too_large = " ".repeat(2_000_000);
    let endless = app.submit(&endless_scene()).await;
    let answers = [
        app.post(json_type, "{").await,
        app.get("/v1/jobs/01890a5d-ac96-774b-bcce-b302099a8057")
            .await,
        app.delete(ended).await,
        app.post(json_type, too_large).await,
        app.post("text/plain", "").await,
        app.post(json_type, steep.to_string()).await,
    ];
    app.delete(&endless).await;
    let of_query = app.get("/v1/jobs?limit=1000&stat=running").await;
    let mut problems = serde_json::Map::new();
    for answer in answers {
        problems.insert(answer.body["status"].to_string(), answer.body);
    }
    problems.insert("422-query".to_owned(), of_query.body);
    let full = TestApp::start_with(|config| config.limits.queued_jobs = 1).await;
    let running = full.submit(&endless_scene()).await;
    full.wait(&running, is_running).await;
    full.submit(&endless_scene()).await;
    let refused = full.post(json_type, scene().to_string()).await;
    problems.insert("429".to_owned(), refused.body);
    full.stop().await;
    Value::Object(problems)
}
