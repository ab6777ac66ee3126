//! Trajectories and snapshots of the flow.

use crate::app::{TestApp, endless_scene, is_running, tiny_scene};
use flate2::read::DeflateDecoder;
use reqwest::StatusCode;
use serde_json::{Value, json};
use sqlx::Connection;
use std::io::Read;

const COLUMNS: [&str; 14] = [
    "angular_velocity_rad_s",
    "body_force_n",
    "body_torque_nm",
    "flow_force_n",
    "flow_torque_nm",
    "mode",
    "orientation",
    "position_m",
    "submerged_fraction",
    "time_s",
    "touching_points",
    "velocity_m_s",
    "wall_force_n",
    "wall_torque_nm",
];

fn times(trajectory: &Value) -> Vec<f64> {
    let times = trajectory["columns"]["time_s"].as_array().unwrap();
    times.iter().map(|time| time.as_f64().unwrap()).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_trajectory_has_all_columns_at_the_sample_times() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    let outcome = app.wait_for_success(&job).await["outcome"].take();
    let answer = app.get(&format!("{job}/trajectory")).await;
    assert_eq!(answer.status, StatusCode::OK);
    let trajectory = answer.body;
    assert_eq!(
        format!("/v1/jobs/{}", trajectory["job_id"].as_str().unwrap()),
        job
    );
    assert_eq!(trajectory["body"], 0);
    // k · 0.01 s to the end at 0.05 s, both included.
    let expected: Vec<f64> = (0..=5).map(|k| f64::from(k) * 0.01).collect();
    assert_eq!(times(&trajectory), expected);
    let columns = trajectory["columns"].as_object().unwrap();
    let mut names: Vec<&str> = columns.keys().map(String::as_str).collect();
    names.sort_unstable();
    assert_eq!(names, COLUMNS);
    assert!(
        columns
            .values()
            .all(|column| column.as_array().unwrap().len() == 6)
    );
    // The cube begins where the scenario places it: its side downstream of the
    // foot, on the centre line, half its side above the floor, minus the few
    // micrometres of penetration under its weight.
    let start = &columns["position_m"][0];
    assert_eq!((&start[0], &start[1]), (&json!(0.04), &json!(0.0)));
    assert!(
        (0.0..1e-5).contains(&(0.02 - start[2].as_f64().unwrap())),
        "{start}"
    );
    assert_eq!(columns["velocity_m_s"][0], json!([0.0, 0.0, 0.0]));
    assert_eq!(columns["mode"][0], "resting");
    assert_eq!(
        columns["position_m"][5],
        outcome["bodies"][0]["final_position_m"]
    );
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn ranges_include_both_ends_and_strides_count_from_the_first() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["sample_interval_s"] = json!(0.001);
    // The body comes to rest at once.
    scene["numerics"]["ending"] = json!("full");
    scene["flow"] = Value::Null;
    // More samples than one stored chunk holds (512).
    scene["duration_s"] = json!(1.2);
    scene["numerics"]["ending"] = json!("full");
    let job = app.submit(&scene).await;
    app.wait_for_success(&job).await;
    let ask = async |query: &str| {
        let answer = app.get(&format!("{job}/trajectory?{query}")).await;
        assert_eq!(answer.status, StatusCode::OK, "{:#}", answer.body);
        times(&answer.body)
    };
    let at = |indices: &[u32]| -> Vec<f64> {
        indices
            .iter()
            .map(|&index| f64::from(index) * 0.001)
            .collect()
    };
    assert_eq!(ask("").await.len(), 1201);
    assert_eq!(ask("from_s=0.007&to_s=0.009").await, at(&[7, 8, 9]));
    assert_eq!(ask("to_s=0.002").await, at(&[0, 1, 2]));
    assert_eq!(ask("from_s=1.199").await, at(&[1199, 1200]));
    assert_eq!(
        ask("from_s=0.003&to_s=0.012&stride=4").await,
        at(&[3, 7, 11])
    );
    assert_eq!(
        ask("from_s=0.5105&to_s=0.5145&stride=1").await,
        at(&[511, 512, 513, 514])
    );
    assert_eq!(ask("stride=600").await, at(&[0, 600, 1200]));
    assert_eq!(ask("from_s=5").await, at(&[]));
    assert_eq!(ask("from_s=-1&to_s=0").await, at(&[0]));
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_job_can_be_read_before_and_while_it_runs() {
    let app = TestApp::start().await;
    let running = app.submit(&endless_scene()).await;
    app.wait(&running, is_running).await;
    let waiting = app.submit(&tiny_scene()).await;

    let empty = app.get(&format!("{waiting}/trajectory")).await;
    assert_eq!(empty.status, StatusCode::OK);
    let columns = empty.body["columns"].as_object().unwrap();
    assert_eq!(columns.len(), COLUMNS.len());
    assert!(columns.values().all(|column| column == &json!([])));
    app.get(&format!("{waiting}/flow"))
        .await
        .assert_problem(StatusCode::NOT_FOUND, "no-snapshot");

    app.wait_for_samples(&running).await;
    let job = app
        .wait(&running, |job| job["progress"]["steps"].as_u64() > Some(0))
        .await;
    assert_eq!(job["status"], "running");
    assert!(job["progress"]["fraction"].as_f64().unwrap() > 0.0);
    assert!(job["progress"]["eta_s"].as_f64().unwrap() > 0.0);
    assert!(job["progress"]["point_steps_per_s"].as_f64().unwrap() > 0.0);
    app.delete(&running).await;
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn bad_questions_are_answered_with_what_is_wrong_in_them() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    for (path, wrong) in [
        ("trajectory?body=-1", &["body"][..]),
        ("trajectory?body=one", &["body"]),
        ("trajectory?from_s=soon", &["from_s"]),
        ("trajectory?to_s=NaN", &["to_s"]),
        ("trajectory?from_s=inf", &["from_s"]),
        ("trajectory?from_s=2&to_s=1", &["to_s"]),
        ("trajectory?stride=0", &["stride"]),
        ("trajectory?stride=1.5", &["stride"]),
        ("trajectory?stride=1&stride=2", &["stride"]),
        ("trajectory?format=xml", &["format"]),
        ("trajectory?fields=speed", &["fields"]),
        ("trajectory?fields=mode,time_s,mode", &["fields"]),
        (
            "trajectory?stride=0&from_s=x&spam=1",
            &["from_s", "stride", "spam"],
        ),
        ("flow?time_s=noon", &["time_s"]),
        ("flow?when=0", &["when"]),
    ] {
        let answer = app.get(&format!("{job}/{path}")).await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
        assert_eq!(answer.wrong_fields(), wrong, "{path}");
    }
    app.get(&format!("{job}/trajectory?body=1"))
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-body");
    app.stop().await;
}

async fn text(app: &TestApp, path: &str) -> (String, String) {
    let response = app.client.get(app.url(path)).send().await.unwrap();
    assert_eq!(response.status(), StatusCode::OK, "{path}");
    let kind = response.headers()["content-type"]
        .to_str()
        .unwrap()
        .to_owned();
    (kind, response.text().await.unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn a_trajectory_comes_in_every_form_with_the_same_numbers() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["flow"] = Value::Null;
    scene["duration_s"] = json!(0.7);
    scene["sample_interval_s"] = json!(0.001);
    // The body comes to rest at once.
    scene["numerics"]["ending"] = json!("full");
    let job = app.submit(&scene).await;
    app.wait_for_success(&job).await;
    let path = format!("{job}/trajectory?fields=time_s,position_m,mode&stride=3");
    let columns = app.get(&path).await.body["columns"].take();
    assert_eq!(columns.as_object().unwrap().len(), 3);
    assert_eq!(columns["time_s"].as_array().unwrap().len(), 234);

    let (kind, lines) = text(&app, &format!("{path}&format=ndjson")).await;
    assert_eq!(kind, "application/x-ndjson");
    for (row, line) in lines.lines().enumerate() {
        let sample: Value = serde_json::from_str(line).unwrap();
        for field in ["time_s", "position_m", "mode"] {
            assert_eq!(sample[field], columns[field][row], "{field} {row}");
        }
    }
    assert_eq!(lines.lines().count(), 234);

    let (kind, csv) = text(&app, &format!("{path}&format=csv")).await;
    assert_eq!(kind, "text/csv");
    let mut rows = csv.lines();
    let heading = "time_s,position_m_x,position_m_y,position_m_z,mode";
    assert_eq!(rows.next(), Some(heading));
    for (row, line) in rows.enumerate() {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap();
        assert_eq!(columns["time_s"][row], number(0));
        assert_eq!(
            columns["position_m"][row],
            json!([number(1), number(2), number(3)])
        );
        assert_eq!(columns["mode"][row], cells[4]);
    }
    let request = app
        .client
        .get(app.url(&path))
        .header("accept", "text/html, text/csv;q=0.9");
    assert_eq!(request.send().await.unwrap().text().await.unwrap(), csv);

    // Each format has a place of its own, too.
    let part = "fields=time_s&fields=position_m,mode&stride=3";
    for (format, expected) in [("csv", &csv), ("ndjson", &lines)] {
        let found = text(&app, &format!("{job}/trajectory.{format}?{part}")).await;
        assert_eq!(found.1, *expected, "{format}");
    }
    let npz = app.get(&format!("{job}/trajectory.npz?{part}")).await;
    assert_eq!(npz.content_type, "application/zip");
    let url = app.url(&format!("{job}/trajectory.npz"));
    let answer = app.client.get(url).send().await.unwrap();
    let id = job.rsplit('/').next().unwrap();
    let name = format!("attachment; filename=\"{id}-trajectory-0.npz\"");
    assert_eq!(answer.headers()["content-disposition"], name.as_str());
    assert_eq!(answer.headers()["cache-control"], "no-cache");
    let refused = app.get(&format!("{job}/trajectory.npz?format=csv")).await;
    refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    app.stop().await;
}

/// Names and contents of an archive's files, in the order of its directory.
fn files(archive: &[u8]) -> Vec<(String, Vec<u8>)> {
    let number = |place: usize, length: usize| -> usize {
        let bytes = archive[place..place + length].iter().rev();
        bytes.fold(0, |number, byte| number << 8 | usize::from(*byte))
    };
    let end = archive.len() - 22;
    assert_eq!(number(end, 4), 0x0605_4b50);
    let mut entry = number(end + 16, 4);
    let file = |_| {
        assert_eq!(number(entry, 4), 0x0201_4b50);
        let (packed, length) = (number(entry + 20, 4), number(entry + 24, 4));
        let (name_length, local) = (number(entry + 28, 2), number(entry + 42, 4));
        assert_eq!(number(local, 4), 0x0403_4b50);
        let name = archive[entry + 46..entry + 46 + name_length].to_vec();
        let start = local + 30 + name_length;
        let mut bytes = archive[start..start + packed].to_vec();
        if number(entry + 10, 2) == 8 {
            let mut inflated = Vec::new();
            let mut inflater = DeflateDecoder::new(bytes.as_slice());
            inflater.read_to_end(&mut inflated).unwrap();
            bytes = inflated;
        }
        assert_eq!(bytes.len(), length);
        entry += 46 + name_length;
        (String::from_utf8(name).unwrap(), bytes)
    };
    (0..number(end + 10, 2)).map(file).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn arrays_and_snapshots_come_as_archives() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let ask = async |path: &str| {
        let response = app.client.get(app.url(path)).send().await.unwrap();
        assert_eq!(response.headers()["content-type"], "application/zip");
        response.bytes().await.unwrap()
    };
    let path = format!("{job}/trajectory?fields=mode,time_s");
    let columns = app.get(&path).await.body["columns"].take();
    let archive = ask(&format!("{path}&format=npz&from_s=0.01")).await;
    let files_of_npz = files(&archive);
    let (name, array) = files_of_npz.last().unwrap();
    assert_eq!(name, "time_s.npy");
    // Magic and version, the length of the header, the header; then the numbers.
    let start = 10 + usize::from(u16::from_le_bytes([array[8], array[9]]));
    assert!(String::from_utf8_lossy(&array[10..start]).contains("'shape': (5,)"));
    let numbers = array[start..].chunks(8);
    let times: Vec<f64> = numbers
        .map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap()))
        .collect();
    assert_eq!(
        json!(times),
        json!(columns["time_s"].as_array().unwrap()[1..])
    );

    let files = files(&ask(&format!("{job}/flow.zip")).await);
    let names: Vec<_> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names[..2], ["flow.pvd", "channel.vtp"]);
    let last = ["instant-0002.vtm", "flow-0002.vtp", "bodies-0002.vtp"];
    assert_eq!((names.len(), &names[8..]), (11, &last[..]));
    for (name, text) in files.iter().filter(|(name, _)| !name.ends_with(".vtp")) {
        let text = std::str::from_utf8(text).unwrap();
        let document = roxmltree::Document::parse(text).unwrap();
        let named = document
            .descendants()
            .filter_map(|node| node.attribute("file"));
        let named: Vec<_> = named.collect();
        assert_eq!(named.len(), 3, "{name}");
        assert!(
            named.iter().all(|file| names.contains(file)),
            "{name}: {named:?}"
        );
    }
    // .ci/read-results.py reads all of it with VTK.
    let flow = app.get(&format!("{job}/flow")).await.body;
    let speeds: Vec<f32> = serde_json::from_value(flow["speed_m_s"].clone()).unwrap();
    let speeds: Vec<u8> = speeds
        .iter()
        .flat_map(|speed| speed.to_le_bytes())
        .collect();
    let mut places = files[9].1.windows(speeds.len());
    assert!(places.any(|bytes| bytes == speeds));
    app.get("/v1/jobs/x/flow.zip")
        .await
        .assert_problem(StatusCode::NOT_FOUND, "unknown-job");
    app.stop().await;
}

