//! Allowed dependencies between layers, checked by the names of the folders: HTTP holds no
//! SQL, the jobs and their store no HTTP, and HTTP accesses the solver only through
//! the jobs.

use std::fs;
use std::path::{Path, PathBuf};

/// A folder of the service, and the names that none of its files may contain.
const RULES: [(&str, &[&str]); 5] = [
    ("src/http", &["sqlx", "scree_solver", "SELECT ", "rayon"]),
    ("src/jobs", &["axum", "hyper", "crate::http"]),
    (
        "src/jobs/store",
        &["tokio::net", "Simulation", "Recorder", "Scenario"],
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

/// The only folder that may hold SQL.
const SQL: &str = "src/jobs/store";

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

#[test]
fn sql_is_in_one_folder() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for file in rust_files(&root.join("src")) {
        let holds_sql = code(&file).contains("sqlx");
        assert!(
            !holds_sql || file.starts_with(root.join(SQL)),
            "{}",
            file.display()
        );
    }
}
