//! Terrains: uploaded, read, listed and removed.

use crate::access::with_tokens;
use crate::app::{Answer, TestApp, database, has_ended};
use crate::overload::status_line;
use reqwest::{Method, StatusCode};
use scree::jobs::job::JobId;
use scree::jobs::store::sqlite::SqliteStore;
use scree::jobs::store::{JobStore, Room, Submission, Submitted};
use scree::jobs::submit::NewJob;
use scree::terrains::TerrainHash;
use serde_json::{Value, json};
use std::path::Path;
use tokio::io::AsyncWriteExt;
use tokio::net::TcpStream;

const TERRAINS: &str = "/v1/terrains";

/// A slope that falls by 5 m a cell to the east, with this height in its south-western corner, in the
/// form of an ESRI ASCII grid.
fn slope(corner: f64) -> String {
    let row = |corner: f64| format!("{corner} {} {} {}\n", 95.0, 90.0, 85.0);
    format!(
        "ncols 4\nnrows 3\nxllcorner 600000\nyllcorner 200000\ncellsize 10\n{}{}{}",
        row(100.0),
        row(100.0),
        row(corner)
    )
}

async fn put(app: &TestApp, file: &str) -> Answer {
    app.post_to(TERRAINS, "text/plain", file.to_owned()).await
}

/// Path of a terrain, after its upload.
async fn uploaded(app: &TestApp, file: &str) -> String {
    let answer = put(app, file).await;
    assert_eq!(answer.status, StatusCode::CREATED, "{:#}", answer.body);
    answer.location.unwrap()
}

/// A request of the holder of a token.
async fn ask(app: &TestApp, who: &str, method: Method, (path, file): (&str, &str)) -> Answer {
    let request = app.client.request(method, app.url(path));
    let request = request.header("authorization", format!("Bearer {who}'s secret"));
    let request = request.header("content-type", "application/octet-stream");
    Answer::read(request.body(file.to_owned()).send().await.unwrap()).await
}

