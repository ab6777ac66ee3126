//! The contract in `api/openapi.json`: it equals the one generated from the code, the service
//! serves it, and real answers conform to it.

use crate::app::{TestApp, tiny_scene};
use serde_json::{Map, Value};
use std::collections::BTreeSet;
use std::path::Path;

/// Keys of a scenario that stand in a channel alone, or on a terrain alone.
const OF_ONE_GROUND: [&str; 9] = [
    "channel",
    "terrain",
    "volume_m3",
    "release",
    "releases",
    "downstream_m",
    "lateral_m",
    "east_m",
    "north_m",
];

mod record;
mod scenario_fields;

/// To update the file after an intended change:
/// `UPDATE_OPENAPI=1 cargo test --test service contract`
#[test]
fn the_committed_contract_is_that_of_the_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("api/openapi.json");
    let mut current = scree::http::openapi().to_pretty_json().unwrap();
    current.push('\n');
    if std::env::var_os("UPDATE_OPENAPI").is_some() {
        std::fs::write(&path, &current).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == current,
        "api/openapi.json is not what the code says; if the change is wanted, run \
         UPDATE_OPENAPI=1 cargo test --test service contract"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn the_service_serves_its_contract_and_keeps_to_it() {
    let app = TestApp::start().await;
    let served = app.get("/openapi.json").await;
    assert_eq!(served.content_type, "application/json");
    let contract = Contract(served.body);
    let written: Value = serde_json::from_str(&scree::http::openapi().to_json().unwrap()).unwrap();
    assert_eq!(contract.0, written);

    let mut scene = tiny_scene();
    scene["accuracy"] = serde_json::json!({"error_bars": true});
    let path = app.submit(&scene).await;
    let mut job = app.wait_for_success(&path).await;
    // Only a failed job has a problem.
    job["problem"] = serde_json::json!({"type": "", "title": "", "detail": ""});
    contract.assert_matches("Job", &job);
    let scene = scene.to_string();
    let planned = app.post_to("/v1/plans", "application/json", scene).await;
    contract.assert_matches("Planned", &planned.body);
    let page = app.get("/v1/jobs?include=outcome").await;
    contract.assert_matches("JobPage", &page.body);
    contract.assert_matches(
        "Trajectory",
        &app.get(&format!("{path}/trajectory")).await.body,
    );
    contract.assert_matches("FlowSnapshot", &app.get(&format!("{path}/flow")).await.body);
    contract.assert_matches("Health", &app.get("/healthz").await.body);
    app.stop().await;
}

/// Documents of `api/examples` and their schemas.
const EXAMPLES: [(&str, &str); 15] = [
    ("batch-answer.json", "BatchAnswer"),
    ("flow-snapshot.json", "FlowSnapshot"),
    ("health.json", "Health"),
    ("job.json", "Job"),
    ("job-page.json", "JobPage"),
    ("planned.json", "Planned"),
    ("terrain.json", "StoredTerrain"),
    ("terrain-page.json", "TerrainPage"),
    ("trajectory.json", "Trajectory"),
    ("ogc/landing-page.json", "LandingPage"),
    ("ogc/conformance.json", "Conformance"),
    ("ogc/process-list.json", "ProcessList"),
    ("ogc/status-info.json", "StatusInfo"),
    ("ogc/job-list.json", "JobList"),
    ("ogc/results.json", "Results"),
];

/// The examples of the contract are answers of a service. To record them anew after an intended
/// change: `UPDATE_EXAMPLES=1 cargo test --test service contract`, then as above.
#[tokio::test(flavor = "multi_thread")]
async fn the_examples_are_documents_as_the_service_answers_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("api/examples");
    if std::env::var_os("UPDATE_EXAMPLES").is_some() {
        record::all(&folder).await;
    }
    let contract = serde_json::from_str(&scree::http::openapi().to_json().unwrap()).unwrap();
    let contract = Contract(contract);
    let read = |name: &str| -> Value {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        serde_json::from_str(&text).unwrap()
    };
    for (name, schema) in EXAMPLES {
        let mut document = read(name);
        if schema == "Job" {
            // Only a failed job has a problem.
            document["problem"] = serde_json::json!({"type": "", "title": "", "detail": ""});
            document["outcome"].as_object().expect("an outcome");
        }
        contract.assert_matches(schema, &document);
    }
    for (status, problem) in read("problems.json").as_object().unwrap() {
        assert!(
            status.starts_with(&problem["status"].to_string()),
            "{status}"
        );
    }
    // The service takes the examples of requests.
    let app = TestApp::start().await;
    let execution = "/ogc/processes/simulation/execution";
    let execute = read("ogc/execute.json").to_string();
    let answer = app.post_to(execution, "application/json", execute).await;
    assert_eq!(answer.status, 200, "{}", answer.body);
    let batch = read("batch.json").to_string();
    let answer = app.post_to("/v1/batches", "application/json", batch).await;
    assert_eq!(answer.status, 202, "{}", answer.body);
    app.stop().await;
}

