//! Checks that every file named in a comment or a document exists.

use std::fs;
use std::path::{Path, PathBuf};

/// Endings of names that must be files of the repository; JSON files
/// may be output of a command.
const ENDINGS: [&str; 5] = [".md", ".rs", ".svg", ".toml", ".sql"];
/// Folders that are not part of the project.
const SKIPPED: [&str; 3] = ["target", ".git", "node_modules"];

fn files_under(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let paths = entries.map(|entry| entry.path());
    let ours = paths.filter(|path| !SKIPPED.iter().any(|name| path.ends_with(name)));
    ours.flat_map(|path| match path.is_dir() {
        true => files_under(&path),
        false => vec![path],
    })
    .collect()
}

/// Text of a file in which other files may be named: comments of code, all of a document.
fn prose(file: &Path) -> Option<String> {
    let ending = file.extension()?.to_str()?;
    let text = || fs::read_to_string(file).unwrap();
    match ending {
        "md" => Some(text()),
        "rs" => {
            let text = text();
            let comments = text
                .lines()
                .filter_map(|line| line.trim_start().strip_prefix("//"));
            Some(comments.collect::<Vec<_>>().join("\n"))
        }
        _ => None,
    }
}

/// Names of files in a text, without relative prefixes.
fn named_files(text: &str) -> Vec<&str> {
    let in_name = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    let words = text
        .split(|c| !in_name(c))
        .map(|word| word.trim_end_matches('.'));
    let names = words.filter(|word| ENDINGS.iter().any(|ending| word.ends_with(ending)));
    names
        .map(|name| name.trim_start_matches("../").trim_start_matches("./"))
        // What begins with a slash is a place of the service.
        .filter(|name| !name.starts_with(['.', '/']))
        .collect()
}

#[test]
fn files_named_in_prose_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let files = files_under(root);
    let mut missing = Vec::new();
    for file in &files {
        for name in prose(file).iter().flat_map(|text| named_files(text)) {
            if !files.iter().any(|known| known.ends_with(name)) {
                missing.push(format!("{} names {name}", file.display()));
            }
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}

#[test]
fn names_of_files_are_found_in_prose() {
    let text = "See docs/method.md, (../decisions/0001-x.md) and `rigid.rs`. A file.txt is not.";
    let named = ["docs/method.md", "decisions/0001-x.md", "rigid.rs"];
    assert_eq!(named_files(text), named);
}
