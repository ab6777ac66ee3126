//! `scree terrain`.

use crate::command::{Answer, Served, ask, ask_with_input, scree};
use serde_json::Value;
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