struct Contract(Value);

impl Contract {
    /// Checks that a document has exactly the fields of a schema, at all
    /// levels. Other tests check the types.
    fn assert_matches(&self, schema: &str, document: &Value) {
        let schema = &self.0["components"]["schemas"][schema];
        assert!(schema.is_object(), "no such schema");
        self.compare(schema, document, "");
    }

    fn compare(&self, schema: &Value, document: &Value, place: &str) {
        let schema = self.resolve(schema);
        match document {
            Value::Object(fields) => {
                let Some(properties) = self.properties(schema, fields.keys().next()) else {
                    panic!("{place}: the contract has no object here: {schema}");
                };
                let present: BTreeSet<&String> = fields.keys().collect();
                let is_there =
                    |key: &&String| present.contains(key) || !OF_ONE_GROUND.contains(&key.as_str());
                let named: BTreeSet<&String> = properties.keys().filter(is_there).collect();
                assert_eq!(present, named, "{place}");
                for (name, value) in fields {
                    self.compare(&properties[name], value, &format!("{place}/{name}"));
                }
            }
            Value::Array(items) => {
                assert!(
                    schema["items"].is_object(),
                    "{place}: the contract has no list: {schema}"
                );
                for item in items {
                    self.compare(&schema["items"], item, &format!("{place}/-"));
                }
            }
            _ => assert!(
                schema["properties"].is_null(),
                "{place}: the contract has an object"
            ),
        }
    }

    /// The properties of an object; of alternatives, those of the one that has
    /// the field, and of parts those of all.
    fn properties(&self, schema: &Value, field: Option<&String>) -> Option<Map<String, Value>> {
        if let Some(properties) = schema["properties"].as_object() {
            return Some(properties.clone());
        }
        if let Some(parts) = schema["allOf"].as_array() {
            let parts = parts.iter().map(|part| self.resolve(part));
            let all = parts.filter_map(|part| self.properties(part, field));
            return Some(all.flatten().collect());
        }
        let alternatives = schema["oneOf"].as_array()?;
        alternatives
            .iter()
            .filter_map(|alternative| self.resolve(alternative)["properties"].as_object())
            .find(|properties| field.is_some_and(|field| properties.contains_key(field)))
            .cloned()
    }

    fn resolve<'a>(&'a self, schema: &'a Value) -> &'a Value {
        match schema["$ref"].as_str() {
            Some(reference) => self.0.pointer(reference.trim_start_matches('#')).unwrap(),
            None => schema,
        }
    }
}

/// The tables of `docs/scenario.md` are made from the code. To update them after an intended
/// change: `UPDATE_OPENAPI=1 cargo test --test service contract`
#[test]
fn the_tables_of_the_scenario_are_those_of_the_code() {
    const HEAD: &str = "| Field | Meaning | Unit | Default | Allowed |";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/scenario.md");
    let document = std::fs::read_to_string(&path).unwrap();
    let schemas = scree::http::openapi().components.unwrap().schemas;
    let mut tables = scree_solver::schema::tables(&schemas).into_iter();
    let mut lines = document.lines().peekable();
    let mut current = String::new();
    while let Some(line) = lines.next() {
        current += &format!("{line}\n");
        if line == HEAD {
            current += &format!("{}\n", lines.next().unwrap());
            while lines.next_if(|line| line.starts_with('|')).is_some() {}
            for row in tables.next().unwrap() {
                current += &format!("{row}\n");
            }
        }
    }
    assert_eq!(tables.next(), None, "a table is missing in the document");
    if std::env::var_os("UPDATE_OPENAPI").is_some() {
        std::fs::write(&path, &current).unwrap();
    }
    assert!(
        current == document,
        "the tables of docs/scenario.md are not what the code says; if the change is wanted, \
         run UPDATE_OPENAPI=1 cargo test --test service contract"
    );
}
