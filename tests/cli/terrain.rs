//! `scree terrain`.

use crate::command::{Answer, Served, ask, ask_with_input, scree};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::time::{Duration, Instant};

/// A GeoTIFF of 2 m cells in EPSG:2056 that rises to the east.
fn geotiff() -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    folder.join("rasters/tests/files/tiled-zstd-uint16.tif")
}

fn grid(corner: &str) -> String {
    format!(
        "ncols 3\nnrows 3\nxllcorner 10\nyllcorner 20\ncellsize 5\n100 105 110\n100 105 110\n\
         {corner} 105 110\n"
    )
}

/// What a command for a service at this address answers.
fn at(served: &Served, words: &[&str]) -> Answer {
    let url = format!("http://{}", served.address);
    let output = scree().args(words).env("SCREE_URL", url).output();
    output.expect("the binary starts").into()
}

#[test]
fn a_raster_is_described() {
    let answer = ask_with_input(&["terrain", "check", "-"], &grid("100"));
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    for fact in [
        "ESRI ASCII grid",
        "3 × 3 cells of 5 m",
        "easting 10 to 25 m, northing 20 to 35 m",
        "100.00 to 110.00 m",
        "45.0° in the mean",
    ] {
        assert!(answer.stdout.contains(fact), "{fact}: {}", answer.stdout);
    }
    let answer = ask(&[&"terrain", &"check", &geotiff()]);
    assert_eq!((answer.code, answer.stderr.as_str()), (Some(0), ""));
    assert!(answer.stdout.contains("GeoTIFF") && answer.stdout.contains("EPSG:"));
}

#[test]
fn a_file_at_fault_is_invalid_input_here_and_there() {
    let folder = tempfile::tempdir().unwrap();
    let served = Served::start(&folder.path().join("test.db"), Stdio::null());
    let file = folder.path().join("grid.asc");
    std::fs::write(&file, grid("-9999")).unwrap();
    let file = file.to_str().unwrap();
    for words in [["terrain", "check", file], ["terrain", "put", file]] {
        let answer = at(&served, &words);
        assert_eq!((answer.code, answer.stdout.as_str()), (Some(2), ""));
        for phrase in ["grid.asc breaks 1 rule", "row 2 and column 0", "-9999"] {
            assert!(
                answer.stderr.contains(phrase),
                "{phrase}: {}",
                answer.stderr
            );
        }
    }
    let missing = ask(&[&"terrain", &"check", &"no/such/file.tif"]);
    assert_eq!((missing.code, missing.stdout.as_str()), (Some(2), ""));
}

#[test]
fn an_uploaded_file_is_told_as_a_local_one_and_again_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let served = Served::start(&folder.path().join("test.db"), Stdio::null());
    let (file, path) = (geotiff(), geotiff());
    let path = path.to_str().unwrap();
    let local = ask(&[&"terrain", &"check", &file]);
    for _ in 0..2 {
        let put = at(&served, &["terrain", "put", path]);
        assert_eq!((put.code, put.stderr.as_str()), (Some(0), ""));
        assert_eq!(put.stdout, local.stdout);
    }
    let put = at(&served, &["terrain", "put", path, "--json"]);
    let terrain: Value = serde_json::from_str(&put.stdout).unwrap();
    assert_eq!(terrain["format"], "geotiff");
    assert!(local.stdout.contains(terrain["hash"].as_str().unwrap()));
}

/// It is refused by its length, before it is sent: else the connection would break, and be tried again
/// for minutes.
#[test]
fn a_file_that_is_too_large_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let config = folder.path().join("service.toml");
    std::fs::write(&config, "[limits]\nterrain_file_bytes = 1000\n").unwrap();
    let arguments = [
        "--listen",
        "127.0.0.1:0",
        "--config",
        config.to_str().unwrap(),
    ];
    let database = folder.path().join("test.db");
    let served = Served::start_with(&arguments, &database, Stdio::null());
    let file = folder.path().join("large.tif");
    std::fs::write(&file, vec![b' '; 30 << 20]).unwrap();
    let began = Instant::now();
    let answer = at(&served, &["terrain", "put", file.to_str().unwrap()]);
    assert_eq!(answer.code, Some(2), "{}", answer.stderr);
    assert!(
        answer.stderr.contains("limits.terrain_file_bytes"),
        "{}",
        answer.stderr
    );
    assert!(
        began.elapsed() < Duration::from_secs(20),
        "{}",
        answer.stderr
    );
}