/// Damages what is stored of all jobs' trajectories and snapshots.
async fn damage(database: &std::path::Path) {
    let options = sqlx::sqlite::SqliteConnectOptions::new().filename(database);
    let mut connection = sqlx::SqliteConnection::connect_with(&options)
        .await
        .unwrap();
    for damage in [
        "UPDATE trajectory_chunks SET data = zeroblob(length(data))",
        "UPDATE flow_snapshots SET data = zeroblob(length(data))",
    ] {
        sqlx::query(damage).execute(&mut connection).await.unwrap();
    }
    connection.close().await.unwrap();
}

#[tokio::test(flavor = "multi_thread")]
async fn a_damaged_record_is_a_problem_in_every_format() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    let directory = app.stop().await;
    damage(&crate::app::database(&directory)).await;
    let app = TestApp::start_in(directory, |_| {}).await;
    for path in [
        "trajectory",
        "trajectory?format=ndjson",
        "trajectory?format=csv",
        "trajectory?format=npz",
        "flow",
        "flow.zip",
    ] {
        let answer = app.get(&format!("{job}/{path}")).await;
        answer.assert_problem(StatusCode::INTERNAL_SERVER_ERROR, "damaged-record");
        let detail = answer.body["detail"].as_str().unwrap();
        assert!(detail.contains("checksum"), "{path}: {detail}");
    }
    assert_eq!(app.get(&job).await.body["status"], "successful");
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn pictures_are_drawn_of_a_job_that_has_an_outcome() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["title"] = json!("two cubes");
    let second = json!({"shape": {"cube": {"side_m": 0.02}}, "position": {"downstream_m": 0.3}});
    scene["bodies"].as_array_mut().unwrap().push(second);
    let job = app.submit(&scene).await;
    app.wait_for_success(&job).await;
    for name in ["motion", "aerial"] {
        let (kind, picture) = text(&app, &format!("{job}/{name}.svg")).await;
        assert_eq!(kind, "image/svg+xml");
        let document = roxmltree::Document::parse(&picture).unwrap();
        let texts = document.descendants().filter_map(|node| node.text());
        assert!(
            texts.into_iter().any(|text| text.contains("two cubes")),
            "{name}"
        );
        let refused = app.get(&format!("{job}/{name}.svg?body=0")).await;
        refused.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    }
    for name in ["maps", "maps/deposit.tif", "tracks.geojson"] {
        let none = app.get(&format!("{job}/{name}")).await;
        none.assert_problem(StatusCode::NOT_FOUND, "no-terrain");
    }
    let none = app.get(&format!("{job}/maps/speed.tif")).await;
    none.assert_problem(StatusCode::NOT_FOUND, "unknown-map");
    let endless = app.submit(&endless_scene()).await;
    let none = app.get(&format!("{endless}/motion.svg")).await;
    none.assert_problem(StatusCode::NOT_FOUND, "no-picture");
    app.delete(&endless).await;
    app.stop().await;
}