#[tokio::test(flavor = "multi_thread")]
async fn a_terrain_is_kept_once_and_outlives_a_restart() {
    let app = TestApp::start().await;
    let file = slope(100.0);
    let first = put(&app, &file).await;
    assert_eq!(first.status, StatusCode::CREATED, "{:#}", first.body);
    let hash = TerrainHash::of(file.as_bytes()).to_string();
    let path = format!("{TERRAINS}/{hash}");
    assert_eq!(first.location.as_deref(), Some(path.as_str()));
    for (key, value) in [
        ("hash", json!(hash)),
        ("bytes", json!(file.len())),
        ("purpose", json!("height-map")),
        ("format", json!("esri-ascii-grid")),
        ("columns", json!(4)),
        ("rows", json!(3)),
        ("cell_size_m", json!(10.0)),
        ("west_m", json!(600_000.0)),
        ("south_m", json!(200_000.0)),
        ("epsg", Value::Null),
        ("holes", json!(0)),
        ("lowest_m", json!(85.0)),
        ("highest_m", json!(100.0)),
    ] {
        assert_eq!(first.body[key], value, "{key}");
    }
    let slope_deg = first.body["mean_slope_deg"].as_f64().unwrap();
    assert!((slope_deg - 0.5_f64.atan().to_degrees()).abs() < 1e-9);

    let again = app
        .post_to(TERRAINS, "application/octet-stream", file.clone())
        .await;
    assert_eq!(again.status, StatusCode::OK);
    assert_eq!(
        (&again.body, &again.location),
        (&first.body, &first.location)
    );

    let app = TestApp::start_in(app.stop().await, |_| {}).await;
    assert_eq!(app.get(&path).await.body, first.body);
    let response = app.client.get(app.url(&format!("{path}/file")));
    let response = response.send().await.unwrap();
    assert_eq!(response.headers()["content-type"], "text/plain");
    assert_eq!(response.headers()["content-length"], file.len().to_string());
    let tag = response.headers()["etag"].clone();
    assert_eq!(response.text().await.unwrap(), file);
    let unchanged = app.client.get(app.url(&format!("{path}/file")));
    let unchanged = unchanged.header("if-none-match", tag).send().await.unwrap();
    assert_eq!(unchanged.status(), StatusCode::NOT_MODIFIED);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_large_file_comes_back_byte_for_byte() {
    let app = TestApp::start().await;
    // Several pieces of the store, the last of them short.
    let header = "ncols 1000\nnrows 700\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    let rows: String = (0..700)
        .map(|row| format!("{row}.5 ").repeat(1000) + "\n")
        .collect();
    let file = format!("{header}{rows}");
    assert!(file.len() > 3 << 20);
    let path = uploaded(&app, &file).await;
    let response = app.client.get(app.url(&format!("{path}/file")));
    let bytes = response.send().await.unwrap().bytes().await.unwrap();
    assert!(bytes == file.as_bytes());
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_file_that_is_no_raster_is_refused_with_the_cell_at_fault() {
    let app = TestApp::start().await;
    let refused = put(&app, &slope(12_345.0)).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-terrain");
    let errors = refused.body["errors"].as_array().unwrap();
    assert_eq!(errors.len(), 1);
    assert_eq!(errors[0]["pointer"], "");
    assert_eq!(errors[0]["value"], 12_345.0);
    assert_eq!(errors[0]["allowed"], "-500 <= x <= 9000");
    assert_eq!(errors[0]["unit"], "m");
    let detail = errors[0]["detail"].as_str().unwrap();
    assert!(detail.contains("row 2 and column 0"), "{detail}");

    let short = slope(100.0).replace("85", "");
    for (kind, file) in [
        ("text/plain", String::new()),
        ("text/plain", "{\"title\": \"a scenario\"}".to_owned()),
        ("text/plain", short),
        ("text/plain", slope(100.0).replace("95", "ninety")),
        ("text/plain", slope(f64::NAN)),
        ("image/tiff", "II*\0 and then no TIFF".to_owned()),
    ] {
        let refused = app.post_to(TERRAINS, kind, file.clone()).await;
        refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-terrain");
        assert_eq!(refused.wrong_fields(), [""], "{file}");
    }
    let refused = app
        .post_to(TERRAINS, "application/json", slope(100.0))
        .await;
    refused.assert_problem(StatusCode::UNSUPPORTED_MEDIA_TYPE, "unsupported-media-type");
    let named = format!("{TERRAINS}?purpose=heights");
    let refused = app.post_to(&named, "text/plain", slope(100.0)).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    assert_eq!(app.get(TERRAINS).await.body["terrains"], json!([]));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_allowed_depends_on_the_purpose() {
    let app = TestApp::start().await;
    let as_thickness = format!("{TERRAINS}?purpose=thickness");
    let below_zero = slope(-1.0);
    let refused = app
        .post_to(&as_thickness, "text/plain", below_zero.clone())
        .await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-terrain");
    let path = uploaded(&app, &below_zero).await;
    // It is kept, and yet no thickness.
    let refused = app.post_to(&as_thickness, "text/plain", below_zero).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-terrain");
    assert_eq!(app.get(&path).await.body["purpose"], "height-map");
    let thick = app.post_to(&as_thickness, "text/plain", slope(90.0)).await;
    assert_eq!(thick.status, StatusCode::CREATED, "{:#}", thick.body);
    assert_eq!(thick.body["purpose"], "thickness");
    assert_eq!(thick.body["mean_slope_deg"], Value::Null);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn terrains_are_listed_newest_first_and_removed() {
    let app = TestApp::start().await;
    let mut hashes = Vec::new();
    for corner in [97.0, 98.0, 99.0] {
        let path = uploaded(&app, &slope(corner)).await;
        hashes.insert(0, path.rsplit('/').next().unwrap().to_owned());
    }
    let names = |page: &Value| -> Vec<String> {
        let terrains = page["terrains"].as_array().unwrap();
        let hash = |terrain: &Value| terrain["hash"].as_str().unwrap().to_owned();
        terrains.iter().map(hash).collect()
    };
    let first = app.get(&format!("{TERRAINS}?limit=2")).await.body;
    assert_eq!(names(&first), hashes[..2]);
    let cursor = first["next_cursor"].as_str().unwrap();
    let rest = app
        .get(&format!("{TERRAINS}?limit=2&cursor={cursor}"))
        .await;
    assert_eq!(names(&rest.body), hashes[2..]);
    assert_eq!(rest.body["next_cursor"], Value::Null);

    let path = format!("{TERRAINS}/{}", hashes[1]);
    assert_eq!(app.delete(&path).await.status, StatusCode::NO_CONTENT);
    for gone in [
        &path,
        &format!("{path}/file"),
        &format!("{TERRAINS}/alps.tif"),
    ] {
        app.get(gone)
            .await
            .assert_problem(StatusCode::NOT_FOUND, "unknown-terrain");
    }
    app.delete(&path)
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-terrain");
    let left = app.get(TERRAINS).await.body;
    assert_eq!(names(&left), [hashes[0].clone(), hashes[2].clone()]);
    app.stop().await;
}

/// A job that names this terrain, put into the database beside the service.
async fn job_on(database: &Path, terrain: TerrainHash) -> JobId {
    let store = SqliteStore::open(database).await.unwrap();
    let job = NewJob {
        id: JobId::new(),
        title: "on a terrain".to_owned(),
        bodies: 0,
        scenario: "{}".to_owned(),
        scenario_hash: "0".repeat(64),
        plan: "{}".to_owned(),
        planned_work: 1,
        planned_memory_bytes: 1,
        labels: Vec::new(),
        terrains: vec![terrain],
        solver_version: "1",
    };
    let submission = Submission {
        jobs: std::slice::from_ref(&job),
        submitter: None,
        key: None,
        room: Room {
            queue: 1,
            submitter: None,
        },
    };
    let submitted = JobStore::submit(&store, &submission).await.unwrap();
    assert_eq!(submitted, Submitted::Accepted);
    JobStore::close(&store).await;
    job.id
}

#[tokio::test(flavor = "multi_thread")]
async fn a_terrain_stays_as_long_as_a_job_names_it() {
    let app = TestApp::start().await;
    let file = slope(100.0);
    let path = uploaded(&app, &file).await;
    let directory = app.stop().await;
    let job = job_on(&database(&directory), TerrainHash::of(file.as_bytes())).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    // Its scenario is none.
    let job = format!("/v1/jobs/{job}");
    app.wait(&job, has_ended).await;
    let refused = app.delete(&path).await;
    refused.assert_problem(StatusCode::CONFLICT, "terrain-in-use");
    let removed = app.delete(&format!("{job}?remove=ended")).await;
    assert_eq!(removed.status, StatusCode::NO_CONTENT);
    assert_eq!(app.delete(&path).await.status, StatusCode::NO_CONTENT);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_file_is_refused_while_it_arrives_once_it_is_too_large() {
    let file = slope(100.0);
    let most = file.len();
    let app = TestApp::start_with(|config| config.limits.terrain_file_bytes = most).await;
    uploaded(&app, &file).await;
    let larger = format!("{file}\n");
    let refused = put(&app, &larger).await;
    refused.assert_problem(StatusCode::PAYLOAD_TOO_LARGE, "too-large");
    assert!(
        refused.body["detail"]
            .as_str()
            .unwrap()
            .contains("limits.terrain_file_bytes")
    );
    // Without an announced length, and before its end: the client sends no more.
    let mut stream = TcpStream::connect(app.address()).await.unwrap();
    let head = format!(
        "POST {TERRAINS} HTTP/1.1\r\nHost: {}\r\nContent-Type: text/plain\r\n\
         Transfer-Encoding: chunked\r\n\r\n{:x}\r\n{larger}\r\n",
        app.address(),
        larger.len()
    );
    stream.write_all(head.as_bytes()).await.unwrap();
    assert!(status_line(&mut stream).await.contains(" 413 "));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_raster_of_too_many_cells_is_refused() {
    let app = TestApp::start_with(|config| config.limits.terrain_cells = 11).await;
    let refused = put(&app, &slope(100.0)).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-terrain");
    let error = &refused.body["errors"][0];
    assert_eq!(error["value"], 12);
    assert_eq!(error["allowed"], "x <= 11");
    assert_eq!(error["unit"], "cells");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn slow_uploads_are_cut_and_leave_room_for_other_callers() {
    let app = TestApp::start_with(|config| {
        with_tokens(config);
        config.limits.terrain_uploads = 2;
        config.limits.terrain_read_timeout_s = 2.0;
    })
    .await;
    let mut slow = TcpStream::connect(app.address()).await.unwrap();
    let head = format!(
        "POST {TERRAINS} HTTP/1.1\r\nHost: {}\r\nContent-Type: text/plain\r\n\
         Authorization: Bearer ann's secret\r\nContent-Length: 1000\r\n\
         Expect: 100-continue\r\n\r\n",
        app.address()
    );
    slow.write_all(head.as_bytes()).await.unwrap();
    // Its file is waited for.
    assert!(status_line(&mut slow).await.contains(" 100 "));
    assert_eq!(status_line(&mut slow).await, "\r\n");
    slow.write_all(b"ncols").await.unwrap();
    let file = slope(100.0);
    let upload = async |who: &str| ask(&app, who, Method::POST, (TERRAINS, &file)).await;
    let refused = upload("ann").await;
    refused.assert_problem(StatusCode::TOO_MANY_REQUESTS, "uploads-spent");
    assert!(upload("ben").await.status.is_success());
    assert!(status_line(&mut slow).await.contains(" 408 "));
    assert_eq!(
        upload("ann").await.status,
        StatusCode::OK,
        "there is room again"
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_is_good_for_its_scopes_and_its_own_terrains() {
    let app = TestApp::start_with(with_tokens).await;
    let file = slope(100.0);
    let upload = async |who: &str| ask(&app, who, Method::POST, (TERRAINS, &file)).await;
    let refused = upload("eve").await;
    refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    let first = upload("ann").await;
    assert_eq!(first.status, StatusCode::CREATED, "{:#}", first.body);
    assert_eq!(first.body["submitter"], "ann");
    assert_eq!(upload("sue").await.body, first.body);
    let path = first.location.unwrap();
    let file_path = format!("{path}/file");
    for path in [&path, &file_path] {
        for who in ["eve", "sue"] {
            let read = ask(&app, who, Method::GET, (path, "")).await;
            assert_eq!(read.status, StatusCode::OK, "{who} {path}");
        }
        let none = app.get(path).await;
        none.assert_problem(StatusCode::UNAUTHORIZED, "no-token");
    }
    let list = ask(&app, "sue", Method::GET, (TERRAINS, "")).await;
    list.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    for who in ["eve", "ben"] {
        let refused = ask(&app, who, Method::DELETE, (&path, "")).await;
        refused.assert_problem(StatusCode::FORBIDDEN, "not-allowed");
    }
    let removed = ask(&app, "ann", Method::DELETE, (&path, "")).await;
    assert_eq!(removed.status, StatusCode::NO_CONTENT);
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_database_takes_no_terrain() {
    let app = TestApp::start_with(|config| config.limits.database_bytes = Some(1 << 20)).await;
    let row = "100 ".repeat(600) + "\n";
    let header = "ncols 600\nnrows 600\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    let refused = put(&app, &format!("{header}{}", row.repeat(600))).await;
    refused.assert_problem(StatusCode::INSUFFICIENT_STORAGE, "storage-full");
    assert_eq!(app.get(TERRAINS).await.body["terrains"], json!([]));
    let path = uploaded(&app, &slope(100.0)).await;
    assert_eq!(app.delete(&path).await.status, StatusCode::NO_CONTENT);
    app.stop().await;
}
