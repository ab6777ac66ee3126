//! Layers of modules: a module imports only from lower layers, and nothing within its own, so
//! that each can be read and tested without the rest.

use std::fs;
use std::path::{Path, PathBuf};

/// Layers, lowest first. The scenario is a description that depends on shapes only; the
/// simulation reads it.
const LAYERS: [&[&str]; 11] = [
    &["cancellation", "math", "error", "method", "raster"],
    &["stability"],
    &[
        "kernel",
        "material",
        "motion",
        "shape",
        "contact::broad_phase",
        "contact::friction",
        "contact::law",
        "contact::wall_touch",
    ],
    &["grid"],
    &["bed"],
    &["scenario"],
    &["points", "rigid", "walls"],
    &[
        "available_volume",
        "contact::dissipation",
        "contact::screening",
    ],
    &[
        "contact::body_body",
        "contact::body_wall",
        "contact::point_body",
        "diagnostics",
    ],
    &["contact::island"],
    &["body_energy", "mpm"],
];

/// Above the layers, in this order: they combine them.
const ON_TOP: [&str; 6] = [
    "simulation",
    "plan",
    "record",
    "accuracy",
    "compute",
    "schema",
];

fn rank(module: &str) -> Option<usize> {
    let on_top = || {
        let place = ON_TOP.iter().position(|name| *name == module)?;
        Some(LAYERS.len() + place)
    };
    LAYERS
        .iter()
        .position(|layer| layer.contains(&module))
        .or_else(on_top)
}

/// The module of a path below `crate::`.
fn module_of(path: &str) -> String {
    let mut parts = path.split("::");
    let first = parts.next().unwrap_or_default();
    match (first, parts.next()) {
        // A group of modules: as high as the highest.
        ("contact", Some("")) => "contact::point_body".to_owned(),
        ("contact", Some(second)) => format!("contact::{second}"),
        _ => first.to_owned(),
    }
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("it can be read").path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// All paths below `crate::` in the code of a file, without its tests and comments.
fn imports(text: &str) -> Vec<String> {
    let code = text
        .split("#[cfg(test)]\nmod tests {")
        .next()
        .unwrap_or_default();
    let lines = code
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"));
    lines
        .flat_map(|line| {
            line.split("crate::")
                .skip(1)
                .map(str::to_owned)
                .collect::<Vec<_>>()
        })
        .map(|rest| {
            let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
            rest[..end.unwrap_or(rest.len())].to_owned()
        })
        .collect()
}

#[test]
fn modules_import_only_from_below() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut seen = 0;
    for file in rust_files(&source) {
        let inside = file.strip_prefix(&source).expect("it is inside");
        let name = inside
            .with_extension("")
            .to_string_lossy()
            .replace('/', "::");
        let module = module_of(&name);
        let for_tests = name.contains("::tests")
            || ["::fixture", "::reference", "::step_tests"]
                .iter()
                .any(|end| name.ends_with(end));
        if for_tests || matches!(name.as_str(), "lib" | "contact::mod") {
            continue;
        }
        let own = rank(&module).unwrap_or_else(|| panic!("{module} has no layer"));
        let text = fs::read_to_string(&file).expect("it can be read");
        for import in imports(&text) {
            let other = module_of(&import);
            // `crate::VERSION` and the like are the crate's own.
            if other == module || other.starts_with(char::is_uppercase) {
                continue;
            }
            let below = rank(&other).unwrap_or_else(|| panic!("{other} has no layer"));
            assert!(below < own, "{} imports {import}", inside.display());
            seen += 1;
        }
    }
    assert!(seen > 40, "only {seen} imports found: the reader is blind");
}

#[test]
fn the_reader_of_imports_sees_them() {
    let text = "use crate::contact::law::ContactLaw;\n// crate::walls\n  let a = crate::VERSION;\n\
        #[cfg(test)]\nmod tests {\nuse crate::grid::Grid;";
    let found = imports(text);
    assert_eq!(found, ["contact::law::ContactLaw", "VERSION"]);
    assert_eq!(module_of(&found[0]), "contact::law");
}
