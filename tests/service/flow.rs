//! Snapshots of the flow.

use crate::app::{TestApp, endless_scene, is_running, tiny_scene};
use reqwest::StatusCode;
use serde_json::{Value, json};

#[tokio::test(flavor = "multi_thread")]
async fn the_flow_is_shown_at_the_nearest_snapshot() {
    let app = TestApp::start().await;
    let job = app.submit(&tiny_scene()).await;
    app.wait_for_success(&job).await;
    // Three snapshots over 0.05 s, both ends included.
    for (query, expected_s) in [
        ("?time_s=0.001", 0.0),
        ("?time_s=0.03", 0.025),
        ("?time_s=9", 0.05),
        ("", 0.05),
    ] {
        let answer = app.get(&format!("{job}/flow{query}")).await;
        assert_eq!(answer.status, StatusCode::OK);
        let flow = answer.body;
        let time_s = flow["time_s"].as_f64().unwrap();
        // A snapshot is at the first end of a step at or after its time; a step
        // of this scene takes less than 5 ms.
        assert!(
            (0.0..0.005).contains(&(time_s - expected_s)),
            "{query}: {time_s}"
        );
        let points = flow["position_m"].as_array().unwrap();
        assert_eq!(points.len(), flow["speed_m_s"].as_array().unwrap().len());
        assert!(!points.is_empty() && points.len() <= 5000);
        assert_eq!(flow["thinning"], 1);
        assert_eq!(flow["points"], points.len());
        assert_eq!(
            format!("/v1/jobs/{}", flow["job_id"].as_str().unwrap()),
            job
        );
    }
    app.stop().await;
}

/// A frame of the stream, as read by its description in the contract.
struct Frame {
    time_s: f64,
    points: u64,
    ranks: Vec<u16>,
    positions_m: Vec<[f64; 3]>,
    speeds_m_s: Vec<f64>,
}

/// The frames of a stream.
fn frames(bytes: &[u8]) -> Vec<Frame> {
    let u32_at = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let u64_at = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let f32_at = |at: usize| f64::from(f32::from_bits(u32_at(at)));
    assert_eq!(&bytes[..8], b"SCREEFLO");
    assert_eq!(u32_at(8), 1);
    let mut at = 16;
    let mut read = Vec::new();
    for _ in 0..u32_at(12) {
        let kept = u32_at(at + 16) as usize;
        let columns = at + 56;
        let step = |column: usize, row: usize| {
            let place = columns + 2 * (column * kept + row);
            u16::from_le_bytes([bytes[place], bytes[place + 1]])
        };
        let share = |column: usize, row: usize| f64::from(step(column, row)) / 65_535.0;
        let axis = |axis: usize, row: usize| {
            f32_at(at + 24 + 4 * axis) + f32_at(at + 36 + 4 * axis) * share(1 + axis, row)
        };
        read.push(Frame {
            time_s: f64::from_bits(u64_at(at)),
            points: u64_at(at + 8),
            ranks: (0..kept).map(|row| step(0, row)).collect(),
            positions_m: (0..kept)
                .map(|row| [0, 1, 2].map(|k| axis(k, row)))
                .collect(),
            speeds_m_s: (0..kept)
                .map(|row| f32_at(at + 48) * share(4, row))
                .collect(),
        });
        at = (columns + 10 * kept).next_multiple_of(8);
    }
    assert_eq!(at, bytes.len());
    read
}

async fn read_frames(app: &TestApp, path: &str) -> Vec<Frame> {
    let response = app.client.get(app.url(path)).send().await.unwrap();
    assert_eq!(response.status(), StatusCode::OK, "{path}");
    let kind = response.headers()["content-type"].to_str().unwrap();
    assert_eq!(kind, "application/vnd.scree.flow");
    frames(&response.bytes().await.unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn the_flow_is_streamed_in_binary_by_ranges_of_time() {
    let app = TestApp::start().await;
    let mut scene = tiny_scene();
    scene["flow_snapshots"] = json!(6);
    scene["flow_snapshot_points"] = json!(100);
    let job = app.submit(&scene).await;
    app.wait_for_success(&job).await;
    let all = read_frames(&app, &format!("{job}/flow.bin")).await;
    assert_eq!(all.len(), 6);
    for frame in &all {
        let exact = app
            .get(&format!("{job}/flow?time_s={}", frame.time_s))
            .await
            .body;
        assert_eq!(exact["time_s"], frame.time_s);
        assert_eq!(exact["points"], frame.points);
        let thinning = exact["thinning"].as_u64().unwrap();
        assert!(frame.points > 100 && frame.ranks.len() <= 100);
        let number = |value: &Value| value.as_f64().unwrap();
        for (row, rank) in frame.ranks.iter().enumerate() {
            assert_eq!(exact["point_id"][row], thinning * u64::from(*rank));
            let speed = number(&exact["speed_m_s"][row]);
            assert!((speed - frame.speeds_m_s[row]).abs() < 1e-4);
            for axis in 0..3 {
                let position = number(&exact["position_m"][row][axis]);
                assert!((position - frame.positions_m[row][axis]).abs() < 1e-5);
            }
        }
    }
    let part = read_frames(&app, &format!("{job}/flow.bin?from_s=0.015&to_s=0.045")).await;
    let times = |frames: &[Frame]| -> Vec<f64> { frames.iter().map(|one| one.time_s).collect() };
    assert_eq!(times(&part), times(&all[2..5]));
    assert!(
        read_frames(&app, &format!("{job}/flow.bin?from_s=9"))
            .await
            .is_empty()
    );
    for query in ["?from_s=2&to_s=1", "?from_s=x", "?spam=1"] {
        let answer = app.get(&format!("{job}/flow.bin{query}")).await;
        answer.assert_problem(StatusCode::UNPROCESSABLE_ENTITY, "invalid-query");
    }
    app.stop().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_running_job_has_the_frames_so_far() {
    let app = TestApp::start().await;
    let mut scene = endless_scene();
    scene["flow_snapshots"] = json!(3);
    let job = app.submit(&scene).await;
    app.wait(&job, is_running).await;
    let count = async || read_frames(&app, &format!("{job}/flow.bin")).await.len();
    while count().await == 0 {
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
    assert_eq!(count().await, 1, "the start is there, the rest is to come");
    app.delete(&job).await;
    app.stop().await;
}
