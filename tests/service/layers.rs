//! Allowed dependencies between layers, checked by the names of the folders: HTTP holds no
//! SQL, the jobs and their store no HTTP, the runs no job, HTTP accesses the solver only through
//! the jobs, and only the drivers' folders name the database.

use std::fs;
use std::path::{Path, PathBuf};

/// A folder of the service, and the names that none of its files may contain.
const RULES: [(&str, &[&str]); 9] = [
    ("src/http", &["sqlx", "scree_solver", "SELECT ", "rayon"]),
    ("src/jobs", &["axum", "hyper", "crate::http"]),
    (
        "src/jobs/store",
        &["tokio::net", "Simulation", "Recorder", "Scenario"],
    ),
    (
        "src/studies",
        &["sqlx", "axum", "hyper", "crate::http", "SELECT "],
    ),
    (
        "src/terrains",
        &["sqlx", "axum", "hyper", "crate::http", "SELECT "],
    ),
    (
        "src/pictures",
        &["sqlx", "axum", "crate::jobs", "crate::studies"],
    ),
    (
        "src/runs",
        &[
            "sqlx",
            "axum",
            "clap",
            "tokio",
            "crate::jobs",
            "crate::http",
            "println",
        ],
    ),
    (
        "src/results",
        &["sqlx", "axum", "crate::jobs", "crate::http", "Simulation"],
    ),
    (
        "src/verify",
        &[
            "sqlx",
            "axum",
            "clap",
            "crate::jobs",
            "crate::http",
            "println",
        ],
    ),
];

/// The only folders that may hold SQL or name the library that executes it: the drivers', and that
/// of the rows that all of them read.
const DRIVERS: [&str; 3] = [
    "src/jobs/store/sqlite",
    "src/jobs/store/postgres",
    "src/jobs/store/rows",
];

/// The only file outside of them that may name their types: it opens the store.
const OPENS_THE_STORE: &str = "src/database.rs";

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// The code of a file without its comments, which may mention other layers.
fn code(file: &Path) -> String {
    let text = fs::read_to_string(file).unwrap();
    let lines = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

#[test]
fn no_folder_names_what_it_must_not_know() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (folder, forbidden) in RULES {
        let files = rust_files(&root.join(folder));
        assert!(!files.is_empty(), "{folder} is not there");
        for file in files {
            let code = code(&file);
            for name in forbidden {
                assert!(!code.contains(name), "{} names {name}", file.display());
            }
        }
    }
}

/// The files of the service and of the solver outside the drivers' folders.
fn outside_the_drivers(root: &Path) -> Vec<PathBuf> {
    let drivers = DRIVERS.map(|driver| root.join(driver));
    assert!(drivers.iter().all(|driver| driver.is_dir()));
    let files = ["src", "solver/src"].map(|folder| rust_files(&root.join(folder)));
    let mut files = files.concat();
    files.retain(|file| !drivers.iter().any(|driver| file.starts_with(driver)));
    files
}

#[test]
fn sql_is_in_the_drivers_folders() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for file in outside_the_drivers(root) {
        let code = code(&file);
        for name in ["sqlx", "SELECT ", "INSERT INTO ", "PRAGMA ", "pragma_"] {
            assert!(!code.contains(name), "{} names {name}", file.display());
        }
    }
}

#[test]
fn one_place_names_the_database_and_opens_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for driver in ["SqliteStore", "PostgresStore"] {
        let mut files = outside_the_drivers(root);
        files.retain(|file| code(file).contains(driver));
        assert_eq!(files, [root.join(OPENS_THE_STORE)], "{driver}");
    }
}
