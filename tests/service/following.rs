//! Following jobs: ETags, waiting, events; and health, metrics and start page of the service.

use crate::app::{Answer, TestApp, endless_scene, is_running, tiny_scene};
use reqwest::{Response, StatusCode};
use serde_json::Value;
use std::time::{Duration, Instant};

async fn ask_with_tag(app: &TestApp, path: &str, tag: &str) -> Response {
    let request = app.client.get(app.url(path)).header("if-none-match", tag);
    request.send().await.unwrap()
}

#[tokio::test(flavor = "multi_thread")]
async fn what_a_client_has_is_not_sent_again() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    for path in [job.clone(), format!("{job}/flow"), "/v1/jobs".to_owned()] {
        let first = app.client.get(app.url(&path)).send().await.unwrap();
        let tag = first.headers()["etag"].to_str().unwrap().to_owned();
        let again = ask_with_tag(&app, &path, &tag).await;
        assert_eq!(again.status(), StatusCode::NOT_MODIFIED, "{path}");
        assert_eq!(again.headers()["etag"], tag.as_str());
        assert_eq!(again.text().await.unwrap(), "");
        let other = ask_with_tag(&app, &path, "\"other\"").await;
        assert_eq!(other.status(), StatusCode::OK, "{path}");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_look_can_wait_for_the_end() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    let answer = app.get(&format!("{job}?wait=60s")).await;
    assert_eq!(answer.body["status"], "successful");
    let job = app.submit(&endless_scene()).await;
    let began = Instant::now();
    let answer = app.get(&format!("{job}?wait=1s")).await;
    assert!(began.elapsed().as_secs_f64() >= 1.0);
    assert_ne!(answer.body["status"], "successful");
    for wait in ["30", "61s", "-1s", "1.5s", "s", "1m"] {
        let answer = app.get(&format!("{job}?wait={wait}")).await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
        let allowed = answer.body["errors"][0]["allowed"].as_str().unwrap();
        assert_eq!(
            allowed.ends_with("did you mean 30s?"),
            wait == "30",
            "{wait}: {allowed}"
        );
    }
    app.delete(&job).await;
    app.stop().await;
}

/// The text of the stream up to its end.
async fn events(app: &TestApp, query: &str, after: Option<&str>) -> (StatusCode, String) {
    let mut request = app.client.get(app.url(&format!("/v1/events{query}")));
    if let Some(after) = after {
        request = request.header("last-event-id", after);
    }
    let response = request.send().await.unwrap();
    (response.status(), response.text().await.unwrap())
}

fn statuses(text: &str) -> Vec<&str> {
    let data = text.lines().filter_map(|line| line.strip_prefix("data: "));
    data.filter_map(|data| data.split("\"status\":\"").nth(1)?.split('"').next())
        .collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn events_come_in_order_and_again_for_who_was_away() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    let (status, text) = events(&app, &query, None).await;
    assert_eq!(status, StatusCode::OK);
    assert_eq!(statuses(&text), ["accepted", "running", "successful"]);
    let ids: Vec<&str> = text
        .lines()
        .filter_map(|line| line.strip_prefix("id: "))
        .collect();
    let (_, rest) = events(&app, &query, Some(ids[0])).await;
    assert_eq!(statuses(&rest), ["running", "successful"]);
    let (status, _) = events(&app, &query, Some(ids[2])).await;
    assert_eq!(status, StatusCode::NO_CONTENT, "nothing will come any more");
    let (status, _) = events(&app, "?job=01890a5d-ac96-774b-bcce-b302099a8057", None).await;
    assert_eq!(status, StatusCode::NOT_FOUND);
    let (status, _) = events(&app, "?job=1&after=x&spam=1", None).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
    app.stop().await;
}

