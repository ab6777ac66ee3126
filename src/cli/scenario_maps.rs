//! Maps of a scenario as files: on the command line a scenario names them by their paths.

use super::failure::Failure;
use super::scenario_file::{broken_rules, name};
use super::terrain::read_file;
use scree::terrains::{TerrainHash, purpose, violation};
use scree_solver::scenario::{Maps, NamedMap, Scenario, ScenarioError, Violation};
use serde_json::Value;
use std::path::Path;
use std::sync::Arc;

/// The text of a scenario from a file, whose maps have absolute paths: it means the same in any
/// folder. A text without maps is left as it is.
pub(super) fn with_absolute_paths(text: String, file: &Path) -> String {
    let folder = file.parent().unwrap_or(Path::new(""));
    let Ok(folder) = std::path::absolute(if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    }) else {
        return text;
    };
    rewritten(&text, |map| folder.join(&map.name).display().to_string()).unwrap_or(text)
}

/// Reads a scenario whose maps are files.
///
/// # Errors
/// A file can't be read or is no map of its use; or as for a scenario without maps.
pub(super) fn read(text: &str) -> Result<Result<Scenario, ScenarioError>, Failure> {
    let named = match Scenario::maps_named(text) {
        Ok(named) if named.is_empty() => return Ok(Scenario::from_json(text)),
        Ok(named) => named,
        Err(error) => return Ok(Err(error)),
    };
    let mut maps = Maps::default();
    let mut hashes = Vec::new();
    for map in &named {
        let (hash, raster) = read_map(map)?;
        maps.insert(&hash, Arc::new(raster));
        hashes.push((map.pointer.as_str(), hash));
    }
    let hash = |map: &NamedMap| {
        let found = hashes.iter().find(|(pointer, _)| *pointer == map.pointer);
        found.map_or_else(String::new, |(_, hash)| hash.clone())
    };
    // A text with maps is JSON.
    let text = rewritten(text, hash).unwrap_or_default();
    Ok(Scenario::from_json_with(&text, &maps))
}

fn read_map(map: &NamedMap) -> Result<(String, scree_solver::raster::Raster), Failure> {
    let path = Path::new(&map.name);
    let file = read_file(path)?;
    let purpose = purpose(map.of);
    let raster = scree_rasters::read(&file, purpose.into()).map_err(|error| {
        let rule = Violation {
            pointer: map.pointer.clone(),
            ..violation(&error, purpose)
        };
        Failure::Input(broken_rules(&[rule], &name(path)))
    })?;
    Ok((TerrainHash::of(&file).to_string(), raster))
}

/// The text with other names of its maps; `None` if it names none.
fn rewritten(text: &str, other: impl Fn(&NamedMap) -> String) -> Option<String> {
    let named = Scenario::maps_named(text).ok()?;
    if named.is_empty() {
        return None;
    }
    let mut document: Value = serde_json::from_str(text).ok()?;
    for map in &named {
        *document.pointer_mut(&map.pointer)? = other(map).into();
    }
    Some(document.to_string())
}
