//! A service under test and its client.

use reqwest::{Client, Method, Response, StatusCode};
use scree::config::ServiceConfig;
use scree::service::{self, RunningService};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Longest wait for any event. Generous, since a machine that builds
/// something else at the same time is slow, not wrong.
pub(crate) const DEADLINE: Duration = Duration::from_secs(60);

/// Time between two polls.
const POLL_PAUSE: Duration = Duration::from_millis(5);

/// A service on a free port with a database of its own.
pub(crate) struct TestApp {
    service: RunningService,
    directory: TempDir,
    pub(crate) client: Client,
}

/// An answer: status and JSON body.
#[derive(Debug)]
pub(crate) struct Answer {
    pub(crate) status: StatusCode,
    pub(crate) content_type: String,
    pub(crate) location: Option<String>,
    pub(crate) body: Value,
}

impl TestApp {
    pub(crate) async fn start() -> Self {
        Self::start_in(TempDir::new().unwrap(), |_| {}).await
    }

    pub(crate) async fn start_with(change: impl FnOnce(&mut ServiceConfig)) -> Self {
        Self::start_in(TempDir::new().unwrap(), change).await
    }

    pub(crate) async fn start_in(
        directory: TempDir,
        change: impl FnOnce(&mut ServiceConfig),
    ) -> Self {
        let mut config = config(&directory);
        change(&mut config);
        let service = service::start(config).await.unwrap();
        // A proxy set in the environment must not be used.
        let client = Client::builder().no_proxy().build().unwrap();
        Self {
            service,
            directory,
            client,
        }
    }

    /// Stops the service; its stored data stays.
    pub(crate) async fn stop(self) -> TempDir {
        self.service.stop().await;
        self.directory
    }

    /// Stops the service once the job has made some progress.
    pub(crate) async fn stop_under(self, job: &str) -> TempDir {
        let steps = |job: &Value| job["progress"]["steps"].as_u64().unwrap();
        let before = steps(&self.get(job).await.body);
        self.wait(job, |job| has_ended(job) || steps(job) > before + 20)
            .await;
        self.stop().await
    }

    pub(crate) fn address(&self) -> std::net::SocketAddr {
        self.service.address()
    }

    pub(crate) fn url(&self, path: &str) -> String {
        format!("http://{}{path}", self.service.address())
    }

    pub(crate) async fn get(&self, path: &str) -> Answer {
        Answer::read(self.client.get(self.url(path)).send().await.unwrap()).await
    }

    pub(crate) async fn delete(&self, path: &str) -> Answer {
        Answer::read(self.client.delete(self.url(path)).send().await.unwrap()).await
    }

    pub(crate) async fn ask(&self, method: Method, path: &str) -> Answer {
        Answer::read(
            self.client
                .request(method, self.url(path))
                .send()
                .await
                .unwrap(),
        )
        .await
    }

    pub(crate) async fn post(&self, content_type: &str, body: impl Into<reqwest::Body>) -> Answer {
        self.post_to("/v1/jobs", content_type, body).await
    }

    pub(crate) async fn post_to(
        &self,
        path: &str,
        content_type: &str,
        body: impl Into<reqwest::Body>,
    ) -> Answer {
        let request = self.client.post(self.url(path));
        let request = request.header("content-type", content_type).body(body);
        Answer::read(request.send().await.unwrap()).await
    }

    /// Submits a scenario that must be accepted; returns the job's path.
    pub(crate) async fn submit(&self, scenario: &Value) -> String {
        let answer = self.post("application/json", scenario.to_string()).await;
        assert_eq!(answer.status, StatusCode::ACCEPTED, "{:#}", answer.body);
        answer.location.unwrap()
    }

    /// Polls the job until it satisfies a condition.
    pub(crate) async fn wait(&self, job: &str, wanted: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        loop {
            let answer = self.get(job).await;
            assert_eq!(answer.status, StatusCode::OK, "{:#}", answer.body);
            if wanted(&answer.body) {
                return answer.body;
            }
            assert!(
                began.elapsed() < DEADLINE,
                "still not as wanted: {:#}",
                answer.body
            );
            tokio::time::sleep(POLL_PAUSE).await;
        }
    }

    /// Waits for a job to end successfully.
    pub(crate) async fn wait_for_success(&self, job: &str) -> Value {
        let job = self.wait(job, has_ended).await;
        assert_eq!(job["status"], "successful", "{job:#}");
        job
    }