// A database restored from a backup has fewer events than its clients have seen.
#[tokio::test(flavor = "multi_thread")]
async fn a_client_of_another_past_is_told_so_and_hears_everything_again() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    let reset = "id: 0\nevent: reset\ndata: {\"after\":999,\"last\":3}\n\n";
    let (status, text) = events(&app, &query, Some("999")).await;
    assert_eq!(status, StatusCode::OK);
    assert!(text.starts_with(reset), "{text}");
    assert_eq!(statuses(&text), ["accepted", "running", "successful"]);
    let (_, again) = events(&app, &format!("{query}&after=999"), None).await;
    assert_eq!(again, text);

    let url = app.url("/v1/events?after=999");
    let response = app.client.get(url).send().await.unwrap();
    let (all, directory) = tokio::join!(response.text(), app.stop());
    assert_eq!(all.unwrap(), text, "the stream of all jobs");

    // A removed job's events don't make the client's number invalid.
    let app = TestApp::start_in(directory, |_| {}).await;
    app.delete(&format!("{job}?remove=ended")).await;
    let job = app.submit(&tiny_scene()).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    let (_, text) = events(&app, &query, Some("3")).await;
    assert_eq!(statuses(&text), ["accepted", "running", "successful"]);
    assert!(!text.contains("reset"), "{text}");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn of_a_removed_job_only_the_removal_is_told() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    app.delete(&format!("{job}?remove=ended")).await;
    let url = app.url("/v1/events?after=0");
    let response = app.client.get(url).send().await.unwrap();
    let (text, _directory) = tokio::join!(response.text(), app.stop());
    let id = job.rsplit('/').next().unwrap();
    let removed = format!("id: 4\nevent: removed\ndata: {{\"id\":\"{id}\",\"attempt\":1}}\n\n");
    assert_eq!(text.unwrap(), removed);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_follower_of_a_job_that_is_dismissed_and_removed_at_once_learns_of_its_end() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    app.wait(&job, is_running).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    let (stream, ()) = tokio::join!(events(&app, &query, None), async {
        tokio::time::sleep(Duration::from_millis(200)).await;
        app.delete(&job).await;
        app.delete(&format!("{job}?remove=ended")).await;
    });
    // Whether it was dismissed or is removed, as it saw first.
    let learned = ["event: removed\n", "\"status\":\"dismissed\""];
    let text = stream.1;
    assert!(learned.iter().any(|end| text.contains(end)), "{text}");
    let (_, again) = events(&app, &query, Some("1")).await;
    assert!(again.contains("event: removed\n"), "{again}");
    let (status, _) = events(&app, &query, Some("4")).await;
    assert_eq!(status, StatusCode::NOT_FOUND);
    app.stop().await;
}

// All jobs in one stream: a page that lists jobs needs no other.
#[tokio::test(flavor = "multi_thread")]
async fn the_stream_of_all_jobs_tells_progress_if_asked() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    app.wait(&job, is_running).await;
    let streams = ["?progress=true", "?progress=false", ""];
    let [told, silent, unasked] = streams.map(|query| app.url(&format!("/v1/events{query}")));
    let (status, _) = events(&app, "?progress=1", None).await;
    assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
    let client = app.client.clone();
    let read = async |url: String| client.get(url).send().await.unwrap().text().await;
    let (told, silent, unasked, _directory) =
        tokio::join!(read(told), read(silent), read(unasked), async {
            tokio::time::sleep(Duration::from_millis(2500)).await;
            app.delete(&job).await;
            // A service that stops tells no more than it has told.
            tokio::time::sleep(Duration::from_secs(1)).await;
            app.stop().await
        });
    let told = told.unwrap();
    let id = job.rsplit('/').next().unwrap();
    let progress = format!("event: progress\ndata: {{\"id\":\"{id}\",\"progress\":{{");
    assert!(told.matches(&progress).count() >= 1, "{told}");
    assert!(told.contains("\"status\":\"dismissed\""), "{told}");
    for without in [silent, unasked] {
        let without = without.unwrap();
        assert!(!without.contains("progress"), "{without}");
        assert!(without.contains("\"status\":\"dismissed\""), "{without}");
    }
}