/// A folder with a map, and a scenario and a study on it that name it by its path from there.
fn scene_on_a_map() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let rows = (0..20).map(|_| (0..20).map(|x| format!("{} ", 100 - x)).collect::<String>() + "\n");
    let map = rows.collect::<String>();
    let header = "ncols 20\nnrows 20\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    std::fs::write(folder.path().join("map.asc"), format!("{header}{map}")).unwrap();
    let scenario = json!({
        "terrain": {"height_map": "map.asc"},
        "flow": {"releases": [{"polygon_m": [[4, 8], [7, 8], [7, 12], [4, 12]], "thickness_m": 1}]},
        "bodies": [{"shape": {"cube": {"side_m": 1}}, "position": {"east_m": 9, "north_m": 10}}],
        "duration_s": 0.3, "numerics": {"cell_size_m": 0.5}, "flow_snapshots": 0
    });
    let study = json!({
        "title": "on a map", "scenario": scenario,
        "inputs": [{"pointer": "/terrain/base_friction",
                    "distribution": {"uniform": {"from": 0.3, "to": 0.5}}}],
        "design": {"sobol": {"members": 8, "seed": 7}},
        "questions": [{"mean": {"quantity": "displacement_m", "body": 0}}],
    });
    for (name, document) in [("scenario.json", &scenario), ("study.json", &study)] {
        std::fs::write(folder.path().join(name), document.to_string()).unwrap();
    }
    folder
}

/// The outcome that a command writes, without its cost.
fn outcome(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("outcome.json")).unwrap();
    let mut outcome: Value = serde_json::from_str(&text).unwrap();
    outcome["cost"] = Value::Null;
    outcome
}

#[test]
fn maps_of_submitted_scenarios_are_uploaded() {
    let folder = scene_on_a_map();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let served = Served::start(&folder.path().join("test.db"), Stdio::null());
    let job = at(
        &served,
        &["submit", &path("scenario.json"), "--wait", "--quiet"],
    );
    assert_eq!((job.code, job.stderr.as_str()), (Some(0), ""));
    let got = at(
        &served,
        &["get", job.stdout.trim(), "--out", &path("there")],
    );
    assert_eq!(got.code, Some(0), "{}", got.stderr);
    let ran = ask(&[&"run", &path("scenario.json"), &"--out", &path("here")]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let [there, here] = ["there", "here"].map(|name| outcome(&folder.path().join(name)));
    assert_eq!(there["bodies"], here["bodies"]);

    // By its hash it is there without the file.
    let map = std::fs::read(path("map.asc")).unwrap();
    let hash = scree_rasters::hash(&map);
    let text = std::fs::read_to_string(path("scenario.json")).unwrap();
    std::fs::write(path("by_hash.json"), text.replace("map.asc", &hash)).unwrap();
    let job = at(&served, &["submit", &path("by_hash.json")]);
    assert_eq!((job.code, job.stderr.as_str()), (Some(0), ""));
    let here = ask(&[&"run", &path("by_hash.json")]);
    assert_eq!(here.code, Some(2));
    assert!(
        here.stderr.contains("/terrain/height_map"),
        "{}",
        here.stderr
    );
    assert!(
        here.stderr.contains("allowed: the path of a file"),
        "{}",
        here.stderr
    );
}

// Its scenario names the map where it is, so that it means the same from the folder of results.
#[test]
fn a_run_on_a_map_is_repeated_from_its_results() {
    let folder = scene_on_a_map();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    for (scenario, out) in [
        ("scenario.json", "once"),
        ("once/scenario.json", "again"),
        // Its own results are replaced by the same.
        ("once/scenario.json", "once"),
    ] {
        let ran = ask(&[&"run", &path(scenario), &"--out", &path(out), &"--quiet"]);
        assert_eq!((ran.code, ran.stderr.as_str()), (Some(0), ""));
    }
    let [once, again] = ["once", "again"].map(|name| outcome(&folder.path().join(name)));
    assert_eq!(once, again);
}

#[test]
fn a_study_on_a_map_is_the_same_here_and_there() {
    let folder = scene_on_a_map();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let served = Served::start(&folder.path().join("test.db"), Stdio::null());
    let here = ask(&[&"study", &path("study.json"), &"--out", &path("here")]);
    assert_eq!(here.code, Some(0), "{}", here.stderr);
    let url = format!("http://{}", served.address);
    let words = [
        "study",
        &path("study.json"),
        "--out",
        &path("there"),
        "--url",
        &url,
    ];
    let there = at(&served, &words);
    assert_eq!(there.code, Some(0), "{}", there.stderr);
    let answers = |name: &str| std::fs::read_to_string(path(&format!("{name}/answers.json")));
    assert_eq!(answers("here").unwrap(), answers("there").unwrap());
    assert!(
        here.stdout.contains("8 members finished"),
        "{}",
        here.stdout
    );
}