    /// Waits until a job runs and some of its samples can be read.
    pub(crate) async fn wait_for_samples(&self, job: &str) {
        let began = Instant::now();
        loop {
            let answer = self.get(&format!("{job}/trajectory")).await;
            let samples = answer.body["columns"]["time_s"].as_array().unwrap().len();
            if samples > 0 {
                return;
            }
            assert!(began.elapsed() < DEADLINE, "no samples came");
            tokio::time::sleep(POLL_PAUSE).await;
        }
    }
}

impl Answer {
    pub(crate) async fn read(response: Response) -> Self {
        let header = |name: &str| {
            let value = response.headers().get(name)?;
            Some(value.to_str().unwrap().to_owned())
        };
        let (status, location) = (response.status(), header("location"));
        let content_type = header("content-type").unwrap_or_default();
        let text = response.text().await.unwrap();
        let body = serde_json::from_str(&text).unwrap_or(Value::String(text));
        Self {
            status,
            content_type,
            location,
            body,
        }
    }

    /// Checks that this is a problem document with this status and kind.
    pub(crate) fn assert_problem(&self, status: StatusCode, kind: &str) {
        assert_eq!(self.status, status, "{:#}", self.body);
        assert_eq!(self.content_type, "application/problem+json");
        assert_eq!(self.body["status"], status.as_u16());
        assert_eq!(self.body["type"], format!("urn:scree:problem:{kind}"));
        assert!(!self.body["title"].as_str().unwrap().is_empty());
        assert!(!self.body["detail"].as_str().unwrap().is_empty());
    }

    /// The fields of the body or the query that the problem's errors name.
    pub(crate) fn wrong_fields(&self) -> Vec<&str> {
        let errors = self.body["errors"]
            .as_array()
            .map(Vec::as_slice)
            .unwrap_or_default();
        let name = |error: &'_ Value| {
            ["pointer", "parameter"]
                .into_iter()
                .find(|key| error.get(key).is_some())
        };
        errors
            .iter()
            .filter_map(|error| error[name(error)?].as_str())
            .collect()
    }
}

/// One worker with one thread; results are written at once.
pub(crate) fn config(directory: &TempDir) -> ServiceConfig {
    let mut config = ServiceConfig {
        listen: "127.0.0.1:0".parse().unwrap(),
        database: database(directory).into(),
        ..ServiceConfig::default()
    };
    config.workers.count = Some(1);
    config.workers.threads_per_worker = Some(1);
    config.recording.flush_interval_s = 0.01;
    config
}

pub(crate) fn database(directory: &TempDir) -> PathBuf {
    directory.path().join("scree.db")
}

pub(crate) fn has_ended(job: &Value) -> bool {
    !is_one_of(job, &["accepted", "running"])
}

pub(crate) fn is_running(job: &Value) -> bool {
    is_one_of(job, &["running"])
}

fn is_one_of(job: &Value, words: &[&str]) -> bool {
    words.contains(&job["status"].as_str().unwrap())
}

/// A cube on a slope with a little flow behind it: computed very fast. Two
/// bodies would only make it slower.
pub(crate) fn tiny_scene() -> Value {
    json!({
        "title": "tiny",
        "channel": {"inclination_deg": 30, "incline_length_m": 0.4, "runout_length_m": 0.4,
                    "width_m": 0.1},
        "flow": {"volume_m3": 0.0003, "release": {"height_m": 0.04, "toe_distance_m": 0.05}},
        "bodies": [{"shape": {"cube": {"side_m": 0.04}}}],
        "duration_s": 0.05,
        "sample_interval_s": 0.01,
        "flow_snapshots": 3,
        "numerics": {"cell_size_m": 0.02, "points_per_cell": 4}
    })
}

/// The same, but long enough to be interrupted a few times, with records of
/// more than one chunk.
pub(crate) fn long_scene() -> Value {
    let mut scene = tiny_scene();
    scene["title"] = json!("long");
    scene["duration_s"] = json!(9.0);
    scene["numerics"]["ending"] = json!("full");
    scene["sample_interval_s"] = json!(0.004);
    scene["flow_snapshots"] = json!(8);
    scene
}

/// The same, but it runs until it is stopped.
pub(crate) fn endless_scene() -> Value {
    let mut scene = tiny_scene();
    scene["title"] = json!("endless");
    scene["duration_s"] = json!(600.0);
    scene["numerics"]["ending"] = json!("full");
    scene
}