// The fraction grows, and no number is used up by it.
#[tokio::test(flavor = "multi_thread")]
async fn the_progress_of_a_running_job_is_told_every_second() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    let (stream, ()) = tokio::join!(events(&app, &query, None), async {
        tokio::time::sleep(Duration::from_millis(3500)).await;
        app.delete(&job).await;
    });
    let told: Vec<&str> = stream.1.split("\n\n").collect();
    let progress = told
        .iter()
        .filter(|event| event.contains("event: progress"));
    let fractions = progress.map(|event| {
        assert!(!event.contains("id: "), "{event}");
        let data = event.lines().find_map(|line| line.strip_prefix("data: "));
        let data: Value = serde_json::from_str(data.unwrap()).unwrap();
        assert!(job.ends_with(data["id"].as_str().unwrap()));
        data["progress"]["fraction"].as_f64().unwrap()
    });
    let fractions: Vec<f64> = fractions.collect();
    assert!(fractions.len() >= 2, "{}", stream.1);
    assert!(fractions.is_sorted() && fractions[0] < 1.0, "{fractions:?}");
    assert_eq!(statuses(&stream.1), ["accepted", "running", "dismissed"]);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn after_and_last_event_id_take_the_same_numbers() {
    let app = TestApp::start().await;
    for number in ["-1", "x", "1.5", "9223372036854775808", ""] {
        let mut refused = Vec::new();
        for (query, header, name) in [
            (format!("?after={number}"), None, "after"),
            (String::new(), Some(number), "Last-Event-ID"),
        ] {
            let mut request = app.client.get(app.url(&format!("/v1/events{query}")));
            if let Some(number) = header {
                request = request.header("last-event-id", number);
            }
            let answer = Answer::read(request.send().await.unwrap()).await;
            answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
            assert_eq!(answer.wrong_fields(), [name]);
            let error = &answer.body["errors"][0];
            refused.push((error["value"].clone(), error["allowed"].clone()));
        }
        assert_eq!(refused[0], refused[1], "{number}");
    }
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let query = format!("?job={}", job.rsplit('/').next().unwrap());
    for number in ["4294967296", "9223372036854775807"] {
        let (status, text) = events(&app, &format!("{query}&after={number}"), None).await;
        assert_eq!(status, StatusCode::OK, "{text}");
        let header = events(&app, &query, Some(number)).await;
        assert_eq!(header, (status, text));
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn the_stream_of_all_jobs_ends_with_the_service() {
    let app = TestApp::start().await;
    let job = app.submit(&endless_scene()).await;
    app.wait(&job, is_running).await;
    let response = app
        .client
        .get(app.url("/v1/events?after=0"))
        .send()
        .await
        .unwrap();
    let began = Instant::now();
    let (text, directory) = tokio::join!(response.text(), app.stop());
    // Far below the five seconds that requests in progress may take.
    assert!(began.elapsed().as_secs_f64() < 4.0, "{:?}", began.elapsed());
    let text = text.unwrap();
    assert_eq!(statuses(&text)[..2], ["accepted", "running"], "{text}");
    drop(directory);
}

#[tokio::test(flavor = "multi_thread")]
async fn the_service_tells_of_itself() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    assert_eq!(app.get("/readyz").await.body["status"], "ok");
    let metrics = app.get("/metrics").await;
    assert!(
        metrics
            .content_type
            .starts_with("application/openmetrics-text")
    );
    let text = metrics.body.as_str().unwrap();
    for line in [
        "scree_jobs{status=\"successful\"} 1",
        "scree_jobs{status=\"running\"} 0",
        "scree_attempts_ended_total{ending=\"successful\"} 1",
        "scree_oldest_waiting_seconds 0.0",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    let page = app.client.get(app.url("/")).send().await.unwrap();
    let request_id = page.headers()["x-request-id"].to_str().unwrap().to_owned();
    assert_eq!(request_id.len(), 36);
    let page = page.text().await.unwrap();
    assert!(page.contains("assets/app.js"), "{page}");
    // The page must also work without internet access.
    assert!(
        !page.contains("http://") && !page.contains("https://"),
        "{page}"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn an_answer_says_what_it_comes_from() {
    let app = TestApp::start().await;
    let path = app.submit(&tiny_scene()).await;
    let job = app.wait_for_success(&path).await;
    let provenance = &job["provenance"];
    let scenario = app
        .client
        .get(app.url(&path))
        .send()
        .await
        .unwrap()
        .text()
        .await
        .unwrap();
    let start = scenario.find("\"scenario\":").unwrap() + "\"scenario\":".len();
    let end = scenario.find(",\"plan\":").unwrap();
    let hash = blake3::hash(&scenario.as_bytes()[start..end])
        .to_hex()
        .to_string();
    assert_eq!(
        provenance["scenario_hash"], hash,
        "of the scenario as it is shown"
    );
    assert_eq!(provenance["solver_version"], scree_solver::VERSION);
    assert_eq!(provenance["solver_commit"], scree::runs::COMMIT);
    let instructions = scree_solver::Instructions::detected().to_string();
    assert_eq!(provenance["instructions"], instructions);
    assert_eq!(provenance["threads"], 1);
    assert_eq!(provenance["fingerprint"].as_str().unwrap().len(), 64);
    let again = app.submit(&tiny_scene()).await;
    let again = app.wait_for_success(&again).await;
    assert_eq!(again["provenance"], *provenance, "the same again");
    app.stop().await;
}
